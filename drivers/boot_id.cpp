#include "drivers/boot_id.hpp"

#include <algorithm>
#include <fstream>
#include <string_view>

namespace axiscal {
namespace {

/// RFC 9562, section 4: 8-4-4-4-12 digits; the kernel writes small letters. All zeros is the nil
/// UUID (5.9), which names nothing.
bool names_something(std::string_view text) {
    constexpr std::string_view shape = "00000000-0000-0000-0000-000000000000";
    const auto fits = [](char letter, char wanted) {
        const bool digit = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'f');
        return wanted == '0' ? digit : letter == wanted;
    };
    return text != shape && std::ranges::equal(text, shape, fits);
}

} // namespace

BootId read_boot_id(const std::string& path) {
    std::ifstream file{path};
    std::string text;
    std::getline(file, text);
    return names_something(text) ? BootId{text} : BootId{};
}

} // namespace axiscal

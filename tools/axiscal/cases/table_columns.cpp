#include "tools/axiscal/cases/table_columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>

namespace axiscal {
namespace {

std::string unit_word(std::string unit) {
    if (unit == "\xc2\xb5m" || unit == "\xce\xbcm") return "um"; // both letters mu
    if (unit == "\xc2\xb0") return "deg";
    return unit;
}

bool is_word_in(const std::string& name, std::string_view word) {
    const auto at = name.find(word);
    if (at == std::string::npos) return false;
    const auto letter = [&](std::size_t place) {
        return place < name.size() && std::isalpha(static_cast<unsigned char>(name[place])) != 0;
    };
    return (at == 0 || !letter(at - 1)) && !letter(at + word.size());
}

} // namespace

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return text;
}

Heading heading_of(std::string text) {
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        const auto begin = text.rfind(open);
        if (begin == std::string::npos || text.empty() || text.back() != close) continue;
        std::string unit = text.substr(begin + 1, text.size() - begin - 2);
        const auto end = text.find_last_not_of(' ', begin == 0 ? 0 : begin - 1);
        return {text.substr(0, end + 1), unit_word(std::move(unit))};
    }
    for (const std::string unit : {"mm", "um", "deg", "rad", "arcsec"})
        if (text.ends_with("_" + unit))
            return {text.substr(0, text.size() - unit.size() - 1), unit};
    return {std::move(text), ""};
}

std::optional<Approach> approach_of(const std::string& heading) {
    constexpr std::array forward{"+", "\xe2\x86\x91", "forward", "up", "positive", "pos", "fwd"};
    constexpr std::array backward{"-",        "\xe2\x86\x93", "backward", "down",
                                  "negative", "neg",          "reverse"};
    const std::string name = lower(heading);
    const auto says = [&](const char* word) { return is_word_in(name, word); };
    const bool goes_up = std::ranges::any_of(forward, says);
    const bool goes_down = std::ranges::any_of(backward, says);
    if (goes_up == goes_down) return std::nullopt;
    const auto digit = name.find_first_of("0123456789");
    Approach found{goes_up, 1};
    if (digit != std::string::npos) found.number = std::atoi(name.c_str() + digit);
    return found;
}

} // namespace axiscal

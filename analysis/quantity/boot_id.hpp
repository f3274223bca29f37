#pragma once
// Which start of the computer a monotonic time counts from.

#include <string>

namespace axiscal {

/// The kernel's name for one boot. Empty: nobody could read it. There is no operator== on purpose:
/// two unknown boots are not the same one.
struct BootId {
    std::string text;
    [[nodiscard]] bool known() const { return !text.empty(); }
};

/// True only where both are known: times of the two may then be compared.
inline bool is_same_boot(const BootId& first, const BootId& other) {
    return first.known() && other.known() && first.text == other.text;
}

} // namespace axiscal

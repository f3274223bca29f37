#pragma once
// What the header of a table says of its columns. Pure.

#include <compare>
#include <optional>
#include <string>

namespace axiscal {

std::string lower(std::string text);

/// "run1 + [um]" is the name "run1 +" in "um"; also with round brackets, or as "target_mm".
struct Heading {
    std::string name, unit; ///< the unit as cases have it: "um" for both letters mu
};
Heading heading_of(std::string text);

/// One reading of a target: its direction, and its number.
struct Approach {
    bool forward = true;
    int number = 1;
    auto operator<=>(const Approach&) const = default;
};
/// "run1 +", "forward 2", "3 down"; empty without a direction, or with both.
std::optional<Approach> approach_of(const std::string& heading);

} // namespace axiscal

#pragma once
// What the limit of a figure is. Pure data.

#include <cstdint>
#include <string_view>

namespace axiscal {

enum class LimitQuantity : std::uint8_t {
    of_axis, ///< along the axis: a length; of a rotary axis an angle
    length,  ///< whatever the axis is
    slope    ///< a length for each metre
};

/// In which run files and certificates state it.
constexpr std::string_view unit_of_limits(LimitQuantity quantity, bool rotary) {
    switch (quantity) {
    case LimitQuantity::of_axis: return rotary ? "arcsec" : "um";
    case LimitQuantity::length: return "um";
    case LimitQuantity::slope: return "um/m";
    }
    return "um";
}

} // namespace axiscal

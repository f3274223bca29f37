#pragma once
// One line of a Vaisala PTU300 or PTB330. Pure. Sections: see environment_vaisala.cpp.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace axiscal {

/// The checksum that FORM puts behind a message: none; CSX, the XOR of all letters before it, two
/// hex digits; CS4, their sum modulo 65536, four. [FORM]
enum class VaisalaChecksum : std::uint8_t { none, csx, cs4 };

/// What stands before the checksum, when that is right. Digits of either case.
/// @errors Fault::bad_frame when the line is too short or does not end in hex digits,
/// Fault::checksum when they do not match.
Result<std::string_view> verify_vaisala_line(std::string_view line, VaisalaChecksum kind);

/// A quantity is empty when it is not in the line, is shown as asterisks, has a unit not known
/// here, or is impossible (30 to 120 kPa, -60 to 150 degC, 0 to 100 %RH).
struct VaisalaReading {
    std::optional<double> pressure_Pa, temperature_degC, humidity_percent;
};

/// "P= 1013.2 hPa T= 31.1 'C RH= 38.3 %RH", blanks as many as there are.
/// @errors Fault::bad_frame when the text does not begin with "P=".
Result<VaisalaReading> parse_vaisala_line(std::string_view verified);

} // namespace axiscal

#pragma once
// The two files in which the kernel shows a 1-Wire thermometer. Pure. Sections: see
// environment_ds18b20.cpp.

#include "analysis/quantity/result.hpp"

#include <string_view>

namespace axiscal {

/// degC from the text of `w1_slave`. [w1_slave]
/// @errors Fault::checksum when the kernel says NO, or the scratchpad's own CRC is wrong;
/// Fault::bad_frame for any other text and where the scratchpad and t= differ; Fault::signal_error
/// for 85 degC (the value after power-on: no conversion took place), 127.9375 degC, a scratchpad of
/// zeros (the wire is shorted; its CRC is right) and a value outside -55 to 125 degC.
Result<double> parse_w1_slave(std::string_view text);

/// degC from the text of `temperature`, millidegrees. [temperature]
/// @errors Fault::bad_frame for an empty file (a conversion is going on) and what is no number;
/// Fault::signal_error as above. There is no checksum here: the kernel has looked at it.
Result<double> parse_w1_temperature(std::string_view text);

} // namespace axiscal

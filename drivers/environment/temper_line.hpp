#pragma once
// What a PCsensor TEMPerX232 answers on its serial line. Pure. Sections: see
// environment_temper_serial.cpp.

#include "analysis/quantity/result.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

/// One sensor of the stick: the one inside, or the probe in its jack.
struct TemperLine {
    bool probe = false;
    std::optional<double> temperature_degC; ///< empty: dashes in its place, or impossible
    bool has_humidity = false;              ///< the sensor is of a kind that sends it
    std::optional<double> humidity_percent; ///< empty as above
};

/// "Temp-Inner:30.53 [C],39.92 [%RH]<" without its end. Without humidity the part from the comma on
/// is missing. [F] is told in degC. [ReadTemp]
/// @errors Fault::bad_frame for any other text: no final '<', another unit, a number that has not
/// two decimals.
Result<TemperLine> parse_temper_line(std::string_view line);

/// What the stick adds by itself, of one sensor: "Inner-Calib:0.0 [C],0.0 [%RH]". [ReadCalib]
struct TemperCalibration {
    bool probe = false;
    double temperature_K = 0, humidity_percent = 0;
};
/// Empty for any other text.
std::optional<TemperCalibration> parse_temper_calibration(std::string_view line);

/// The last "TEMPer..." in what answered Version, without blanks and line ends; empty: none.
/// [Version]
std::string temper_version(std::string_view text);

} // namespace axiscal

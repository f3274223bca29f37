#pragma once
// What PCsensor TEMPer sticks answer. Pure. Sections: see environment_temper.cpp.

#include "analysis/quantity/result.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// How one firmware lays out its values; an offset of -1: it has none.
struct TemperFamily {
    std::string_view firmware;  ///< its name begins so
    double divisor = 100;       ///< raw to degC and %; 0: raw counts of an SHT20
    int stick_temperature = -1; ///< offsets in the reply
    int probe_temperature = -1;
    int stick_humidity = -1;
    int probe_humidity = -1;
};

/// "TEMPerX_V3.3" of the reports that answer the firmware request; empty when they are no text.
std::string temper_firmware(std::span<const std::byte> reply);

/// The family of a firmware. @errors Fault::unknown_instrument with the name in hexadecimal.
Result<TemperFamily> temper_family(std::string_view firmware);

/// degC and %; empty where the sensor is absent (20000), its report did not come, or the value is
/// impossible.
struct TemperReading {
    std::optional<double> stick_temperature, probe_temperature, stick_humidity, probe_humidity;
    int bad_reports = 0; ///< with another head, or twice: left out
};
/// `reply` holds reports of 8 bytes in the order in which they came; where a firmware sends two,
/// the head tells the stick's from the probe's.
TemperReading decode_temper_reading(std::span<const std::byte> reply, const TemperFamily& family);

} // namespace axiscal

#pragma once
// Answers of a PCsensor TEMPerX232, from what the stick itself prints to "Help". Pure. A command
// has no end of line; answers end with CR LF. The line of a probe has the form of the stick's own.

#include <optional>
#include <string>

namespace axiscal::simulate {

struct TemperTruth {
    double stick_degC = 20, stick_humidity_percent = 50;
    std::optional<double> probe_degC = {}; ///< empty: nothing is in the jack
};

/// What the stick sends back; takes from `typed` what it has understood, and what no command begins
/// with. Empty: nothing (yet).
std::string temper_answer(std::string& typed, const TemperTruth& truth);

} // namespace axiscal::simulate

#include "wire/temper_line.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

namespace axiscal::simulate {

namespace {

constexpr std::array<std::string_view, 4> commands{"ReadTemp", "ReadCalib", "ReadType", "Version"};

std::string two_decimals(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

std::string reading(const TemperTruth& truth) {
    std::string lines = "Temp-Inner:" + two_decimals(truth.stick_degC) + " [C]," +
                        two_decimals(truth.stick_humidity_percent) + " [%RH]<\r\n";
    if (truth.probe_degC) lines += "Temp-Outer:" + two_decimals(*truth.probe_degC) + " [C]<\r\n";
    return lines;
}

std::string obey(std::string_view command, const TemperTruth& truth) {
    if (command == "ReadTemp") return reading(truth);
    if (command == "ReadCalib")
        return "Inner-Calib:0.0 [C],0.0 [%RH]\r\nOuter-Calib:0.0 [C],0.0 [%RH]\r\n";
    return command == "ReadType" ? "Type:Inner-H2\r\n" : "TEMPerX232_V2.0\r\n";
}

} // namespace

std::string temper_answer(std::string& typed, const TemperTruth& truth) {
    std::string sent;
    while (!typed.empty()) {
        const auto whole = std::ranges::find_if(
            commands, [&](std::string_view command) { return typed.starts_with(command); });
        const bool begins = std::ranges::any_of(
            commands, [&](std::string_view command) { return command.starts_with(typed); });
        if (whole != commands.end()) {
            sent += obey(*whole, truth);
            typed.erase(0, whole->size());
        } else if (begins) {
            break; // the rest is on its way
        } else {
            typed.erase(0, 1);
        }
    }
    return sent;
}

} // namespace axiscal::simulate

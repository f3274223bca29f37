#include "analysis/setup/setup_words.hpp"

#include "analysis/positioning/completeness.hpp"

#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

std::string number(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string words_of(SetupError error) {
    switch (error) {
    case SetupError::moved_optic:
        return "an optic moved, or the axis slipped between scale and spindle";
    case SetupError::dead_path: return "the dead path of the station file is wrong";
    case SetupError::expansion: return "the expansion coefficient of the station file is wrong";
    case SetupError::growth: return "the machine was warming up or cooling down";
    case SetupError::frozen_air: return "the sensor hangs and repeats its last reading";
    case SetupError::sensor_in_air:
        return "a material sensor hangs in the air or sits on a thin cover";
    }
    return {};
}

std::string where(const PlannedPoint& point) {
    return place_of(point.target_index, point.direction) + " " + std::to_string(point.approach + 1);
}

void say_moved_optic(SetupFinding& finding) {
    finding.seen = "From reading " + where(*finding.from) + " on, every reading is " +
                   number("%.1f", std::fabs(finding.value)) + " µm " +
                   (finding.value > 0 ? "higher" : "lower") + " than before, at every target.";
    finding.look_at = "Tighten the reflector, the interferometer and their posts. Where nothing is "
                      "loose, look at the coupling and at the scale. Then measure again.";
}

void say_dead_path(SetupFinding& finding) {
    finding.seen = "All readings moved with the refractive index of air, by the same amount at "
                   "every target: as a path of " +
                   number("%.0f", std::fabs(finding.value) * 1e3) + " mm that is " +
                   (finding.value > 0 ? "not corrected." : "corrected and does not exist.");
    finding.look_at = "Measure the path from the interferometer to the reflector at the datum and "
                      "state it as laser.dead_path.";
}

void say_expansion(SetupFinding& finding) {
    finding.seen = "The readings moved with the temperature of the material, in proportion to the "
                   "distance from the datum: as if the coefficient were " +
                   number("%+.1f", finding.value) + " µm/(m K) off.";
    finding.look_at = "Look up the coefficient of the scale or screw that measures the axis, and "
                      "whether the sensors sit on it.";
}

void say_growth(SetupFinding& finding) {
    finding.seen = "The axis grew by " + number("%.1f", finding.value) +
                   " µm per metre and hour, and the temperature sensors do not show it.";
    finding.look_at = "Let the machine soak or run it warm, and put the material sensors on the "
                      "part that measures the axis.";
}

void say_frozen_air(SetupFinding& finding) {
    finding.seen = "No figure of the air sensor \"" + finding.sensor + "\" changed for " +
                   number("%.0f", finding.value) + " minutes, not by its last digit.";
    finding.look_at = "Unplug the sensor and plug it in again, breathe on it and see its readings "
                      "move, then measure again.";
}

void say_sensor_in_air(SetupFinding& finding) {
    finding.seen = "The material sensor \"" + finding.sensor + "\" showed " +
                   number("%.0f", finding.value * 100) + " % of each swing of the air.";
    finding.look_at = "Press it with paste on the part that measures the axis, and cover it.";
}

} // namespace

void put_into_words(SetupFinding& finding) {
    switch (finding.error) {
    case SetupError::moved_optic: say_moved_optic(finding); break;
    case SetupError::dead_path: say_dead_path(finding); break;
    case SetupError::expansion: say_expansion(finding); break;
    case SetupError::growth: say_growth(finding); break;
    case SetupError::frozen_air: say_frozen_air(finding); break;
    case SetupError::sensor_in_air: say_sensor_in_air(finding); break;
    }
    finding.probably = "Probably " + words_of(finding.error);
    for (const SetupError other : finding.or_else)
        finding.probably += ", or " + words_of(other);
    finding.probably += ".";
}

std::string sentence_of(const SetupFinding& finding) {
    std::string text = "Set-up: " + finding.seen + " " + finding.probably + " " + finding.look_at;
    if (finding.answer.empty()) return text;
    return text + " Answer of " + finding.answered_by + ": " + finding.answer;
}

} // namespace axiscal

#include "analysis/circular/cause_words.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace axiscal::circular {
namespace {

/// Four digits; free of the process' locale only as long as nobody sets one, which nobody does.
std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}
std::string um(double mm) {
    return digits(std::fabs(mm) * 1e3) + " um";
}

const std::string& moving(int axis, const WordsContext& context) {
    return context.axes[axis == 0 ? 0 : 1];
}
const std::string& other(int axis, const WordsContext& context) {
    return context.axes[axis == 0 ? 1 : 0];
}
std::string reversal_places(int axis) {
    return axis == 0 ? "0 and 180 deg" : "90 and 270 deg";
}
std::string middle_places(int axis) {
    return axis == 0 ? "90 and 270 deg" : "0 and 180 deg";
}

} // namespace

std::string words_for_squareness(double beta_rad, const WordsContext& context) {
    const bool open = beta_rad > 0;
    return "The + directions of " + context.axes[0] + " and " + context.axes[1] + " enclose " +
           digits(std::fabs(beta_rad) * 1e6) + " urad (" +
           digits(std::fabs(beta_rad) * 180 * 3600 / std::numbers::pi) + " arcsec) " +
           (open ? "more" : "less") + " than 90 deg: an ellipse with its long axis at " +
           (open ? "135/315" : "45/225") + " deg, alike in both senses.";
}

std::string words_for_scale_mismatch(double mismatch, const WordsContext& context) {
    const int longer = mismatch > 0 ? 0 : 1;
    return moving(longer, context) + " travels " + digits(std::fabs(mismatch) * 1e6) +
           " um/m farther than " + other(longer, context) + " for the same command, " +
           um(2 * context.nominal_radius_mm * mismatch) +
           " over the diameter: an ellipse with its long axis along " + moving(longer, context) +
           ", alike in both senses.";
}

namespace {

std::string time_text(double seconds) {
    const TimeUnit unit = time_unit(seconds);
    return digits(std::fabs(seconds) * unit.a_second) + " " + unit.word;
}

} // namespace

TimeUnit time_unit(double seconds) {
    constexpr double a_tenth_of_ms = 1e-4, a_tenth_of_us = 1e-7;
    const double size = std::fabs(seconds);
    if (size >= a_tenth_of_ms || size == 0) return {1e3, "ms"};
    return size >= a_tenth_of_us ? TimeUnit{1e6, "us"} : TimeUnit{1e9, "ns"};
}

std::string words_for_servo_lag(double difference_s, const WordsContext& context) {
    const int slower = difference_s > 0 ? 0 : 1;
    const bool first = slower == 0;
    return moving(slower, context) + " lags " + other(slower, context) + " by " +
           time_text(difference_s) + ": an ellipse with its long axis at " +
           (first ? "45/225" : "135/315") + " deg in counter-clockwise and at " +
           (first ? "135/315" : "45/225") + " deg in clockwise sense, growing with the feed.";
}

std::string words_for_backlash(int axis, double lost_mm, const WordsContext& context) {
    const bool lost = lost_mm > 0;
    return moving(axis, context) + (lost ? " loses " : " gains ") + um(lost_mm) +
           " when it reverses" + (lost ? "" : " (over-compensated)") + ": the trace steps " +
           (lost ? "outward" : "inward") + " at " + reversal_places(axis) + " in either sense.";
}

std::string words_for_lateral_play(int axis, double play_mm, const WordsContext& context) {
    // P > 0 of the first axis stands out in counter-clockwise sense, of the second in clockwise
    const bool ccw_out = (play_mm > 0) == (axis == 0);
    return "The slide of " + moving(axis, context) + " steps sideways, along " +
           other(axis, context) + ", by " + um(play_mm) + " when it reverses: the " +
           (ccw_out ? "counter-clockwise" : "clockwise") + " trace lies outside the " +
           (ccw_out ? "clockwise" : "counter-clockwise") + " one, most at " + middle_places(axis) +
           ".";
}

std::string words_for_straightness(int axis, double bow_mm, const WordsContext& context) {
    return "The path of " + moving(axis, context) + " is bowed by " + um(bow_mm) + " over " +
           digits(2 * context.nominal_radius_mm) + " mm, its middle toward " +
           (bow_mm > 0 ? "+" : "-") + other(axis, context) +
           ": three lobes, alike in both senses." +
           (context.whole_travel[axis == 0 ? 0 : 1]
                ? ""
                : " The arc does not hold both ends of that travel: the bow is extrapolated.");
}

std::string words_for_cyclic(const CyclicError& cyclic, const WordsContext& context) {
    return moving(cyclic.axis, context) + " has a periodic error of " +
           um(2 * cyclic.amplitude_mm) + " peak to valley with a period of " +
           digits(cyclic.pitch_mm) + " mm of its travel.";
}

std::string words_for_lobes(const Lobes& lobes) {
    return "The trace has " + std::to_string(lobes.per_turn) + " lobes of " +
           um(2 * lobes.amplitude_mm) +
           " peak to valley, even in angle: chatter, a loose set-up or the instrument, no axis.";
}

std::string words_for_spike(const Reversal& reversal, const WordsContext& context) {
    return "After " + moving(reversal.axis, context) + " reverses at " + digits(reversal.at_deg) +
           " deg in sense " + std::string{name_of(reversal.sense)} + " the trace has a spike of " +
           um(reversal.spike_mm) + (reversal.spike_mm < 0 ? " inward, " : " outward, ") +
           digits(reversal.spike_width_deg) + " deg or " + digits(reversal.spike_width_ms) +
           " ms wide.";
}

std::string words_for_change_over(const ChangeOver& step) {
    return "The trace steps " + um(step.step_mm) + (step.step_mm > 0 ? " outward" : " inward") +
           " at " + digits(step.at_deg) + " deg in sense " + std::string{name_of(step.sense)} +
           ", where one axis hands the lead to the other.";
}

std::string words_for_vibration(const Vibration& vibration) {
    return "Faster than 0.5 per degree the trace moves by " + um(vibration.rms_mm) + " rms, " +
           um(vibration.peak_to_valley_mm) +
           " peak to valley: vibration, and the noise of the readings.";
}

std::string words_for_group(const InseparableGroup& group) {
    std::string names;
    for (const Cause cause : group.causes)
        names += (names.empty() ? "" : ", ") + std::string{key_of(cause)};
    return "These readings do not tell apart " + names + "; together they make " +
           um(group.peak_to_valley_mm) + " peak to valley.";
}

} // namespace axiscal::circular

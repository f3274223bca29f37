#pragma once
// One sentence for each cause, in the signs of cause.hpp. Pure.

#include "analysis/circular/circle_diagnosis.hpp"

#include <string>

namespace axiscal::circular {

/// Largest travel that a cause is told of, and the names of the axes.
struct WordsContext {
    AxisNames axes{"X", "Y"};
    double nominal_radius_mm = 0;
    /// Whether the readings reach both ends of the first, of the second axis' travel.
    std::array<bool, 2> whole_travel{true, true};
};

/// The unit that leaves a number people read: 21.84 ns, never 2.184e-05 ms.
struct TimeUnit {
    double a_second = 1e3; ///< how many make a second
    std::string word = "ms";
};
TimeUnit time_unit(double seconds);

std::string words_for_squareness(double beta_rad, const WordsContext& context);
/// mismatch: scale error of the first axis minus that of the second.
std::string words_for_scale_mismatch(double mismatch, const WordsContext& context);
std::string words_for_servo_lag(double difference_s, const WordsContext& context);
std::string words_for_backlash(int axis, double lost_mm, const WordsContext& context);
std::string words_for_lateral_play(int axis, double play_mm, const WordsContext& context);
std::string words_for_straightness(int axis, double bow_mm, const WordsContext& context);
std::string words_for_cyclic(const CyclicError& cyclic, const WordsContext& context);
std::string words_for_lobes(const Lobes& lobes);
std::string words_for_spike(const Reversal& reversal, const WordsContext& context);
std::string words_for_change_over(const ChangeOver& step);
std::string words_for_vibration(const Vibration& vibration);
std::string words_for_group(const InseparableGroup& group);

} // namespace axiscal::circular

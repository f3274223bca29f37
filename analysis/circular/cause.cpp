#include "analysis/circular/cause.hpp"

namespace axiscal::circular {
namespace {

double sign_of(double value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

constexpr std::array<std::string_view, cause_count> keys{
    "center_ccw_mm[0]",  "center_ccw_mm[1]", "center_cw_mm[0]",   "center_cw_mm[1]",
    "scale_x",           "scale_y",          "squareness_rad",    "servo_lag_difference_s",
    "backlash_x_mm",     "backlash_y_mm",    "lateral_play_x_mm", "lateral_play_y_mm",
    "straightness_x_mm", "straightness_y_mm"};

} // namespace

std::string_view key_of(Cause cause) {
    return keys[static_cast<std::size_t>(cause)];
}

std::array<double, cause_count>
effects_at(const Aspect& at, double nominal_radius_mm, double feed_mm_per_s) {
    const double c = at.cosine, s = at.sine, radius = nominal_radius_mm;
    const double toward_x = -at.sense * sign_of(s), toward_y = at.sense * sign_of(c);
    const double ccw = at.sense > 0 ? 1 : 0, cw = 1 - ccw;
    return {ccw * c,
            ccw * s,
            cw * c,
            cw * s,
            radius * c * c,
            radius * s * s,
            -radius * s * c,
            at.sense * feed_mm_per_s * s * c,
            -toward_x * c / 2,
            -toward_y * s / 2,
            -toward_x * s / 2,
            -toward_y * c / 2,
            s * s * s,
            c * c * c};
}

} // namespace axiscal::circular

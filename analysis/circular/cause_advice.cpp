#include "analysis/circular/cause_advice.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

namespace axiscal::circular {
namespace {

/// 0 for "..._x", 1 for "..._y".
std::size_t axis_of(std::string_view cause) {
    return cause.ends_with("_y") ? 1 : 0;
}

bool positive(const CircleDiagnosis& diagnosis, Cause cause) {
    return diagnosis.of(cause).value.value_or(0) > 0;
}

std::string about_backlash(bool lost, const std::string& axis) {
    if (!lost)
        return "The control gives " + axis +
               " more than it loses: lower its backlash compensation by this amount, then drive "
               "the "
               "circle again.";
    return "Look at the drive of " + axis +
           ": preload of nut and thrust bearing, coupling, belt, clamping of scale and reader. "
           "What "
           "is then left goes into the control's backlash compensation, added to what stands "
           "there.";
}

std::string about_scales(const CircleDiagnosis& diagnosis, const AxisNames& axes) {
    const double first = diagnosis.of(Cause::scale_x).value.value_or(0);
    const double second = diagnosis.of(Cause::scale_y).value.value_or(0);
    return "Measure both axes with a laser; look at the temperatures of screws and scales and at "
           "the "
           "linear compensation of " +
           (first > second ? axes[0] : axes[1]) +
           ". Drive the circle again when the machine has reached its temperature.";
}

std::string about_lag(const CircleDiagnosis& diagnosis, const AxisNames& axes) {
    const bool first_lags = positive(diagnosis, Cause::servo_lag_difference);
    return "Give both axes one position-loop gain (Kv): raise that of " +
           (first_lags ? axes[0] : axes[1]) +
           ", or lower the other; compare their feed-forward and filters. Drive the circle at half "
           "the feed: the error must halve.";
}

std::string about_axis(std::string_view cause, const AxisNames& axes) {
    const std::string& axis = axes[axis_of(cause)];
    if (cause.starts_with("lateral_play"))
        return "Adjust the gibs or the preload of the guideway of " + axis +
               "; look for wear, and whether nut and screw stand in line with the guideway.";
    if (cause.starts_with("straightness"))
        return "Look at level and clamping of the bed and at the guideway of " + axis +
               "; measure its straightness. Drive the circle again after mounting the instrument "
               "anew: a loose set-up makes three lobes, too.";
    return "Compare the period with the pitch of the screw of " + axis +
           ", its gears and the signal period of its scale; look at a bent screw, the coupling and "
           "the signals of the reader.";
}

} // namespace

std::string title_of(const CauseContribution& contribution, const AxisNames& axes) {
    const std::string_view cause = contribution.cause;
    const std::string& axis = axes[axis_of(cause)];
    if (cause == "squareness") return "Squareness of " + axes[0] + " and " + axes[1];
    if (cause == "scale_mismatch") return "Scale mismatch of " + axes[0] + " and " + axes[1];
    if (cause == "servo_lag_difference") return "Servo mismatch";
    if (cause.starts_with("backlash")) return "Backlash " + axis;
    if (cause.starts_with("lateral_play")) return "Lateral play " + axis;
    if (cause.starts_with("straightness")) return "Straightness " + axis;
    if (cause.starts_with("cyclic")) return "Periodic error " + axis;
    if (cause == "lobes") return "Even lobes";
    if (cause == "reversal_spikes") return "Reversal spikes";
    if (cause == "change_over") return "Change-over of the lead";
    if (cause == "vibration") return "Vibration and noise";
    return "Not told apart";
}

std::string advice_for(const CauseContribution& contribution,
                       const CircleDiagnosis& diagnosis,
                       const AxisNames& axes) {
    const std::string_view cause = contribution.cause;
    if (cause == "squareness")
        return "Level the machine and measure with a square or along the diagonals, then align the "
               "ways or enter the angle as squareness compensation.";
    if (cause == "scale_mismatch") return about_scales(diagnosis, axes);
    if (cause == "servo_lag_difference") return about_lag(diagnosis, axes);
    if (cause == "backlash_x")
        return about_backlash(positive(diagnosis, Cause::backlash_x), axes[0]);
    if (cause == "backlash_y")
        return about_backlash(positive(diagnosis, Cause::backlash_y), axes[1]);
    if (cause == "lobes")
        return "Tighten the instrument's joints and the tool; drive at another feed: lobes of the "
               "set-up stay, those of chatter change their number.";
    if (cause == "reversal_spikes")
        return "The axis sticks before it turns: look at lubrication and guideway friction, then "
               "tune the control's friction (quadrant) compensation.";
    if (cause == "change_over")
        return "Look at how the control hands the lead from one axis to the other; drive at "
               "another feed: the place stays.";
    if (cause == "vibration")
        return "Drive at another feed and with the spindle and pumps off; what stays is the "
               "instrument's own noise or a control loop set too tight.";
    if (cause == "not_separable")
        return "Drive a full circle in both senses: then each of them is determined by itself.";
    return about_axis(cause, axes);
}

std::string with_names(std::string words, const AxisNames& axes) {
    for (std::size_t i = 0; i < cause_count; ++i) {
        const std::string_view key = key_of(static_cast<Cause>(i));
        const std::string name = on_paper(static_cast<Cause>(i), axes).name;
        for (auto at = words.find(key); at != std::string::npos; at = words.find(key, at + 1)) {
            const bool whole = at == 0 || words[at - 1] == ' ';
            if (whole) words.replace(at, key.size(), name);
        }
    }
    return words;
}

CauseOnPaper on_paper(Cause cause, const AxisNames& axes) {
    constexpr double micro = 1e6, milli = 1e3, arc_seconds = 180 * 3600 / std::numbers::pi;
    const std::string &x = axes[0], &y = axes[1];
    const auto bow = [](const std::string& of, const std::string& toward) {
        return "the path of " + of + " is bowed, its middle toward +" + toward;
    };
    switch (cause) {
    case Cause::center_ccw_x:
        return {"Centre, CCW, " + x, "µm", milli, "the circle lies toward +" + x};
    case Cause::center_ccw_y:
        return {"Centre, CCW, " + y, "µm", milli, "the circle lies toward +" + y};
    case Cause::center_cw_x:
        return {"Centre, CW, " + x, "µm", milli, "the circle lies toward +" + x};
    case Cause::center_cw_y:
        return {"Centre, CW, " + y, "µm", milli, "the circle lies toward +" + y};
    case Cause::scale_x: return {"Scale " + x, "µm/m", micro, x + " travels too far"};
    case Cause::scale_y: return {"Scale " + y, "µm/m", micro, y + " travels too far"};
    case Cause::squareness:
        return {"Squareness", "″", arc_seconds, "+" + x + " and +" + y + " enclose more than 90°"};
    case Cause::servo_lag_difference: return {"Lag difference", "ms", milli, x + " lags " + y};
    case Cause::backlash_x: return {"Backlash " + x, "µm", milli, "lost motion; below 0 gained"};
    case Cause::backlash_y: return {"Backlash " + y, "µm", milli, "lost motion; below 0 gained"};
    case Cause::lateral_play_x:
        return {"Lateral play " + x, "µm", milli, "CCW lies outside CW, most at 90 and 270°"};
    case Cause::lateral_play_y:
        return {"Lateral play " + y, "µm", milli, "CW lies outside CCW, most at 0 and 180°"};
    case Cause::straightness_x: return {"Straightness " + x, "µm", milli, bow(x, y)};
    case Cause::straightness_y: break;
    }
    return {"Straightness " + y, "µm", milli, bow(y, x)};
}

} // namespace axiscal::circular

// What is asked of the reading while the axis or the ballbar stands.
#include "acquisition/station/preflight_checks.hpp"

#include "acquisition/capture/wording.hpp"
#include "analysis/drift/drift.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal::preflight_checks {
namespace {

constexpr double longest_break = 0.5; // of a window: what happened meanwhile nobody knows

/// The standing axis's readings in micrometres that span the drift window until now: also the last
/// one before it. Times are seconds since its beginning.
DriftSeries readings_of_the_laser(const PreflightFacts& facts) {
    const MonotonicTime begin = facts.now - facts.config.preflight.drift_window;
    DriftSeries series;
    for (const Sample& sample : facts.laser_samples) {
        const auto reading_m = sample.value();
        const double at_s = seconds_of(sample.at - begin);
        if (!reading_m || (!series.times.empty() && at_s <= series.times.back())) continue;
        if (at_s <= 0) series = {}; // only the last one before the window is of use
        series.times.push_back(at_s);
        series.readings.push_back(*reading_m * 1e6);
    }
    return series;
}

/// No more than some thousand readings, evenly taken: a line needs no more, and the loop no wait.
DriftSeries thinned(const DriftSeries& series) {
    constexpr std::size_t enough = 1000;
    const std::size_t stride = series.times.size() / enough + 1;
    DriftSeries few;
    for (std::size_t i = 0; i < series.times.size(); i += stride) {
        few.times.push_back(series.times[i]);
        few.readings.push_back(series.readings[i]);
    }
    return few;
}

bool spans_window(const DriftSeries& series, double window_s) {
    if (series.times.size() < 2 || window_s - series.times.front() < window_s * nearly_whole)
        return false;
    double longest_s = window_s - series.times.back();
    for (std::size_t i = 1; i < series.times.size(); ++i)
        longest_s = std::max(longest_s, series.times[i] - series.times[i - 1]);
    return longest_s <= window_s * longest_break;
}

/// The standing bar's good readings within the window, in micrometres.
DriftSeries readings_of_the_bar(const PreflightFacts& facts) {
    constexpr double um_per_m = 1e6;
    DriftSeries series = facts.bar != nullptr
                             ? facts.bar->last(facts.config.preflight.drift_window, facts.now)
                             : DriftSeries{};
    for (double& reading : series.readings)
        reading *= um_per_m;
    return series;
}

} // namespace

PreflightRecord check_drift(const PreflightFacts& facts) {
    const PreflightConfig& limits = facts.config.preflight;
    if (limits.drift_window <= Duration{})
        return passed("drift", "Not asked: preflight.drift_window is 0.");
    if (facts.polygon)
        return passed("drift", facts.faces_read
                                   ? "Not judged: the autocollimator sees a face at targets alone."
                                   : "Not judged: a person reads the autocollimator.");
    constexpr double moved_um = 50; // no drift: the axis was driven
    const DriftSeries series =
        facts.circular ? readings_of_the_bar(facts) : readings_of_the_laser(facts);
    const double window_s = seconds_of(limits.drift_window);
    if (facts.circular && series.times.empty())
        return passed("drift", "Not judged: at rest the ballbar gives no reading in its range.");
    if (!spans_window(series, window_s))
        return failed("drift", "The " + length_word_of(facts) + " has been read for less than " +
                                   in_minutes(limits.drift_window) + " without a break. Wait.");
    if (total_range(series).range > moved_um)
        return failed("drift", "The axis moved within the last " + in_minutes(limits.drift_window) +
                                   (facts.circular ? ". Let the machine rest beside the circle."
                                                   : ". Let it stand at its datum."));
    const double change_um = slope_of(thinned(series)) * window_s;
    const std::string seen =
        std::string{"The reading of the standing "} + (facts.circular ? "ballbar" : "axis") +
        " drifts by " + plain_number(change_um, 2) + " um in " + in_minutes(limits.drift_window);
    if (std::fabs(change_um) <= limits.drift_limit.in(um)) return passed("drift", seen + ".");
    return failed("drift", seen + ", " + in_um(limits.drift_limit) + " are allowed. Let " +
                               length_word_of(facts) + " and machine warm up.");
}

} // namespace axiscal::preflight_checks

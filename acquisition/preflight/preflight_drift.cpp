// What is asked of the reading while the axis or the ballbar stands.
#include "acquisition/preflight/preflight_checks.hpp"

#include "acquisition/capture/wording.hpp"
#include "analysis/drift/drift.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace axiscal::preflight_checks {
namespace {

constexpr double longest_break = 0.5; // of a window: what happened meanwhile nobody knows

/// The standing axis's readings in micrometres that span the drift window until now: some thousand,
/// evenly taken, for a line needs no more and the loop no wait, and the last one before it. Times
/// are seconds since the window's beginning.
DriftSeries readings_of_the_laser(const PreflightFacts& facts) {
    constexpr std::size_t enough = 1000;
    const MonotonicTime begin = facts.now - facts.config.preflight.drift_window;
    const auto& samples = facts.laser_samples;
    const auto is_good = [](const Sample& sample) { return sample.value().has_value(); };
    const auto inside = std::ranges::partition_point(
        samples, [begin](const Sample& sample) { return sample.at <= begin; });
    const auto before = std::find_if(std::reverse_iterator{inside}, samples.rend(), is_good);
    const auto stride = (samples.end() - inside) / static_cast<std::ptrdiff_t>(enough) + 1;
    DriftSeries series;
    auto next = before == samples.rend() ? inside : std::prev(before.base());
    while ((next = std::find_if(next, samples.end(), is_good)) != samples.end()) {
        const double at_s = seconds_of(next->at - begin);
        if (series.times.empty() || at_s > series.times.back()) {
            series.times.push_back(at_s);
            series.readings.push_back(*next->value() * 1e6);
        }
        next += std::min(next < inside ? 1 : stride, samples.end() - next);
    }
    return series;
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
    if (std::max(total_range(series).range, facts.laser_range.in(um)) > moved_um)
        return failed("drift", "The axis moved within the last " + in_minutes(limits.drift_window) +
                                   (facts.circular ? ". Let the machine rest beside the circle."
                                                   : ". Let it stand at its datum."));
    const double change_um = slope_of(series) * window_s;
    const std::string seen =
        std::string{"The reading of the standing "} + (facts.circular ? "ballbar" : "axis") +
        " drifts by " + plain_number(change_um, 2) + " um in " + in_minutes(limits.drift_window);
    if (std::fabs(change_um) <= limits.drift_limit.in(um)) return passed("drift", seen + ".");
    return failed("drift", seen + ", " + in_um(limits.drift_limit) + " are allowed. Let " +
                               length_word_of(facts) + " and machine warm up.");
}

} // namespace axiscal::preflight_checks

#include "analysis/circular/capture_effect.hpp"

#include "analysis/circular/circular_parameters.hpp"
#include "analysis/linear/length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace axiscal {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array undulations{2, 5, 15, 50, 150, 500};
constexpr double one_percent_gain = 0.99;
constexpr double settling_times = 6; ///< of a first order: 0.25 % of a step is left
constexpr double widest_steps = 1.5; ///< of the median: beyond it readings are missing
constexpr double least_share = 0.5;  ///< of the readings, that the comparison needs
/// Of a centred mean of three readings, weight of each neighbour: beyond it the middle one weighs
/// less than three quarters, and the mean is no picture of the filter.
constexpr double most_weight = 0.125;

double time_constant_s(const CircularCapture& capture) {
    return capture.low_pass_hz ? 1 / (2 * pi * *capture.low_pass_hz) : 0;
}

/// Second moment of n evenly spaced readings over T about their middle.
double mean_spread_s2(const CircularCapture& capture) {
    if (capture.averaged <= 1 || !(capture.sample_rate_hz > 0)) return 0;
    const double period_s = 1 / capture.sample_rate_hz, n = capture.averaged;
    return period_s * period_s / 12 * (1 - 1 / (n * n));
}

double median_of(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

std::vector<double> steps_s(const CircularTrace& trace, double angle_per_s) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < trace.angle_rad.size(); ++i)
        steps.push_back(std::fabs(trace.angle_rad[i] - trace.angle_rad[i - 1]) / angle_per_s);
    return steps;
}

/// Exact for what bends like a parabola over three readings.
std::vector<double> three_point_mean(const std::vector<double>& x,
                                     const std::vector<double>& steps,
                                     double spread_s2,
                                     double widest_s) {
    std::vector<double> mean = x;
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
        if (steps[i - 1] > widest_s || steps[i] > widest_s || !(steps[i] > 0)) continue;
        const double weight = std::min(spread_s2 / (2 * steps[i] * steps[i]), most_weight);
        mean[i] = x[i] + weight * (x[i - 1] - 2 * x[i] + x[i + 1]);
    }
    return mean;
}

/// A first order by the trapezoidal rule; it begins anew behind a gap.
std::vector<double> first_order(const std::vector<double>& x,
                                const std::vector<double>& steps,
                                double time_constant_s,
                                double widest_s) {
    std::vector<double> y = x;
    for (std::size_t i = 1; i < x.size(); ++i) {
        const double step_s = steps[i - 1];
        if (step_s > widest_s) continue;
        y[i] =
            y[i - 1] + step_s * (x[i] + x[i - 1] - 2 * y[i - 1]) / (2 * time_constant_s + step_s);
    }
    return y;
}

/// Which readings lie so far behind the first one, and behind a gap, that the filter has settled.
std::vector<bool> settled(const std::vector<double>& steps, double settling_s, double widest_s) {
    std::vector<bool> kept{settling_s <= 0};
    double since_s = 0;
    for (const double step_s : steps) {
        since_s = step_s > widest_s ? 0 : since_s + step_s;
        kept.push_back(since_s >= settling_s);
    }
    return kept;
}

CircularTrace kept_of(const CircularTrace& trace, const std::vector<bool>& kept) {
    CircularTrace out;
    out.sense = trace.sense;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (!kept[i]) continue;
        out.angle_rad.push_back(trace.angle_rad[i]);
        out.radial_deviation_mm.push_back(trace.radial_deviation_mm[i]);
    }
    return out;
}

double turns_per_s(const CircularTest& test) {
    return test.feed_mm_per_s / (2 * pi * test.nominal_radius_mm);
}

/// The gain falls without a break up to the first frequency of which nothing, or 1/sqrt(2), is
/// left.
double one_percent_hz(const CircularCapture& capture) {
    double low = 0, high = capture.low_pass_hz.value_or(capture.sample_rate_hz);
    if (capture.averaged > 1) high = std::min(high, capture.sample_rate_hz);
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (capture_gain(capture, middle) > one_percent_gain ? low : high) = middle;
    }
    return low;
}

/// Empty with a sentence where the comparison has too little to compare.
std::map<std::string, double>
changes_of(const CircularTest& test, const CircularCapture& capture, std::string& not_known) {
    CircularTest once = test, again = test;
    for (std::size_t i = 0; i < test.traces.size(); ++i) {
        DoneAgain done =
            done_again(test.traces[i], capture, test.nominal_radius_mm, test.feed_mm_per_s);
        const auto all = static_cast<double>(test.traces[i].angle_rad.size());
        if (static_cast<double>(done.once.angle_rad.size()) < least_share * all) {
            not_known = "The low pass is so slow that it settles on no half of a circle: what it "
                        "does to G cannot be told from the readings.";
            return {};
        }
        once.traces[i] = std::move(done.once);
        again.traces[i] = std::move(done.again);
    }
    // F about the set-up centre is possible on every arc; it is not looked at.
    const auto before = evaluate_circular(once, RadialCentre::set_up);
    const auto behind = evaluate_circular(again, RadialCentre::set_up);
    if (!before || !behind) {
        not_known = "G of the readings that were averaged and filtered once more could not be "
                    "evaluated.";
        return {};
    }
    std::map<std::string, double> changes;
    const auto add = [&](const char* key, const CircularDeviation& a, const CircularDeviation& b) {
        changes[key] = b.minimum_zone_mm - a.minimum_zone_mm;
    };
    if (before->ccw && behind->ccw) add("G_ccw", before->ccw->G, behind->ccw->G);
    if (before->cw && behind->cw) add("G_cw", before->cw->G, behind->cw->G);
    if (before->G_b && behind->G_b) add("G_b", *before->G_b, *behind->G_b);
    return changes;
}

} // namespace

double capture_gain(const CircularCapture& capture, double frequency_hz) {
    double gain = 1;
    if (capture.averaged > 1) {
        const double phase = pi * frequency_hz / capture.sample_rate_hz, n = capture.averaged;
        const double below = n * std::sin(phase / n);
        if (std::fabs(below) > 1e-12) gain = std::fabs(std::sin(phase) / below);
    }
    if (capture.low_pass_hz) gain /= length_in_plane(1.0, frequency_hz / *capture.low_pass_hz);
    return gain;
}

DoneAgain done_again(const CircularTrace& trace,
                     const CircularCapture& capture,
                     double nominal_radius_mm,
                     double feed_mm_per_s) {
    const double angle_per_s = feed_mm_per_s / nominal_radius_mm;
    const std::vector<double> steps = steps_s(trace, angle_per_s);
    const double median_s = median_of(steps), widest_s = widest_steps * median_s;
    double spread_s2 = mean_spread_s2(capture), delay_s = time_constant_s(capture);
    if (median_s > 2 * delay_s) { // faster than the readings: only its second moment is seen
        spread_s2 += delay_s * delay_s;
        delay_s = 0;
    }
    CircularTrace again = trace;
    again.radial_deviation_mm =
        three_point_mean(trace.radial_deviation_mm, steps, spread_s2, widest_s);
    if (delay_s > 0) {
        again.radial_deviation_mm =
            first_order(again.radial_deviation_mm, steps, delay_s, widest_s);
        const bool rising = trace.angle_rad.back() > trace.angle_rad.front();
        for (double& angle : again.angle_rad)
            angle += (rising ? -1 : 1) * delay_s * angle_per_s;
    }
    std::vector<bool> kept = settled(steps, settling_times * delay_s, widest_s);
    if (spread_s2 > 0) kept.front() = kept.back() = false; // they have one neighbour only
    return {kept_of(trace, kept), kept_of(again, kept)};
}

CaptureEffect capture_effect(const CircularTest& test, const CircularCapture& capture) {
    CaptureEffect effect;
    effect.capture = capture;
    if (!is_changed(capture)) return effect;
    if (capture.averaged > 1 && !(capture.sample_rate_hz > 0)) {
        effect.not_known = "The sampling rate is not known: nor is the time that the averaged "
                           "readings span, or what it costs of G.";
        return effect;
    }
    const double turn_hz = turns_per_s(test);
    for (const int count : undulations)
        effect.gains.push_back({count, count * turn_hz, capture_gain(capture, count * turn_hz)});
    effect.one_percent_per_revolution = one_percent_hz(capture) / turn_hz;
    effect.done_again_mm = changes_of(test, capture, effect.not_known);
    return effect;
}

} // namespace axiscal

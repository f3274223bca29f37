#include "analysis/circular/circular_run.hpp"

#include "analysis/linear/length.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal {
namespace {

constexpr double one_degree = std::numbers::pi / 180;
constexpr double widest_step_rad = 0.5 * one_degree; ///< to a neighbour that may still be interpolated

const CircleCapture* circle_of(const CircularRun& run, Sense sense, int repeat) {
    for (const auto& circle : run.circles)
        if (!circle.warm_up && circle.trace.sense == sense && circle.repeat == repeat)
            return &circle;
    return nullptr;
}

/// Readings by ascending angle.
struct Curve {
    std::vector<std::pair<double, double>> points;
    explicit Curve(const CircularTrace& trace) {
        points.reserve(trace.angle_rad.size());
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
            points.emplace_back(trace.angle_rad[i], trace.radial_deviation_mm[i]);
        std::ranges::sort(points, {}, &std::pair<double, double>::first);
    }
    /// Absent where a neighbour is too far. At an end the nearest reading stands.
    [[nodiscard]] std::optional<double> at(double angle) const {
        const auto above =
            std::ranges::lower_bound(points, angle, {}, &std::pair<double, double>::first);
        const auto& high = above == points.end() ? points.back() : *above;
        const auto& low = above == points.begin() ? points.front() : *std::prev(above);
        if (std::fabs(high.first - angle) > widest_step_rad ||
            std::fabs(angle - low.first) > widest_step_rad)
            return std::nullopt;
        const double step = high.first - low.first;
        if (above == points.begin() || above == points.end() || step <= 0) return high.second;
        return low.second + (high.second - low.second) * (angle - low.first) / step;
    }
};

CircularTrace mean_of(const std::vector<const CircleCapture*>& circles) {
    const CircularTrace& first = circles.front()->trace;
    CircularTrace mean;
    mean.sense = first.sense;
    std::vector<Curve> others;
    others.reserve(circles.size());
    for (std::size_t i = 1; i < circles.size(); ++i)
        others.emplace_back(circles[i]->trace);
    for (std::size_t i = 0; i < first.angle_rad.size(); ++i) {
        double sum = first.radial_deviation_mm[i];
        const auto add = [&](const Curve& curve) {
            const auto value = curve.at(first.angle_rad[i]);
            sum += value.value_or(0);
            return value.has_value();
        };
        if (!std::ranges::all_of(others, add)) continue;
        mean.angle_rad.push_back(first.angle_rad[i]);
        mean.radial_deviation_mm.push_back(sum / static_cast<double>(circles.size()));
    }
    return mean;
}

CircularTest without_traces(const CircularRun& run) {
    CircularTest test;
    test.nominal_radius_mm = run.plan.nominal_radius_mm;
    test.feed_mm_per_s = run.plan.feed_mm_per_s;
    return test;
}

tl::unexpected<Error> missing_circle(Sense sense, int repeat) {
    return fail(Fault::incomplete_run, "circle " + std::to_string(repeat) + " of sense " +
                                           std::string{name_of(sense)} + " is missing");
}

} // namespace

Result<CircularTest> test_of_repeat(const CircularRun& run, int repeat) {
    CircularTest test = without_traces(run);
    for (const Sense sense : run.plan.senses) {
        const CircleCapture* circle = circle_of(run, sense, repeat);
        if (circle == nullptr) return missing_circle(sense, repeat);
        test.traces.push_back(circle->trace);
    }
    return test;
}

Result<CircularTest> mean_test(const CircularRun& run) {
    CircularTest test = without_traces(run);
    for (const Sense sense : run.plan.senses) {
        std::vector<const CircleCapture*> circles;
        for (int repeat = 1; repeat <= run.plan.repeats; ++repeat) {
            circles.push_back(circle_of(run, sense, repeat));
            if (circles.back() == nullptr) return missing_circle(sense, repeat);
        }
        if (circles.empty()) return missing_circle(sense, 1);
        test.traces.push_back(mean_of(circles));
    }
    return test;
}

std::optional<BarExpansion> expansion_of(const CircularRun& run) {
    const auto& bar = run.bar_temperature.mean_degC;
    const auto& machine = run.machine_temperature.mean_degC;
    if (!bar || !machine || !run.bar.alpha_per_K || !run.machine_alpha_per_K ||
        !(run.bar.length_mm > 0))
        return std::nullopt;
    return BarExpansion{*bar, *machine, *run.bar.alpha_per_K, *run.machine_alpha_per_K,
                        run.bar.length_mm};
}

CircularTrace
centred(const CircularTrace& trace, double nominal_radius_mm, double a_mm, double b_mm) {
    CircularTrace moved = trace;
    for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
        const double radius = nominal_radius_mm + trace.radial_deviation_mm[i];
        const double cosine = std::cos(trace.angle_rad[i]), sine = std::sin(trace.angle_rad[i]);
        moved.radial_deviation_mm[i] =
            length_in_plane(radius * cosine - a_mm, radius * sine - b_mm) - nominal_radius_mm;
    }
    return moved;
}

} // namespace axiscal

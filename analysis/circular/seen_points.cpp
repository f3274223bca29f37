#include "analysis/circular/seen_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::circular {
namespace {

constexpr std::size_t most_points = 40'000;
constexpr std::size_t sectors = 20'000; ///< a multiple of eight
constexpr double degrees = 180 / std::numbers::pi;

SeenPoint seen(double angle, double deviation, Sense sense) {
    return {{std::cos(angle), std::sin(angle), sign_of(sense)}, folded_angle(angle), deviation, 1};
}

/// One point for each sector that was read, by angle.
std::vector<SeenPoint> averaged(const CircularTrace& trace) {
    struct Sum {
        double count = 0, angle = 0, deviation = 0; ///< angle within the sector
    };
    constexpr double width = 2 * std::numbers::pi / static_cast<double>(sectors);
    std::vector<Sum> sums(sectors);
    for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
        const double angle = folded_angle(trace.angle_rad[i]);
        const auto sector = std::min(static_cast<std::size_t>(angle / width), sectors - 1);
        Sum& sum = sums[sector];
        sum.count += 1;
        sum.angle += angle - static_cast<double>(sector) * width;
        sum.deviation += trace.radial_deviation_mm[i];
    }
    std::vector<SeenPoint> means;
    for (std::size_t sector = 0; sector < sectors; ++sector) {
        const auto& [count, angle, deviation] = sums[sector];
        if (count == 0) continue;
        means.push_back(seen(static_cast<double>(sector) * width + angle / count, deviation / count,
                             trace.sense));
        means.back().weight = std::sqrt(count);
    }
    return means;
}

double median_step(const std::vector<SeenPoint>& points) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < points.size(); ++i)
        steps.push_back(points[i].angle_rad - points[i - 1].angle_rad);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    return *middle;
}

} // namespace

std::vector<SeenTrace> see(const CircularTest& test) {
    std::vector<SeenTrace> traces;
    for (const CircularTrace& trace : test.traces) {
        SeenTrace out;
        out.sense = trace.sense;
        if (trace.angle_rad.size() > most_points)
            out.points = averaged(trace);
        else
            for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
                out.points.push_back(
                    seen(trace.angle_rad[i], trace.radial_deviation_mm[i], trace.sense));
        std::ranges::stable_sort(out.points, {}, &SeenPoint::angle_rad);
        out.step_rad = out.points.size() > 1 ? median_step(out.points) : 0;
        traces.push_back(std::move(out));
    }
    return traces;
}

double degrees_past(const SeenPoint& point, double at_deg) {
    double past = point.angle_rad * degrees - at_deg;
    past -= 360 * std::floor((past + 180) / 360);
    return point.aspect.sense > 0 ? past : -past;
}

double degrees_from_reversal(const SeenPoint& point) {
    const double angle = point.angle_rad * degrees;
    return std::fabs(angle - 90 * std::round(angle / 90));
}

} // namespace axiscal::circular

#include "drivers/clock/lower_hull.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

/// Does `b` lie on or above the line from `a` to `c`?
bool not_below(const ClockPoint& a, const ClockPoint& b, const ClockPoint& c) {
    return (b.delay_s - a.delay_s) * (c.device_s - a.device_s) >=
           (c.delay_s - a.delay_s) * (b.device_s - a.device_s);
}

std::vector<ClockPoint> lower_hull(const std::deque<ClockPoint>& points) {
    std::vector<ClockPoint> hull;
    hull.reserve(points.size());
    for (const ClockPoint& point : points) {
        while (hull.size() > 1 && not_below(hull[hull.size() - 2], hull.back(), point))
            hull.pop_back();
        hull.push_back(point);
    }
    return hull;
}

double mean_time(const std::deque<ClockPoint>& points) {
    double sum = 0;
    for (const ClockPoint& point : points)
        sum += point.device_s - points.front().device_s;
    return points.front().device_s + sum / static_cast<double>(points.size());
}

/// The highest line of that slope that no point lies below.
ClockLine touching(const std::deque<ClockPoint>& points, double slope) {
    double delay_s = points.front().delay_s - slope * points.front().device_s;
    for (const ClockPoint& point : points)
        delay_s = std::min(delay_s, point.delay_s - slope * point.device_s);
    return {delay_s, slope};
}

double root_mean_square(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
        sum += value * value;
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

} // namespace

ClockLine line_below(const std::deque<ClockPoint>& points, double steepest) {
    const auto hull = lower_hull(points);
    if (hull.size() < 2) return touching(points, 0);
    const double middle = mean_time(points);
    auto right =
        std::ranges::find_if(hull, [&](const ClockPoint& p) { return p.device_s > middle; });
    right = std::clamp(right, hull.begin() + 1, hull.end() - 1);
    const ClockPoint& left = *(right - 1);
    const double slope = (right->delay_s - left.delay_s) / (right->device_s - left.device_s);
    if (std::abs(slope) > steepest) return touching(points, std::clamp(slope, -steepest, steepest));
    return {left.delay_s - slope * left.device_s, slope};
}

double misfit_of(const ClockLine& line, const std::deque<ClockPoint>& points) {
    constexpr std::size_t parts = 5;
    std::vector<double> least;
    least.reserve(parts);
    for (std::size_t part = 0; part < parts; ++part) {
        const auto begin =
            points.begin() + static_cast<std::ptrdiff_t>(points.size() * part / parts);
        const auto end =
            points.begin() + static_cast<std::ptrdiff_t>(points.size() * (part + 1) / parts);
        if (begin == end) continue;
        double lowest = begin->delay_s - line.at(begin->device_s);
        for (auto at = begin; at != end; ++at)
            lowest = std::min(lowest, at->delay_s - line.at(at->device_s));
        least.push_back(lowest);
    }
    return root_mean_square(least);
}

SawTeeth teeth_on(const ClockLine& line, const std::deque<ClockPoint>& points, double grain_s) {
    constexpr unsigned all_quarters = 0b1110;
    SawTeeth teeth;
    std::vector<double> floors_s;
    const ClockPoint* lowest = nullptr;
    const auto above_s = [&](const ClockPoint& p) { return p.delay_s - line.at(p.device_s); };
    const auto leave = [&] {
        // One that the window cuts off may have been lower before, or be so later.
        const bool whole = lowest != &points.front() && lowest != &points.back();
        if (lowest) ++teeth.begun;
        if (lowest && whole) floors_s.push_back(above_s(*lowest));
        lowest = nullptr;
    };
    unsigned seen = 0;
    for (const ClockPoint& point : points) {
        const double quarter = std::floor(above_s(point) / grain_s * 4);
        if (quarter >= 1 && quarter <= 3) seen |= 1U << static_cast<unsigned>(quarter);
        if (above_s(point) > grain_s / 8) continue;
        if (std::exchange(seen, 0) == all_quarters) leave();
        if (!lowest || above_s(point) < above_s(*lowest)) lowest = &point;
    }
    leave();
    teeth.whole = static_cast<int>(floors_s.size());
    teeth.misfit_s = root_mean_square(floors_s);
    return teeth;
}

} // namespace axiscal

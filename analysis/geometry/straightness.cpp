// Minimum zone: the width of a convex polygon is taken on one of its edges against the vertex
// farthest from it. Positions are distinct, hence no edge of the hull is vertical, and the edges
// of the lower chain (rising slopes) meet their opposite vertices of the upper chain from right to
// left, those of the upper chain theirs of the lower one likewise.

#include "analysis/geometry/straightness.hpp"

#include "analysis/checked_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace axiscal {
namespace {

using Chain = std::vector<std::size_t>;

/// The points, re-based on the first one so that no digits are lost on a far origin.
class Points {
public:
    explicit Points(const MeasuredLine& line)
        : line_{line} {}
    [[nodiscard]] std::size_t size() const { return line_.positions.size(); }
    [[nodiscard]] double x(std::size_t i) const { return line_.positions[i] - x0(); }
    [[nodiscard]] double y(std::size_t i) const { return line_.deviations[i] - y0(); }
    [[nodiscard]] double x0() const { return line_.positions.front(); }
    [[nodiscard]] double y0() const { return line_.deviations.front(); }
    /// Twice the area of a, b, c: positive where c lies above the line a -> b.
    [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
        return (x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a));
    }

private:
    const MeasuredLine& line_;
};

/// side +1: the lower chain of the hull, -1: the upper; left to right, no three on a line.
Chain chain_of(const Points& points, int side) {
    Chain chain;
    for (std::size_t i = 0; i < points.size(); ++i) {
        while (chain.size() >= 2 &&
               side * points.area(chain[chain.size() - 2], chain.back(), i) <= 0)
            chain.pop_back();
        chain.push_back(i);
    }
    return chain;
}

struct Calliper {
    double width = std::numeric_limits<double>::infinity();
    std::size_t left = 0, right = 0, opposite = 0;
    bool edge_is_lower = true;
};

/// Every edge of `chain` against the farthest vertex of `others`.
void try_edges(const Points& points,
               const Chain& chain,
               const Chain& others,
               bool edge_is_lower,
               Calliper& best) {
    const int side = edge_is_lower ? 1 : -1;
    std::size_t k = others.size() - 1;
    for (std::size_t e = 0; e + 1 < chain.size(); ++e) {
        const std::size_t left = chain[e], right = chain[e + 1];
        const auto height = [&](std::size_t at) {
            return side * points.area(left, right, others[at]);
        };
        while (k > 0 && height(k - 1) >= height(k))
            --k;
        const double dx = points.x(right) - points.x(left), dy = points.y(right) - points.y(left);
        const double width = std::max(height(k), 0.0) / std::sqrt(dx * dx + dy * dy);
        if (width < best.width) best = {width, left, right, others[k], edge_is_lower};
    }
}

/// Residuals of y = y0 + middle + slope (x - x0), times `scale`.
ReferenceLine line_with(const Points& points, double slope, double middle, double scale = 1) {
    ReferenceLine line;
    line.slope = slope;
    line.offset = points.y0() + middle - slope * points.x0();
    line.residuals.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        line.residuals.push_back((points.y(i) - (middle + slope * points.x(i))) * scale);
    const auto [low, high] = std::ranges::minmax(line.residuals);
    line.straightness = high - low;
    return line;
}

ReferenceLine end_point_line(const Points& points) {
    const std::size_t last = points.size() - 1;
    return line_with(points, points.y(last) / points.x(last), 0);
}

ReferenceLine least_squares_line(const Points& points) {
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        mean_x += points.x(i), mean_y += points.y(i);
    mean_x /= static_cast<double>(points.size());
    mean_y /= static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double dx = points.x(i) - mean_x;
        xx += dx * dx;
        xy += dx * (points.y(i) - mean_y);
    }
    const double slope = xy / xx;
    return line_with(points, slope, mean_y - slope * mean_x);
}

std::vector<ZonePoint> control_points_of(const Calliper& calliper, std::size_t count) {
    const bool edge_is_upper = !calliper.edge_is_lower;
    if (count == 2) return {{calliper.left, false}, {calliper.right, true}};
    return {{calliper.left, edge_is_upper},
            {calliper.opposite, calliper.edge_is_lower},
            {calliper.right, edge_is_upper}};
}

MinimumZone minimum_zone_of(const Points& points) {
    const Chain lower = chain_of(points, 1), upper = chain_of(points, -1);
    Calliper best;
    try_edges(points, lower, upper, true, best);
    try_edges(points, upper, lower, false, best);
    const double dx = points.x(best.right) - points.x(best.left);
    const double dy = points.y(best.right) - points.y(best.left);
    const double slope = dy / dx, cosine = dx / std::sqrt(dx * dx + dy * dy);
    const double on_edge = points.y(best.left) - slope * points.x(best.left);
    const double half = best.width / cosine / 2; // along the deviation
    const double middle = on_edge + (best.edge_is_lower ? half : -half);
    MinimumZone zone;
    zone.line = line_with(points, slope, middle, cosine);
    zone.control_points = control_points_of(best, points.size());
    zone.gap = zone.line.straightness - best.width;
    return zone;
}

} // namespace

Result<Straightness> straightness_of(const MeasuredLine& line) {
    AXISCAL_CHECK(check_rising(line.positions, "targets"));
    AXISCAL_CHECK(check_case_numbers(line.deviations, "deviations"));
    if (line.deviations.size() != line.positions.size())
        return refuse(Fault::bad_case, "deviations",
                      "has " + std::to_string(line.deviations.size()) + " values for " +
                          std::to_string(line.positions.size()) + " targets");
    if (line.positions.size() < 2)
        return refuse(Fault::bad_case, "targets", "needs at least two positions for a line");
    const Points points{line};
    return Straightness{end_point_line(points), least_squares_line(points),
                        minimum_zone_of(points)};
}

Result<MeasuredLine>
line_of_angles(const std::vector<double>& angles_rad, double base, double start) {
    AXISCAL_CHECK(check_positive(base, "base"));
    AXISCAL_CHECK(check_case_number(start, "start"));
    AXISCAL_CHECK(check_case_numbers(angles_rad, "angles"));
    if (angles_rad.empty()) return refuse(Fault::bad_case, "angles", "is empty");
    MeasuredLine line{{start}, {0}};
    for (std::size_t i = 0; i < angles_rad.size(); ++i) {
        line.positions.push_back(start + base * static_cast<double>(i + 1));
        line.deviations.push_back(line.deviations.back() + base * angles_rad[i]);
    }
    return line;
}

} // namespace axiscal

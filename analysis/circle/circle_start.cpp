#include "analysis/circle/circle_start.hpp"

#include "analysis/linear/length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace axiscal::circle {
namespace {

/// Smallest root, from 0, of Taubin's characteristic polynomial of the moments about the mean.
double taubin_root(const Moments& m) {
    const double z = m.xx + m.yy, determinant = m.xx * m.yy - m.xy * m.xy;
    const double variance = m.zz - z * z;
    const double a3 = 4 * z, a2 = -3 * z * z - m.zz;
    const double a1 = variance * z + 4 * determinant * z - m.xz * m.xz - m.yz * m.yz;
    const double a0 = m.xz * (m.xz * m.yy - m.yz * m.xy) + m.yz * (m.yz * m.xx - m.xz * m.xy) -
                      variance * determinant;
    double root = 0, value = a0;
    for (int i = 0; i < 99; ++i) {
        const double slope = a1 + root * (2 * a2 + 3 * a3 * root);
        const double next = root - value / slope;
        if (next == root || !std::isfinite(next)) break;
        const double next_value = a0 + next * (a1 + next * (a2 + next * a3));
        if (std::fabs(next_value) >= std::fabs(value)) break;
        root = next;
        value = next_value;
    }
    return root;
}

double spread_across(const Moments& m) {
    const double half_trace = (m.xx + m.yy) / 2;
    const double half_width = length_in_plane((m.xx - m.yy) / 2, m.xy);
    return (m.xx * m.yy - m.xy * m.xy) / (half_trace + half_width);
}

double angle_of_spread(const Moments& m) {
    return std::atan2(2 * m.xy, m.xx - m.yy) / 2;
}

/// Whether rounding of the coordinates alone can explain every distance from the line along the
/// greatest spread. Points that are plainly no line are not looked at again.
bool is_line(Values x, Values y, const CheckedPoints& points, const Moments& m) {
    constexpr double plainly = 1e-9;
    if (spread_across(m) > plainly * (m.xx + m.yy)) return false;
    const double angle = angle_of_spread(m), along_x = std::cos(angle), along_y = std::sin(angle);
    double low = 0, high = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double across = (y[i] - y[0]) * along_x - (x[i] - x[0]) * along_y;
        low = std::min(low, across);
        high = std::max(high, across);
    }
    return high - low <= 4 * std::numeric_limits<double>::epsilon() * points.box.magnitude();
}

/// The circle through three points, from the corner between the two shorter sides: moments lose a
/// pair that is close together and far from the third.
SeenCircle
circle_through(std::array<double, 3> x, std::array<double, 3> y, const CheckedPoints& points) {
    const auto side = [&](std::size_t i) { // the one that faces corner i
        return length_in_plane(x[(i + 1) % 3] - x[(i + 2) % 3], y[(i + 1) % 3] - y[(i + 2) % 3]);
    };
    const std::size_t corner = side(0) >= side(1) && side(0) >= side(2) ? 0
                               : side(1) >= side(2)                     ? 1
                                                                        : 2;
    const std::size_t p = (corner + 1) % 3, q = (corner + 2) % 3;
    const double px = x[p] - x[corner], py = y[p] - y[corner];
    const double qx = x[q] - x[corner], qy = y[q] - y[corner];
    const double pp = px * px + py * py, qq = qx * qx + qy * qy, twice = 2 * (px * qy - py * qx);
    const double a = (qy * pp - py * qq) / twice, b = (px * qq - qx * pp) / twice;
    // seen from the mean, with k from the same parts: the circle passes through the corner
    const double dx = x[corner] - points.mean_x, dy = y[corner] - points.mean_y;
    return {points.mean_x,
            points.mean_y,
            a + dx,
            b + dy,
            dx * dx + dy * dy + 2 * (a * dx + b * dy),
            std::sqrt(a * a + b * b)};
}

} // namespace

Result<SeenCircle> starting_circle(Values x, Values y, const CheckedPoints& points) {
    // the mean of long lists has a rounding of its own: the moments say what is left
    const Moments m = moments_about(x, y, points.mean_x, points.mean_y);
    if (is_line(x, y, points, m)) return refuse_line();
    const double extent = points.box.extent();
    if (const auto own = first_distinct(x, y); own.size() == 3) {
        const SeenCircle circle = circle_through({x[own[0]], x[own[1]], x[own[2]]},
                                                 {y[own[0]], y[own[1]], y[own[2]]}, points);
        if (std::isfinite(circle.radius)) return circle; // met exactly, however flat
    }
    const double root = taubin_root(m);
    const double xx = m.xx - root, yy = m.yy - root;
    const double determinant = xx * yy - m.xy * m.xy;
    const double a = (m.xz * yy - m.yz * m.xy) / determinant / 2;
    const double b = (m.yz * xx - m.xz * m.xy) / determinant / 2;
    const double radius = std::sqrt(a * a + b * b + m.xx + m.yy);
    if (std::isfinite(radius) && radius < largest_radius_in_extents * extent)
        return seen_from(points.mean_x, points.mean_y, a, b, radius);
    // nearly straight: a flat arc along the greatest spread, for the refinement to bend
    const double angle = angle_of_spread(m), far = 10 * extent;
    return seen_from(points.mean_x, points.mean_y, -far * std::sin(angle), far * std::cos(angle),
                     far);
}

} // namespace axiscal::circle

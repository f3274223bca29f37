// Let c = (a, b), D = |c|, s = D - R (the circle's point under the origin lies s from it), so that
// k = s (D + R). With the unit vector m = -c / D from the centre towards the origin, the step (x,
// y) has a part p along m and q across it. To first order
//
//   R' = R + inward - (D / R) p        s' = s - inward + (s / R) p        m turns by q / D
//
// Far centres take R' by its curvature, 1/R' = 1/R - (R' - R) / R^2, which is the same to first
// order. Near ones take c' = c + (x, y) and, from the same R',
//
//   k' = k - 2 R inward + (cross(c, step)^2 - k |step|^2) / R^2 - inward^2 - 2 inward (c . step) /
//   R

#include "analysis/circle/seen_circle.hpp"

#include "analysis/linear/length.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal::circle {
namespace {

/// D / R is 0 on a full circle, 0.83 on an arc of 120 deg, 1 on a short one.
constexpr double far_centre = 0.83;

SeenCircle with_center(SeenCircle circle, double a, double b, double k) {
    circle.a = a;
    circle.b = b;
    circle.k = k;
    circle.radius = std::sqrt(std::max(a * a + b * b - k, 0.0));
    return circle;
}

SeenCircle moved_straight(const SeenCircle& c, const CircleStep& step) {
    const double cross = c.a * step.y - c.b * step.x, dot = c.a * step.x + c.b * step.y;
    const double squared_step = step.x * step.x + step.y * step.y;
    const double k = c.k - 2 * c.radius * step.inward +
                     (cross * cross - c.k * squared_step) / (c.radius * c.radius) -
                     step.inward * step.inward - 2 * step.inward * dot / c.radius;
    return with_center(c, c.a + step.x, c.b + step.y, k);
}

SeenCircle moved_by_curvature(const SeenCircle& c, const CircleStep& step, double longest_radius) {
    const double far = length_in_plane(c.a, c.b);
    const double mx = -c.a / far, my = -c.b / far;
    const double along = step.x * mx + step.y * my, across = step.y * mx - step.x * my;
    const double s = c.k / (far + c.radius);
    const double longer = step.inward - far / c.radius * along;
    double curvature = (1 - longer / c.radius) / c.radius;
    if (std::fabs(curvature) * longest_radius < 1)
        curvature = std::copysign(1 / longest_radius, curvature);
    const double radius = 1 / curvature; // negative: the centre has passed to the other side
    const double foot = s - step.inward + s / c.radius * along;
    // the centre moves by q across m, so m turns the other way
    const double turn_x = -(c.a - across * my), turn_y = -(c.b + across * mx);
    const double length = length_in_plane(turn_x, turn_y);
    const double new_far = radius + foot;
    SeenCircle out = c;
    out.a = -turn_x / length * new_far;
    out.b = -turn_y / length * new_far;
    out.k = foot * (new_far + radius);
    out.radius = std::fabs(radius);
    return out;
}

} // namespace

SeenCircle seen_from(double origin_x, double origin_y, double a, double b, double radius) {
    const double far = length_in_plane(a, b);
    return {origin_x, origin_y, a, b, (far - radius) * (far + radius), radius};
}

SeenCircle swollen(const SeenCircle& circle, double by) {
    SeenCircle out = circle;
    out.k -= by * (2 * circle.radius + by);
    out.radius += by;
    return out;
}

bool is_far(const SeenCircle& circle) {
    return length_in_plane(circle.a, circle.b) > far_centre * circle.radius;
}

SeenCircle moved(const SeenCircle& circle, const CircleStep& step, double longest_radius) {
    return is_far(circle) ? moved_by_curvature(circle, step, longest_radius)
                          : moved_straight(circle, step);
}

} // namespace axiscal::circle

#pragma once
// Moves a circle by a small step without losing digits, however far away its centre is. Pure.

#include "analysis/circle/point_kernels.hpp"

#include <optional>

namespace axiscal::circle {

/// To first order the distance e of a point becomes e - v . (x, y) - inward, v as in Residuals.
struct CircleStep {
    double x = 0, y = 0;
    double inward = 0; ///< how much nearer to the circle a point straight above the origin comes
};

/// Radii beyond this many extents are taken for a straight line.
constexpr double largest_radius_in_extents = 1e6;

/// Made of centre and radius; loses digits of k where the centre is far, hence only for starts.
SeenCircle seen_from(double origin_x, double origin_y, double a, double b, double radius);

/// The circle with a radius larger by this much.
SeenCircle swollen(const SeenCircle& circle, double by);

/// Whether the centre lies outside the points so far that its curvature moves better than itself.
bool is_far(const SeenCircle& circle);

/// On long arcs the centre moves straight. On short ones, where it lies far outside the points,
/// its curvature 1/R, its direction and the foot point under the origin do: a radius may then grow
/// beyond all bounds and come back with the opposite curvature.
/// Curvatures below 1 / `longest_radius` are held there.
SeenCircle moved(const SeenCircle& circle, const CircleStep& step, double longest_radius);

} // namespace axiscal::circle

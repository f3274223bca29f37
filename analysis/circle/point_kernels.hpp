#pragma once
// Sums over all points of a circle, lane by lane and added up in one order: the same bits whatever
// the compiler does. Pure.

#include <cstddef>
#include <span>

namespace axiscal::circle {

/// Bounds and sums; a NaN or infinity anywhere makes a sum not finite.
struct Survey {
    double low_x = 0, high_x = 0, low_y = 0, high_y = 0;
    double sum_x = 0, sum_y = 0;
};
/// At least one point.
Survey survey(std::span<const double> x, std::span<const double> y);

/// Means of products of X = x - origin_x, Y = y - origin_y and Z = X^2 + Y^2.
struct Moments {
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, zz = 0;
};
Moments moments_about(std::span<const double> x,
                      std::span<const double> y,
                      double origin_x,
                      double origin_y);

/// A circle seen from an origin amid its points: centre (a, b) and k = a^2 + b^2 - R^2. With
/// F = X^2 + Y^2 - 2 (a X + b Y) + k the distance from the circle is F / (d + R), d = sqrt(F +
/// R^2): no digits are lost where the centre lies far away.
struct SeenCircle {
    double origin_x = 0, origin_y = 0;
    double a = 0, b = 0, k = 0;
    double radius = 0;
};

/// Means over the points, with e the distance from the circle (outward positive), u the unit vector
/// from the centre and v = u minus that towards the origin, which is (-a, -b) / R.
struct Residuals {
    double e = 0, ee = 0, vx = 0, vy = 0, vxx = 0, vxy = 0, vyy = 0, ex = 0, ey = 0;
    double bxx = 0, bxy = 0, byy = 0; ///< of (e / d) (1 - u u^T): how distances curve
};
Residuals residuals_of(std::span<const double> x, std::span<const double> y, const SeenCircle& c);

/// The same without the curving, at half the price. For circles whose centre is not far from the
/// points: e is a plain difference d - R.
Residuals
plain_residuals_of(std::span<const double> x, std::span<const double> y, const SeenCircle& c);

} // namespace axiscal::circle

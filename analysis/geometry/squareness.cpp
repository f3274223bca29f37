#include "analysis/geometry/squareness.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {

Squareness
squareness_of(const SquarenessLine& first, const SquarenessLine& second, double square_error_rad) {
    const auto opened = [&](double slope_1, double slope_2) {
        return square_error_rad - std::atan(first.sign * slope_1) -
               std::atan(second.sign * slope_2);
    };
    const Straightness &a = first.straightness, &b = second.straightness;
    Squareness out;
    out.end_points = opened(a.end_points.slope, b.end_points.slope);
    out.least_squares = opened(a.least_squares.slope, b.least_squares.slope);
    out.minimum_zone = opened(a.minimum_zone.line.slope, b.minimum_zone.line.slope);
    const auto [low, high] = std::minmax({out.end_points, out.least_squares, out.minimum_zone});
    out.method_spread = high - low;
    return out;
}

} // namespace axiscal

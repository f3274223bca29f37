#pragma once
// How the points stand around a centre. Pure.

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal::circle {

/// The largest angle without points, seen from a centre, and the points at its two ends.
struct WidestGap {
    double angle_rad = 0;
    std::size_t before = 0, after = 0; ///< counter-clockwise: from `before` to `after`
};
WidestGap
widest_gap(std::span<const double> x, std::span<const double> y, double center_x, double center_y);

/// The nearest point of each of 64 equal sectors around the centre that hold one.
std::vector<std::size_t> nearest_of_sectors(std::span<const double> x,
                                            std::span<const double> y,
                                            double center_x,
                                            double center_y);

} // namespace axiscal::circle

#pragma once
// Slope of the mean deviation over the axis: what a scale or a linear compensation would take out.

#include "analysis/positioning/positioning_accuracy.hpp"

#include <optional>

namespace axiscal {

/// In units of deviation a unit of target (mm per mm, um per mm): 1e-6 mm/mm is 1 um/m. Of the mean
/// of both directions, of the forward mean where there is no other.
struct MeanSlope {
    double least_squares = 0; ///< sum (P - Pm)(x - xm) / sum (P - Pm)^2
    double end_points = 0;    ///< (x_last - x_first) / (P_last - P_first), by coordinate
    bool of_both_directions = false;
};

/// Accurate to some roundings of max|x| / span. Absent with fewer than two targets, or where the
/// targets lie so close that a quotient leaves the doubles.
std::optional<MeanSlope> slope_of_means(const std::vector<PositionRow>& rows);

} // namespace axiscal

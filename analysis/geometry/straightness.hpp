#pragma once
// Straightness of a measured line against three references (ISO 230-1), and straightness from
// angles. Pure; positions and deviations in one unit.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <vector>

namespace axiscal {

/// A line as measured: deviations across it at rising positions along it.
struct MeasuredLine {
    std::vector<double> positions, deviations;
};

/// A reference line y = offset + slope * x and what the points do beside it.
struct ReferenceLine {
    double slope = 0;              ///< dimensionless, tan of the angle to the axis
    double offset = 0;             ///< of the line at position 0
    double straightness = 0;       ///< largest minus smallest residual
    std::vector<double> residuals; ///< one a point, input order
};

struct ZonePoint {
    std::size_t index = 0;
    bool upper = false; ///< on the upper of the two lines
};

/// The two parallel lines of least distance that hold all points between them.
struct MinimumZone {
    ReferenceLine line; ///< midway; residuals and straightness perpendicular to it
    std::vector<ZonePoint> control_points; ///< two on one line, one on the other between them;
                                           ///< the ends alone when there are but two points
    double gap =
        0; ///< straightness of the residuals minus distance of the control points: rounding
};

struct Straightness {
    ReferenceLine end_points;    ///< through first and last point; residuals along the deviation
    ReferenceLine least_squares; ///< of the deviations; residuals along the deviation
    MinimumZone minimum_zone;
};

/// ISO 230-1 straightness. The minimum zone is exact: width of the convex hull by rotating
/// callipers, over all lines that run along the positions, measured perpendicular to the line.
/// Rounding: a few 1e-16 of the largest deviation. O(n).
/// @errors Fault::bad_case: fewer than two points ("targets"), positions that do not rise,
/// different counts, NaN, infinities, magnitudes above 1e12.
Result<Straightness> straightness_of(const MeasuredLine& line);

/// Integrates angles: y_0 = 0, y_{i+1} = y_i + base * angle_i at start, start + base, ... The
/// angle of a foot of length `base` that steps by its own length. A constant error of the angles
/// becomes a slope, which each reference takes out; a drift becomes a parabola, which none does.
/// @errors Fault::bad_case: "angles" empty or not finite, "base" not positive.
Result<MeasuredLine>
line_of_angles(const std::vector<double>& angles_rad, double base, double start);

} // namespace axiscal

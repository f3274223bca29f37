#pragma once
// Squareness of two axes from their straightness lines (ISO 230-1). Pure.

#include "analysis/geometry/straightness.hpp"

namespace axiscal {

/// One axis: its line, with deviations positive towards the + direction of the other axis
/// (sign +1) or away from it (sign -1).
struct SquarenessLine {
    Straightness straightness;
    int sign = 1;
};

/// Deviation of the angle between the two axes from 90 deg, rad; > 0 where the angle between
/// their + directions is larger than 90 deg.
struct Squareness {
    double end_points = 0, least_squares = 0, minimum_zone = 0;
    double method_spread = 0; ///< largest minus smallest of the three
};

/// S = e - atan(a_1) - atan(a_2): each axis turns towards the other by its slope and closes the
/// angle; e is the error of the optical square (its angle minus 90 deg) whose arms were the
/// references of the two lines. Methods differ by up to the sum of straightness over length.
Squareness squareness_of(const SquarenessLine& first,
                         const SquarenessLine& second,
                         double square_error_rad = 0);

} // namespace axiscal

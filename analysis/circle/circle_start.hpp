#pragma once
// Circles to begin from. Pure.

#include "analysis/circle/point_check.hpp"
#include "analysis/circle/seen_circle.hpp"

namespace axiscal::circle {

/// Taubin's algebraic circle, seen from the mean of the points. Never the answer: on Gander's six
/// points its centre is 0.9 away from the orthogonal one. Of three distinct points the circle
/// through them.
/// @errors Fault::bad_case: the points lie on a line within the rounding of their coordinates.
Result<SeenCircle> starting_circle(Values x, Values y, const CheckedPoints& points);

} // namespace axiscal::circle

#pragma once
// The readings of a circular test, ordered by angle, as the diagnosis walks over them. Pure.

#include "analysis/circular/cause.hpp"
#include "analysis/circular/circular_test.hpp"

#include <vector>

namespace axiscal::circular {

struct SeenPoint {
    Aspect aspect;
    double angle_rad = 0; ///< within [0, 2 pi)
    double deviation_mm = 0;
    double weight = 1; ///< root of the number of readings that were averaged into this point
};

struct SeenTrace {
    Sense sense = Sense::ccw;
    std::vector<SeenPoint> points; ///< by angle
    double step_rad = 0;           ///< median of the steps between neighbours
};

/// Traces of more than 40 000 readings are averaged into 20 000 sectors, none of which reaches over
/// a reversal or a change-over: what a cause does within a sector of 0.018 deg is below 1e-8 of it.
std::vector<SeenTrace> see(const CircularTest& test);

/// Degrees travelled since the crossing of `at_deg` in the point's own sense, within (-180, 180].
double degrees_past(const SeenPoint& point, double at_deg);

/// Degrees to the nearest of 0, 90, 180, 270.
double degrees_from_reversal(const SeenPoint& point);

} // namespace axiscal::circular

#pragma once
// What a drift in time has moved during a run, by its own readings. Pure.

#include "analysis/setup/run_course.hpp"

#include <optional>

namespace axiscal {

struct CourseDrift {
    double range_um = 0;                ///< from the first reading to the last
    double standard_uncertainty_um = 0; ///< of it, from the scatter about the fitted course
};

/// A straight line in time, beside the mean of each target and direction, by least squares. A bent
/// drift has a larger range than this. Empty below 20 readings, and where the readings of each
/// target and direction were taken at one time.
std::optional<CourseDrift> drift_of(const RunCourse& course);

} // namespace axiscal

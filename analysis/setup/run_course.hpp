#pragma once
// A positioning run in the order of time: what each reading shows beside the mean of its target
// and direction, and what the sensors said then. Pure.

#include "analysis/compensation/thermal_compensation.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <vector>

namespace axiscal {

struct CoursePoint {
    int cell = 0; ///< one for each target and direction: 2 target + (positive ? 0 : 1)
    PlannedPoint planned;
    double seconds = 0;      ///< since the first point, at the middle of its window
    double distance_m = 0;   ///< target - datum
    double deviation_um = 0; ///< at 20 degC
    double material_K = 0;   ///< above 20 degC
    double index_ppm = 0; ///< (n - n at the datum) 1e6, by which one metre of dead path moves the
                          ///< coordinate in um, sign of the laser included; 0: no beam measures
};

/// By time. Excluded and superseded readings are left out.
struct RunCourse {
    std::vector<CoursePoint> points;
};

/// @param deviations_mm  at 20 degC, one for each of `run.points` (CompensationSummary::after)
/// @errors those of EnvironmentHistory and refractivity_of(); Fault::internal where the counts
/// differ; Fault::refused for a rotary axis.
Result<RunCourse> course_of(const RunRecord& run,
                            const RunRevisions& revisions,
                            const std::vector<double>& deviations_mm);

} // namespace axiscal

#pragma once
// Where the straightness of an axis is measured. Targets have no random part: across the axis there
// is no period of a screw or a scale. Pure.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"
#include "config/station_config.hpp"

#include <vector>

namespace axiscal {

/// From the lowest place that leaves an overrun, as many as fit; whole micrometres.
/// @param interval  greater than 0
std::vector<Length> targets_each(const CycleConfig& cycle, Length interval);
/// Between the overruns of both ends, whole micrometres; `count` 2 or more.
std::vector<Length> even_targets(const CycleConfig& cycle, int count);

/// The standard cycle over `cycle.targets`, in both directions. Of `cycle` travel, approaches,
/// overrun and datum count beside them.
/// @errors Fault::bad_configuration with the key of the table, the numbers and the way out.
Result<RunPlan> plan_across(const CycleConfig& cycle);

} // namespace axiscal

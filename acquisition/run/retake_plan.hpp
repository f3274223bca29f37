#pragma once
// What is left to be taken again, read from a run file. Pure.

#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <vector>

namespace axiscal {

/// Points of retakes that are neither taken nor skipped, in their order. Steps are the plan's.
std::vector<PlannedPoint> points_to_take_again(const RunRecord& run, const RunRevisions& revisions);

} // namespace axiscal

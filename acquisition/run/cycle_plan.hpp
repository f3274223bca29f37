#pragma once
// The passes of one job: targets, order, overrun, datum; refused where the standard or the machine
// does not allow them (ISO 230-2:2014, 4.3 and 4.4). Pure.

#include "acquisition/run/target_positions.hpp"
#include "analysis/record/circular_setup.hpp"
#include "config/station_config.hpp"

#include <cstdint>
#include <vector>

namespace axiscal {

/// One plan, or two for a linear axis over 2000 mm: "whole" with n = 1 and "stretch" of 2000 mm
/// with the configured n. A declined stretch leaves its reason as remark on the whole pass. A
/// rotary axis over 360 degrees is one whole pass with n = 1.
/// `fresh_seed` is used where the configuration has none, or the next one whose targets do not bunch
/// within the feedback pitch; pass k draws from seed + k, recorded.
/// @errors Fault::bad_configuration; the sentence names the numbers and the way out.
Result<std::vector<RunPlan>> plan_passes(const CycleConfig& config, std::uint64_t fresh_seed);

/// Standard: P_1..P_m upwards, then P_m..P_1 downwards, n times. Step: at each target n times from
/// below, then n times from above. Unidirectional: the upward half alone.
std::vector<PlannedPoint>
order_points(CycleKind cycle, int targets, int approaches, bool bidirectional);

/// What such a run takes without starting, braking, overrun and answers: the way from point to point
/// at the programmed feed, and the dwell at each. A feed of 0 is not known and takes no time.
Duration least_time_of(const RunPlan& plan, Speed feed, Duration dwell);

/// The evaluated arcs of a circular test at their feed, without feed-in and overshoot.
Duration least_time_of(const CircularPlan& plan);

} // namespace axiscal

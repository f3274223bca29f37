#pragma once
// The run with the mirror in the other position, by which the form of the mirror is parted from the
// motion.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/recorded_line.hpp"
#include "drivers/loop/scheduler.hpp"

#include <optional>
#include <string>

namespace axiscal {

/// Its lines, where it can be parted with a run of this set-up and plan.
/// @param setup  of the run that is armed, its mirror as it stands now
/// @errors Fault::bad_request with the run, what differs, and the way out.
Result<RecordedLine> line_of_other_mirror(const RunFileContents& other,
                                          const StraightnessSetup& setup,
                                          const RunPlan& plan);

/// Of the run that the order or the station file names; nothing where neither names one.
/// @param setup, request  the caller keeps them
/// @errors those of find_complete_run() and line_of_other_mirror().
Task<Result<std::optional<RecordedLine>>>
find_other_mirror(OrderContext context, const StraightnessSetup& setup, const ArmRequest& request);

} // namespace axiscal

#pragma once
// What each kind of test says of a run that an earlier daemon left. A new kind is added here.

#include "acquisition/measurement/left_run.hpp"
#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/test_kind.hpp"
#include "drivers/loop/scheduler.hpp"

namespace axiscal {

/// One of them goes on at most, and a CNC may wait for it at a request.
bool is_driven_by_cnc(TestKind kind);

/// Of a run that was left open. May wait until its instruments speak.
/// @errors as Journal::reopen.
Task<Result<TakenOver>> take_over_left(const PositioningContext& context, LeftRun left);

/// The newest run is complete, and closed. @errors Fault::no_run_armed for a kind that nothing is
/// added to, with what to do.
Result<void> may_be_added_to(const RunSummary& newest);

} // namespace axiscal

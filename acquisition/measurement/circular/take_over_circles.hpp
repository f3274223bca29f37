#pragma once
// A circular test that was open when the last daemon ended: it goes on, or is closed with the
// reason.

#include "acquisition/measurement/cnc_answer.hpp"
#include "acquisition/measurement/left_run.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

namespace axiscal {

/// Waits for the ballbar. @errors as Journal::reopen.
Task<Result<TakenOver>> take_over_circles(CncContext context, LeftRun left);

} // namespace axiscal

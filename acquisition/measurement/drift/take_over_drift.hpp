#pragma once
// A drift test that was open when the last daemon ended: it never goes on.

#include "acquisition/measurement/left_run.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

namespace axiscal {

Task<Result<TakenOver>> take_over_drift(LeftRun left);

} // namespace axiscal

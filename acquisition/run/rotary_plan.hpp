#pragma once
// Whether a plan can be measured beside its artefact. Pure.

#include "analysis/record/rotary_setup.hpp"
#include "analysis/record/run_record.hpp"

namespace axiscal {

/// The rest at a target and the way of its approach must lie within the instrument's range; a table
/// that stands one step off must not pass the near check; targets of a polygon stand at its faces.
/// @errors Fault::bad_configuration naming the numbers and the way out.
Result<void> check_rotary_plan(const RunPlan& plan, const RotarySetup& setup);

} // namespace axiscal

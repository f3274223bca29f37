#pragma once
// Who armed a test, and who overrode which check.

#include "analysis/record/run_revisions.hpp"

#include <string>
#include <vector>

namespace axiscal {

struct MeasurementContext;

/// Notes the orders of arming in the file that the journal has open, and tells people of them.
/// @param checks  as they were judged; those with a reason were overridden by `by`
void note_arming(const MeasurementContext& context,
                 const std::string& run_id,
                 const Orderer& by,
                 const std::vector<PreflightRecord>& checks);

} // namespace axiscal

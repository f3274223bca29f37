#pragma once
// What the pre-flight checks of a straightness run look at, beside what they see of the axis.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/stored_drift.hpp"
#include "analysis/quantity/result.hpp"

namespace axiscal {

/// Of this axis, with the optics across it.
WantedDrift drift_for_straightness(const OrderContext& context);
Result<EveFacts> eve_facts_of_straightness(const OrderContext& context,
                                           const ArmRequest& request,
                                           const FoundEve& found);

} // namespace axiscal

#pragma once
// What the pre-flight checks of a run along the axis look at.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "acquisition/runfile/stored_drift.hpp"
#include "analysis/quantity/result.hpp"

#include <vector>

namespace axiscal {

struct WantedDrift;

/// @returns the channels of the instruments that it uses
std::vector<int> add_axis_facts(const OrderContext& context, PreflightFacts& facts);

WantedDrift drift_for_axis(const OrderContext& context);
/// @errors as plan_for.
Result<EveFacts>
eve_facts_of_axis(const OrderContext& context, const ArmRequest& request, const FoundEve& found);

} // namespace axiscal

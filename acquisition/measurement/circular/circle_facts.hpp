#pragma once
// What the pre-flight checks of a circular test look at. For a station with the tables [ballbar]
// and [circular].

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
std::vector<int> add_circle_facts(const OrderContext& context, PreflightFacts& facts);

// Of the ballbar.
WantedDrift drift_for_circles(const OrderContext& context);
Result<EveFacts>
eve_facts_of_circles(const OrderContext& context, const ArmRequest& request, const FoundEve& found);

} // namespace axiscal

#pragma once
// What the pre-flight checks look at, gathered from the running station.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/preflight/preflight.hpp"

#include <vector>

namespace axiscal {

/// Without what the checks look at of E_VE.
PreflightFacts preflight_facts(const OrderContext& context, const ArmRequest& request);

// For what a kind of test adds.
/// @param channels  ids, in the order in which the checks speak of them
void add_sensors(const OrderContext& context,
                 const std::vector<int>& channels,
                 PreflightFacts& facts);
/// Of the signal of the instrument that measures the length.
/// @param length  its channel
void add_strengths(const OrderContext& context, int length, PreflightFacts& facts);

} // namespace axiscal

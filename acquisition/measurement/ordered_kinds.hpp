#pragma once
// What each kind of test says of one that a person orders. A new kind is added here.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/drift/environmental_variation.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/test_kind.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>
#include <vector>

namespace axiscal {

struct WantedDrift;

/// As StationInterface::arm. A drift test is ordered by open_drift().
/// @errors Fault::bad_request for a kind that is not armed.
Task<Result<std::string>> open_ordered(OrderContext context, ArmRequest request);

/// Whose readings the pre-flight checks look at: circles, where they are asked for or nothing
/// measures an axis, and the station has what they need; else the axis.
TestKind kind_that_is_checked(const OrderContext& context, const ArmRequest& request);

// Of a kind that kind_that_is_checked() answered.
/// @returns the channels of the instruments that the test uses, in the order in which the checks
/// speak of them
std::vector<int>
add_facts_of_kind(TestKind kind, const OrderContext& context, PreflightFacts& facts);
/// The drift test that the station file points to; WantedDrift::which is empty where it does not.
WantedDrift drift_wanted_by(TestKind kind, const OrderContext& context);
/// @errors as plan_for.
Result<EveFacts> eve_facts_of_kind(TestKind kind,
                                   const OrderContext& context,
                                   const ArmRequest& request,
                                   const FoundEve& found);

} // namespace axiscal

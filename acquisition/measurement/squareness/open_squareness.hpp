#pragma once
// A squareness run is ordered: what speaks against it, which earlier runs it takes its lines from,
// and what it begins with.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

/// As open_straightness(). Beside [straightness] the station file must have [squareness]; the
/// earlier runs that it names must be stored, complete, and of the same optics.
Task<Result<std::string>> open_squareness(OrderContext context, ArmRequest request);

} // namespace axiscal

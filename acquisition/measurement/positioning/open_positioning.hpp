#pragma once
// A positioning run is ordered: what speaks against it, and what it begins with. Another test whose
// points are taken as those of such a run begins alike.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

/// As StationInterface::arm.
Task<Result<std::string>> open_positioning(OrderContext context, ArmRequest request);

/// Opens the file, and returns once the datum is tied; at once where the CNC ties it.
/// @param armed  for nobody yet: who orders it is known by `request`
/// @errors as StationInterface::arm.
Task<Result<std::string>> open_and_tie(OrderContext context, ArmRequest request, ArmedRun armed);

/// The axis can be measured now; nothing else goes on, and the disk takes records.
/// @errors why not, with the way out.
Result<void> axis_is_ready(const OrderContext& context);

} // namespace axiscal

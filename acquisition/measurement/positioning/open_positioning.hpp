#pragma once
// A positioning run is ordered: what speaks against it, and what it begins with.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

/// As StationInterface::arm.
Task<Result<std::string>> open_positioning(OrderContext context, ArmRequest request);

/// The axis can be measured now; nothing else goes on, and the disk takes records.
/// @errors why not, with the way out.
Result<void> axis_is_ready(const OrderContext& context);

} // namespace axiscal

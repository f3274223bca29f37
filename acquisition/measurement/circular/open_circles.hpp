#pragma once
// A circular test is ordered: what speaks against it, and what it begins with.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

/// As StationInterface::arm. Returns when the file's first rows are durable.
Task<Result<std::string>> open_circles(OrderContext context, ArmRequest request);

/// It did so within the last two seconds; in its range or not. For a station that has one.
/// @errors Fault::link_timeout
Result<void> ballbar_speaks(const OrderContext& context);

} // namespace axiscal

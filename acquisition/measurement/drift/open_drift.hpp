#pragma once
// A drift test is ordered: what speaks against it, and what it begins with.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

/// As StationInterface::drift.
Task<Result<std::string>> open_drift(OrderContext context, DriftRequest request);

} // namespace axiscal

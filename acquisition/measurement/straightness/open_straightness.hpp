#pragma once
// A straightness run is ordered: what speaks against it, and what it begins with.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/order_context.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"

#include <string>

namespace axiscal {

/// As StationInterface::arm. Beside what every run along the axis needs the station file must have
/// [straightness]; an alignment that is going on ends, and is not of these optics.
Task<Result<std::string>> open_straightness(OrderContext context, ArmRequest request);

} // namespace axiscal

#pragma once
// Readings of another program as a positioning case of `axiscal analyze`. Pure.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// Which way a pass went, by the order in which its targets were read: rising is forward. Where
/// that is not what the file says of a pass, a remark tells it. Where all passes rise, or fall, and
/// the file says both directions, its writer has sorted them: then it is believed, and where it
/// speaks of no pass by itself odd ones are forward, even ones backward; a remark says so.
/// @errors Fault::bad_case, "line N": a pass that turns within; "file": a pass without one of the
/// targets, unequal numbers of passes each way, no pass at all.
/// @param readings  gains the remarks.
Result<nlohmann::json> case_of_readings(LaserReadings& readings);

} // namespace axiscal

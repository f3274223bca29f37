#pragma once
#include "config/station_config.hpp"
#include "drivers/trigger/trigger_port.hpp"

#include <memory>

namespace axiscal {

/// The port that the station file names; opens nothing yet, never null. Only the sequence-block
/// exists mirrored; the station file is refused otherwise.
std::unique_ptr<TriggerPort> make_trigger_port(const TriggerConfig& config);

} // namespace axiscal

#pragma once
#include "config/station_config.hpp"
#include "drivers/trigger_port.hpp"

#include <memory>
#include <optional>

namespace axiscal {

/// The port that the station file names; opens nothing yet, never null. Only the sequence-block
/// exists mirrored; the station file is refused otherwise.
std::unique_ptr<TriggerPort> make_trigger_port(const TriggerConfig& config);

/// The TCP port in use, also when the configuration says 0; empty while nothing listens.
std::optional<int> bound_tcp_port(const TriggerPort& port);

} // namespace axiscal

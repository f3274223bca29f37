#pragma once
// Is the environment one that may be measured in? The limits are those of the station file. Pure.

#include "acquisition/preflight/preflight.hpp"
#include "config/environment_limits.hpp"

#include <span>
#include <string>

namespace axiscal {

/// Everything that lies outside, each with its sensor, reading and limit: "air/air temperature
/// shows 27.3 degC, 18 degC to 25 degC are allowed"; empty when nothing does. A sensor without a
/// reading says nothing here (it is stale). A change is judged once the sensor has been read for
/// change_window.
std::string outside_limits(const EnvironmentLimits& limits,
                           std::span<const SensorFacts> sensors,
                           MonotonicTime now);

/// A run was armed although the environment was outside, for a reason that stands in its file: it
/// is not held to the limits then.
bool waives_limits(std::span<const PreflightRecord> checks);

} // namespace axiscal

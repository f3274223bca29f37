#pragma once
// The sensors of air and material on their wires. Each shows the true environment at its own
// resolution.

#include "scenario.hpp"
#include "sim_clock.hpp"
#include "wire/dracal_line.hpp"
#include "wire/pty.hpp"
#include "wire/simulated_device.hpp"
#include "wire/tcp_slave.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace axiscal::simulate {

/// What a Modbus sensor of this kind holds in its registers at this time. Pure.
RegisterBank sensor_bank(const Scenario& scenario, const SensorScenario& sensor, double seconds);
/// Resolution of the sensor's temperature, K. tM-TH8, XY-MD02 and Comet: 0.1; Dracal: its digits.
double temperature_step_k(const SensorScenario& sensor);

/// Opens the wire of one sensor; `slide_mm` tells where the axis is, thread-safe.
/// @errors io, refused.
Result<std::unique_ptr<SimulatedDevice>>
open_simulated_sensor(const Scenario& scenario,
                      const SensorScenario& sensor,
                      SimClock clock,
                      const std::function<double()>& slide_mm);

} // namespace axiscal::simulate

#pragma once
// DS18B20 thermometers as the kernel shows them: a folder of folders with `w1_slave` and
// `temperature`.

#include "scenario.hpp"
#include "sim_clock.hpp"
#include "wire/simulated_device.hpp"

#include <memory>

namespace axiscal::simulate {

/// The text of `w1_slave` (Linux, w1_therm.rst): the scratchpad of the data sheet, twelve bits,
/// with its CRC, and the millidegrees. Pure.
std::string w1_slave_text(double celsius);

/// @errors io: the folder can not be made.
Result<std::unique_ptr<SimulatedDevice>>
open_simulated_w1(const Scenario& scenario, const SensorScenario& sensor, SimClock clock);

} // namespace axiscal::simulate

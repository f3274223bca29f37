#pragma once
// Instruments that answer text on a serial line: length gauges, autocollimators and air sensors.

#include "scenario.hpp"
#include "sim_clock.hpp"
#include "wire/simulated_device.hpp"

#include <functional>
#include <memory>

namespace axiscal::simulate {

/// True for kinds that answer text on a pseudo terminal.
bool is_text_kind(const std::string& kind);

/// What a length gauge shows that touches the machine one metre from its fixed point, at rest: the
/// growth since the beginning, in mm.
double gauge_reading_mm(const Scenario& scenario, double seconds);

/// `slide_mm` tells where the axis is, for an autocollimator; thread-safe. @errors io, refused.
Result<std::unique_ptr<SimulatedDevice>>
open_simulated_text(const Scenario& scenario,
                    const SensorScenario& sensor,
                    SimClock clock,
                    const std::function<double()>& slide_mm);

} // namespace axiscal::simulate

#pragma once
// What the sensors of a run say of themselves: one that repeats its last reading, one that was
// meant to touch the machine and hangs in the air. Pure.

#include "analysis/setup/setup_findings.hpp"

#include <vector>

namespace axiscal {

/// SetupError::frozen_air of each instrument whose air stood still (frozen_sensor.hpp),
/// SetupError::sensor_in_air of each material sensor that shows 70 % or more of what the air does
/// within twenty minutes, where the two move together (correlation 0.9). Where a scale measures the
/// axis no figure depends on the air, and the sensors on the scale are none of the machine.
std::vector<SetupFinding> find_sensor_errors(const RunRecord& run);

} // namespace axiscal

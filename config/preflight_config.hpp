#pragma once
// What must hold before a run is armed: the limits of the pre-flight checks. Pure data.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/temperature.hpp"
#include "analysis/quantity/time.hpp"

namespace axiscal {

struct PreflightConfig {
    /// Each temperature sensor must have been read for so long and changed, by its fitted slope, by
    /// no more than `soak_change` within it. 0: not asked.
    Duration soak_window = std::chrono::minutes{10};
    TemperatureDifference soak_change = kelvin(0.2);
    TemperatureDifference sensor_difference = kelvin(3); ///< between material sensors
    /// So much of each change of the air in a material sensor is no contact with the machine.
    double air_share = 0.7;
    Duration drift_window = std::chrono::seconds{30}; ///< the axis stands still; 0: not asked
    Length drift_limit = um(1);
    double least_strength_percent = 20; ///< of the laser's signal, where it tells
};

} // namespace axiscal

#pragma once
// Limits of the environment that a measurement may be made in, as the station file states them.
// Pure data.

#include "analysis/quantity/time.hpp"

#include <optional>

namespace axiscal {

/// Between what the readings of one quantity must lie and by how much they may change in an hour,
/// in the quantity's stored_unit_of(kind): degC, Pa, %. What is empty is not asked.
struct EnvironmentBand {
    std::optional<double> low, high, change_per_hour;
    [[nodiscard]] bool stated() const { return low || high || change_per_hour; }
};

struct EnvironmentLimits {
    EnvironmentBand air_temperature, material_temperature, air_pressure, air_humidity;
    /// A change is the slope of the straight line through the readings of this time.
    Duration change_window = std::chrono::minutes{10};

    [[nodiscard]] bool stated() const {
        return air_temperature.stated() || material_temperature.stated() || air_pressure.stated() ||
               air_humidity.stated();
    }
    [[nodiscard]] bool asks_for_change() const {
        return air_temperature.change_per_hour || material_temperature.change_per_hour ||
               air_pressure.change_per_hour || air_humidity.change_per_hour;
    }
};

} // namespace axiscal

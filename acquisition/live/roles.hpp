#pragma once
// Which channel plays which part: names of the station file resolved against the instruments. Pure.

#include "acquisition/live/supervisor.hpp"
#include "config/station_config.hpp"

#include <optional>
#include <vector>

namespace axiscal {

/// Channel ids of the station.
struct StationRoles {
    /// What measures the axis: a laser, or a scale. Absent: the station measures circles alone.
    std::optional<int> laser;
    std::optional<int> autocollimator; ///< reads the faces of a polygon, which are typed else
    std::optional<int> air_temperature, air_pressure, air_humidity; ///< all, where there is a laser
    std::vector<int> material;  ///< contact temperatures; at least one, where a length is measured
    std::vector<int> scale;     ///< temperatures on the scale that measures the axis
    std::optional<int> ballbar; ///< the length of a circular test's ballbar
    std::optional<int> bar_temperature; ///< of the sensor on it
    /// All environment channels that there are, in the order air temperature, pressure, humidity,
    /// material..., scale...; each once.
    [[nodiscard]] std::vector<int> environment() const;
    /// What a circular test looks at beside its ballbar: air and material temperatures, the bar's.
    [[nodiscard]] std::vector<int> of_circles() const;
};

/// Names what the station file leaves to the kind of a channel: the only length, the only air
/// temperature, a sensor of its own before one of the laser; every temperature on the material.
/// @param taken  channels that play other parts
/// @errors Fault::bad_configuration where no channel can play the part, or more than one.
Result<void> name_roles(AxisConfig& axis,
                        const std::vector<RoleConfig>& taken,
                        const std::vector<StationChannel>& channels);

/// An axis without a laser needs nothing; what it names is found all the same.
/// @errors Fault::bad_configuration naming the role, the name and what there is instead;
/// Fault::wrong_medium for an air channel in a material role, or the other way round.
Result<StationRoles> resolve_roles(const AxisConfig& axis,
                                   const std::vector<StationChannel>& channels);

/// The channel of `[ballbar] sensor`, a length, and none of the channels that measure the axis.
/// @errors as resolve_roles.
Result<int> resolve_ballbar(const RoleConfig& ballbar,
                            const StationRoles& axis,
                            const std::vector<StationChannel>& channels);
/// The channel of `[ballbar] temperature`, of medium "material". @errors as resolve_roles.
Result<int> resolve_bar_temperature(const RoleConfig& sensor,
                                    const std::vector<StationChannel>& channels);

} // namespace axiscal

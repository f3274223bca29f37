#pragma once
// What one channel of the station shows now: to people, and to the checks that look at sensors.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/preflight/preflight.hpp"
#include "analysis/quantity/time.hpp"

#include <vector>

namespace axiscal {

class LiveReadings;
class Supervisor;
struct StationChannel;
struct StationConfig;
struct StationRoles;

/// Refers to all it is made of.
class ChannelFacts {
public:
    ChannelFacts(const StationConfig& config,
                 const StationRoles& roles,
                 const Supervisor& instruments,
                 const LiveReadings& readings)
        : config_{config}
        , roles_{roles}
        , instruments_{instruments}
        , readings_{readings} {}

    [[nodiscard]] ChannelView view(const StationChannel& channel, MonotonicTime now) const;
    [[nodiscard]] SensorFacts sensor(int id, MonotonicTime now) const;
    /// Of every sensor of the environment, in the order of StationRoles::environment().
    [[nodiscard]] std::vector<SensorFacts> environment(MonotonicTime now) const;

private:
    const StationConfig& config_;
    const StationRoles& roles_;
    const Supervisor& instruments_;
    const LiveReadings& readings_;
};

} // namespace axiscal

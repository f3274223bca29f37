#include "acquisition/measurement/positioning/axis_instruments.hpp"

#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/instrument_serials.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace axiscal {
namespace {

std::optional<int> channel_of_axis(const StationRoles& roles) {
    return roles.laser ? roles.laser : roles.autocollimator;
}

} // namespace

std::string reference_word(const StationConfig& config) {
    return config.axis.scale ? "scale" : "laser";
}

bool reads_polygon(const StationConfig& config) {
    return config.axis.angle && config.axis.angle->setup.method == AngleMethod::polygon;
}

bool measures_axis(const StationConfig& config, const StationRoles& roles) {
    return roles.laser || reads_polygon(config);
}

std::string serial_of_axis(const StationConfig& config,
                           const StationRoles& roles,
                           const Supervisor& instruments) {
    const std::optional<int> id = channel_of_axis(roles);
    if (!id) return reads_polygon(config) ? "autocollimator" : "";
    const int seat = instruments.channels()[static_cast<std::size_t>(*id)].instrument;
    const std::string& serial = instruments.identity(seat).serial;
    return serial.empty() ? config.instruments[static_cast<std::size_t>(seat)].serial : serial;
}

std::string serial_of_axis_for(const RunRecord& run,
                               const StationConfig& config,
                               const StationRoles& roles,
                               const Supervisor& instruments) {
    const std::optional<int> id = channel_of_axis(roles);
    const auto then =
        std::ranges::find(run.instruments, run.laser.instrument, &InstrumentRecord::name);
    if (!id || then == run.instruments.end()) return serial_of_axis(config, roles, instruments);
    const int seat = instruments.channels()[static_cast<std::size_t>(*id)].instrument;
    const Identity& who = instruments.identity(seat);
    const bool silent = who.maker.empty() && who.model.empty() && who.serial.empty();
    return silent ? then->serial : serial_of_axis(config, roles, instruments);
}

std::vector<InstrumentSerial> serials_of_run(const StationRoles& roles,
                                             const Supervisor& instruments) {
    std::vector<int> channels = roles.environment();
    if (roles.laser) channels.push_back(*roles.laser);
    return answered_serials(instruments, channels);
}

Result<void> autocollimator_speaks(const LiveReadings& readings,
                                   const StationRoles& roles,
                                   const Supervisor& instruments,
                                   MonotonicTime now) {
    const auto id = roles.autocollimator;
    if (!id) return {};
    const auto& last = readings.latest(*id);
    if (last && now - last->at <= laser_limit) return {};
    const StationChannel& channel = instruments.channels()[static_cast<std::size_t>(*id)];
    return fail(Fault::link_timeout, "the autocollimator (" + channel.instrument_name +
                                         ") sends nothing; see 'axiscal devices'");
}

} // namespace axiscal

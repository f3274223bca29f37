#pragma once
// The station file with everything that can be said about it before a device is opened.

#include "acquisition/live/roles.hpp"
#include "config/station_config.hpp"
#include "drivers/instrument.hpp"
#include "drivers/recording/tape_link.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace axiscal {

struct LoadedStation {
    StationConfig config;
    std::vector<std::unique_ptr<Instrument>> instruments; ///< as config.instruments
    StationRoles roles;
    std::vector<RunPlan> passes;       ///< with seed 0 where the file names none
    std::map<std::string, Tape> tapes; ///< by instrument, of those that are none
};

/// Reads, makes the instruments (opens nothing), resolves roles, plans the cycle.
/// The error side holds every refusal with file:line, at once.
tl::expected<LoadedStation, std::vector<Refusal>> load_station(const std::string& path);

} // namespace axiscal

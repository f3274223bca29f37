#pragma once
// `axiscal station new`: asks, or takes as options, what only the technician knows, adds what is
// plugged in, and writes the station file.

#include "tools/axiscal/new_station.hpp"

#include <string>
#include <vector>

namespace axiscal {

struct NewStationRequest {
    std::string action; ///< "new"
    std::string out = "/etc/axiscal/station.toml";
    StationAnswers answers;
    std::vector<std::string> instruments; ///< "PLACE=DRIVER", or "tcp:host:port=modbus"
    std::vector<std::string> settings;    ///< "material.profile=xy-md02"
    bool force = false;                   ///< another file that is there is put aside
    KernelPlaces places;
};

/// Exit 0: written, and check-config accepts it; 2: an option is missing or wrong, nothing is
/// written; exit_refused: written, and told what is wrong with it.
int command_new_station(NewStationRequest request, bool json);

} // namespace axiscal

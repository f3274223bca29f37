#pragma once
// `axiscal pair`: lets a browser operate the station, shows which may, and ends that.

#include "tools/axiscal/station_client.hpp"

#include <optional>
#include <string>

namespace axiscal {

struct PairOrder {
    std::string name; ///< what orders of the browser are logged by; empty: the station's usual
    std::optional<std::string> end_name; ///< every pairing of this name is to end
    bool list = false, end_all = false;
};
int command_pair(const StationClient& client, const PairOrder& order, bool json);

} // namespace axiscal

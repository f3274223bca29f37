#pragma once
// `axiscal drift`: every channel against time while the axis, or a ballbar, rests.

#include "tools/axiscal/station_client.hpp"

#include <map>
#include <optional>
#include <string>

namespace axiscal {

struct DriftOrder {
    std::string duration = "30 min", interval = "1 s"; ///< with their units
    std::string of; ///< "axis" | "ballbar"; empty: the axis where there is one
    std::optional<double> place_mm;
    bool wait = false; ///< until the test has ended and its certificate is written
    std::map<std::string, std::string> statements;
    std::string by; ///< who orders it; may be empty
};
/// Exit: 0 begun, or complete with `wait`; 6 ended incomplete; 2 for a duration that is none.
int command_drift(const StationClient& client, const DriftOrder& order, bool json);

} // namespace axiscal

#pragma once
// Whether the certificates that a station file names are still good. Pure.

#include "config/station_config.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// One note for each instrument whose due date lies before `today` (ISO date; the
/// day itself is still good), by line. An instrument without a due date is no note: its certificate
/// prints "not stated".
std::vector<Refusal> expired_certificates(const StationConfig& config, const std::string& today);

} // namespace axiscal

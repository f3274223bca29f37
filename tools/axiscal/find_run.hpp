#pragma once
// Which run file a person means.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

/// A path that is there, else the id of a run of this station; nothing: the newest run. Path of the
/// run file.
/// @errors Fault::refused where the station file cannot be read, Fault::not_found.
Result<std::string> find_run(const std::string& run, const std::string& station_file);

} // namespace axiscal

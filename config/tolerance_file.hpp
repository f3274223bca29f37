#pragma once
// A set of limits in a TOML file of its own: the class table of a standard, a maker's data sheet.

#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"

#include <string>

namespace axiscal {

/// The keys of the station file's [tolerances], without that head. Each limit is in the unit of its
/// figure (unit_of_limits()); limits_of_kind() says which.
/// @errors Fault::bad_configuration with file:line and the first thing that is wrong.
Result<ToleranceRecord> load_tolerances(const std::string& path, AxisKind kind);

} // namespace axiscal

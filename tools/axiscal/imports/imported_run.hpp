#pragma once
// Readings of another program as a run of their own. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// A closed run, complete, of a case that import_file() made: its points in the order of a cycle,
/// one second apart from `now`, each with the deviation as its reading. Of `imported` everything
/// but the remark is taken as it is; statements are those that the case has.
/// @errors Fault::bad_case for a case that is not of positioning, or lacks a reading.
Result<RunRecord>
imported_run(const nlohmann::json& document, ImportedReadings imported, const ClockTie& now);

} // namespace axiscal

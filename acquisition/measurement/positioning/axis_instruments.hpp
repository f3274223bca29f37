#pragma once
// What measures the axis: how it is called, who it is, and whether it speaks.

#include "acquisition/live/roles.hpp"
#include "acquisition/run/resume.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"
#include "config/station_config.hpp"

#include <string>
#include <vector>

namespace axiscal {

class LiveReadings;
class Supervisor;

/// "laser" | "scale", for sentences.
std::string reference_word(const StationConfig& config);
/// A rotary axis with a polygon before an autocollimator.
bool reads_polygon(const StationConfig& config);
/// Else the station measures circles alone.
bool measures_axis(const StationConfig& config, const StationRoles& roles);

/// The serial number that it told, else the one of the station file.
std::string serial_of_axis(const StationConfig& config,
                           const StationRoles& roles,
                           const Supervisor& instruments);
/// Of one that has said nothing yet the run's own: it must not be taken for another one.
std::string serial_of_axis_for(const RunRecord& run,
                               const StationConfig& config,
                               const StationRoles& roles,
                               const Supervisor& instruments);
/// Of the instruments that a positioning run uses, as far as they have told one.
std::vector<InstrumentSerial> serials_of_run(const StationRoles& roles,
                                             const Supervisor& instruments);

/// Where a station has one. On the way to its first face it sees none: that it speaks is enough.
Result<void> autocollimator_speaks(const LiveReadings& readings,
                                   const StationRoles& roles,
                                   const Supervisor& instruments,
                                   MonotonicTime now);

} // namespace axiscal

#pragma once
// What a run file says before its first point: plan, set-up, statements, who measures. Pure but for
// the run's id, which looks at what is stored.

#include "acquisition/live/roles.hpp"
#include "acquisition/live/station_interface.hpp"
#include "config/station_config.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

struct RunHeaderParts {
    const StationConfig& config;
    const Supervisor& supervisor;
    const StationRoles& roles;
    TestKind kind;
    RunPlan plan;
    ClockTie opened;
    BootId boot_id;
    std::string config_hash;
    /// Beside those of the environment and the laser: the channels of which readings are kept.
    std::vector<int> further_channels = {};
};

/// "<station>-20261121T100000Z-X", of the second run of that second
/// "<station>-20261121T100000Z-2-X": sortable, fit for a file name whatever the names hold
/// (id_of_name).
std::string run_id_of(const std::string& station,
                      const std::string& axis,
                      std::int64_t utc_ns,
                      int of_this_second = 1);
/// The first of these, with `ending` behind it, that nothing bears here: no run file, and no
/// certificate of one that was taken away since. A clock that was set back gives an instant twice.
std::string free_run_id(const StationConfig& config,
                        const std::string& axis,
                        std::int64_t utc_ns,
                        const std::string& ending = {});

/// "Version 0.2.0 goes on; version 0.1.0 opened the run. ": of an interrupted run, whose next
/// points this program takes; the second half only where the versions differ.
std::string taken_up_text(const RunRecord& run);

/// What the station file states of the certificates of `recorded`, in their order.
std::vector<ChannelCalibration> calibrations_of(const Supervisor& supervisor,
                                                const std::vector<ChannelRecord>& recorded);

/// @errors Fault::bad_request for a statement that does not exist.
Result<RunRecord> make_run_header(const RunHeaderParts& parts, const ArmRequest& request);

/// Of a test that positions nothing: no targets, and no uncertainty of the axis. `parts.plan` says
/// nothing.
/// @param name  of what is measured, in the run's id
/// @errors as make_run_header.
Result<RunRecord>
make_header_without_axis(RunHeaderParts parts, const std::string& name, const ArmRequest& request);

} // namespace axiscal

#pragma once
// Which of several runs is the newest, however the clock was set between them. Pure.

#include "acquisition/runfile/run_file.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// The computer at this moment. Where the id is unknown, no run is of this boot.
struct PresentBoot {
    BootId id;
    ClockTie now{};
};

/// Runs of one boot follow each other by their monotonic openings, which no clock step moves; boots
/// by the latest UTC of their runs, the present one after all others. A run that states no boot is
/// a boot by itself. Two of the same moment: the path decides.
/// @returns a place in `runs`; null when there are none
const RunSummary* newest_run(const std::vector<RunSummary>& runs, const BootId& present_boot);

/// The earliest UTC that a run opened after `newest` can state: that of `newest`, or what the clock
/// of now tells of its opening, if it was set back since in the present boot. A clock that was set
/// back and forth meanwhile does not show.
std::int64_t earliest_utc_ns_after(const RunSummary& newest, const PresentBoot& present);

} // namespace axiscal

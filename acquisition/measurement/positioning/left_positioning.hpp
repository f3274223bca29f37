#pragma once
// A positioning run of an earlier daemon, left open or closed: what its file and its instruments
// tell for decide_resume().

#include "acquisition/measurement/cnc_answer.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "acquisition/run/reading_rule.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/run/run_machine.hpp"
#include "analysis/record/run_record.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/trigger/journal_receipt.hpp"

#include <memory>
#include <optional>
#include <string>

namespace axiscal {

/// What a run machine needs to know of a run, without what was added to it.
/// @param reading  never null
RunSetup run_setup_of(const CncContext& context,
                      const RunRecord& header,
                      std::shared_ptr<const ReadingRule> reading);

/// Returns when what measures the axis reads well and the index of air is known, at the latest
/// after return_limit: a request may stand in the CNC already, and must not meet sensors that have
/// not spoken yet. For a station with a laser or a scale.
/// @param run  open; the caller keeps it
/// @returns the station as it is then, without its environment
Task<StationNow> station_after_restart(CncContext context, const RunRecord& run);

/// For how long nothing was recorded, which version goes on, and why the datum holds.
std::string
interruption_text(const CncContext& context, const RunRecord& run, const std::string& proof);

/// What becomes of a closed run that is taken over.
struct ClosedBefore {
    SetUpWatch set_up;        ///< since the start of the daemon
    std::string interruption; ///< for the record, when it is opened again
    std::string doubt;        ///< why its datum cannot be relied on; empty: it holds
    std::optional<JournalReceipt> last_receipt; ///< what the CNC was told of it
};

/// Returns when the axis has told where it is, at the latest after 5 s: for a station that was just
/// started. The datum holds as that of an open run that is resumed.
/// @param set_up  watched since the start while no run is known; the caller keeps both
/// @returns without a receipt
Task<ClosedBefore>
judge_closed_run(CncContext context, const SetUpWatch& set_up, const RunRecord& run);

} // namespace axiscal

#pragma once
// A positioning run of an earlier daemon is taken over: left open it goes on or is closed with the
// reason, closed it is shown to a person who adds to it.

#include "acquisition/measurement/left_run.hpp"
#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "acquisition/run/reading_rule.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/trigger/journal_receipt.hpp"

#include <memory>
#include <optional>
#include <string>

namespace axiscal {

/// Waits for what measures the axis. @errors as Journal::reopen.
Task<Result<TakenOver>> take_over_positioning(PositioningContext context, LeftRun left);

/// Of a complete run that is closed. Waits for what measures the axis.
/// @param set_up  watched since the start while no run is known; the caller keeps it
/// @param told    what the CNC was told of the run; the caller keeps it
Task<std::shared_ptr<Measurement>>
take_over_closed_positioning(PositioningContext context,
                             std::string path,
                             RunFileContents contents,
                             const SetUpWatch& set_up,
                             const std::optional<JournalReceipt>& told);

// The same of another test whose points are taken as those of a positioning run.
/// @param reading  as ArmedRun::reading
Task<Result<TakenOver>> take_over_read_by(PositioningContext context,
                                          LeftRun left,
                                          std::shared_ptr<const ReadingRule> reading);
Task<std::shared_ptr<Measurement>>
take_over_closed_read_by(PositioningContext context,
                         std::string path,
                         RunFileContents contents,
                         std::shared_ptr<const ReadingRule> reading,
                         const SetUpWatch& set_up,
                         const std::optional<JournalReceipt>& told);

} // namespace axiscal

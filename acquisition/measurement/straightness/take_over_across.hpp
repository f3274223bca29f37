#pragma once
// A run across the axis of an earlier daemon is taken over: as a positioning run whose readings say
// nothing of the place.

#include "acquisition/measurement/left_run.hpp"
#include "acquisition/measurement/positioning/positioning_port.hpp"
#include "acquisition/measurement/positioning/set_up_watch.hpp"
#include "analysis/quantity/result.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/trigger/journal_receipt.hpp"

#include <memory>
#include <optional>
#include <string>

namespace axiscal {

/// As MeasurementKind::take_over.
Task<Result<TakenOver>> take_over_across(PositioningContext context, LeftRun left);

/// As MeasurementKind::take_over_closed.
Task<std::shared_ptr<Measurement>>
take_over_closed_across(PositioningContext context,
                        std::string path,
                        RunFileContents contents,
                        const SetUpWatch& set_up,
                        const std::optional<JournalReceipt>& told);

} // namespace axiscal

#pragma once
// What a finished straightness run says to a run that is evaluated with it. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/recorded_line.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"
#include "analysis/record/straightness_setup.hpp"
#include "analysis/straightness/straightness_figures.hpp"

namespace axiscal {

/// The means of the readings that count.
/// @param run    a complete one; statements.axis names its axis
/// @param setup  Wollaston
/// @errors those of read_straightness() and evaluate_straightness().
Result<RecordedLine> recorded_line_of(const RunRecord& run,
                                      const RunRevisions& revisions,
                                      const StraightnessSetup& setup);

/// Means as if each target had been reached once, so that evaluate_straightness() gives the lines
/// of the run that was recorded; of its scatter nothing.
StraightnessReadings readings_of(const RecordedLine& recorded);

} // namespace axiscal

#include "analysis/straightness/recorded_line_of.hpp"

#include "analysis/straightness/run_straightness.hpp"

#include <utility>

namespace axiscal {

Result<RecordedLine> recorded_line_of(const RunRecord& run,
                                      const RunRevisions& revisions,
                                      const StraightnessSetup& setup) {
    AXISCAL_TRY(const ReadStraightness read, read_straightness(run, revisions, setup));
    AXISCAL_TRY(const StraightnessFigures found,
                evaluate_straightness(read.readings, RowLengths::any));
    RecordedLine line;
    line.run_id = run.run_id;
    line.axis = run.statements.axis;
    line.across = setup.across;
    line.readings = found.approaches;
    line.scatter = um(found.pooled_s_um.value_or(0));
    for (const StraightnessRow& row : found.rows) {
        RecordedLineRow kept{mm(row.target_mm), um(row.mean_forward_um), {}};
        if (row.mean_backward_um) kept.backward = um(*row.mean_backward_um);
        line.rows.push_back(kept);
    }
    return line;
}

StraightnessReadings readings_of(const RecordedLine& recorded) {
    StraightnessReadings readings;
    for (const RecordedLineRow& row : recorded.rows) {
        readings.targets_mm.push_back(row.target.in(mm));
        readings.forward_um.push_back({row.forward.in(um)});
        if (row.backward) readings.backward_um.push_back({row.backward->in(um)});
    }
    return readings;
}

} // namespace axiscal

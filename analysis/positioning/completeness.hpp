#pragma once
// Which readings of a run enter its figures, and which of the plan are missing. Pure.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/record/run_revisions.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace axiscal {

/// Planned readings of one target and direction that enter no figure, all for one reason.
struct LeftOut {
    int target_index = 0; ///< 0-based, of the plan
    Direction direction = Direction::positive;
    std::vector<int> approaches; ///< 0-based, ascending
    std::string why;
    bool target_omitted = false; ///< the target stands in no figure at all
};

struct Completeness {
    /// False for a run that was not closed as complete: its result is partial, and bears neither a
    /// certificate number nor a verdict. Readings that a person excluded from a complete run leave
    /// it complete.
    bool complete = true;
    int expected = 0, used = 0;    ///< readings; the rest stands in `left_out`
    std::vector<LeftOut> left_out; ///< by target, positive direction first
    std::vector<int> targets;      ///< 0-based, ascending: those that the figures are made of
    [[nodiscard]] bool partial() const { return !complete; }
};

struct UsableReadings {
    DeviationTable table; ///< rows of the used targets alone, each with the n readings it has
    Completeness completeness;
};

/// Chooses the readings of a run. `deviations`: one for each of `run.points`; `targets`: one for
/// each target of the plan; both in `unit`. A target of a two-way plan is used when it has a
/// reading in both directions. Where no target has, those of the positive direction are used
/// alone, as of a test from one side. All figures are of the same targets, so that none of them can
/// exceed the one that contains it (E_forward <= E).
/// @errors Fault::incomplete_run when nothing can be evaluated, or when a run that was closed as
/// complete has a target and direction without a reading.
Result<UsableReadings> usable_readings(const RunRecord& run,
                                       const RunRevisions& revisions,
                                       const std::vector<double>& deviations,
                                       std::vector<double> targets,
                                       std::string unit);

/// Every point of a run that was not closed as complete is one of the plan's, stands once, and was
/// taken under the same datum. check_complete() without the completeness.
/// @errors Fault::incomplete_run without a point; bad_run_file; datum_lost.
Result<void> check_points(const RunRecord& run);

/// Takes out of an evaluated partial result what its readings cannot give, each with its reason
/// under `not_evaluated`: ranges over targets (A, E, M and their directions) where there is one
/// target alone; names the target and direction that has too few readings for R and A.
void withhold_from_partial(PositioningResult& result,
                           const RunAt20C& deviations,
                           const RunPlan& plan,
                           const Completeness& completeness);

/// "P3 ↑": the words for a target and direction, counted from 1.
std::string place_of(int target_index, Direction direction);

/// Sentences for the certificate: that the result is partial, which readings are missing, which
/// targets are in no figure. Empty for a complete run.
std::vector<std::string> remarks_on_completeness(const RunRecord& run,
                                                 const Completeness& completeness);

} // namespace axiscal

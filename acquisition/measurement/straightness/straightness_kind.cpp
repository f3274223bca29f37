// No station measures the straightness of an axis so far: what becomes of a file of one that lies
// there.
#include "acquisition/measurement/measurement_kind.hpp"

#include <utility>

namespace axiscal {
namespace {

/// By the rule for an axis its readings would be taken for positions.
Task<Result<TakenOver>> close_straightness(PositioningContext /*context*/, LeftRun left) {
    TakenOver taken;
    taken.closing =
        left.closed_for("This station does not go on with a straightness test.", Fault::refused);
    co_return taken;
}

tl::unexpected<Error> refuse_more_straightness(const RunSummary& newest) {
    return fail(Fault::no_run_armed, "the last run, " + newest.run_id +
                                         ", is a straightness test: this station only reads such, "
                                         "and takes no point of it again");
}

} // namespace

extern constinit const MeasurementKind straightness_kind{
    .take_over = close_straightness,
    .refuse_addition = refuse_more_straightness,
};

} // namespace axiscal

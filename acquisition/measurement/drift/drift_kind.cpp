// What becomes of a drift test that an earlier daemon left. open_drift() begins one.
#include "acquisition/measurement/measurement_kind.hpp"

#include "analysis/record/run_attachments.hpp"

#include <string>
#include <variant>

namespace axiscal {
namespace {

/// It never goes on.
Task<Result<TakenOver>> take_over_drift(PositioningContext /*context*/, LeftRun left) {
    const auto* setup = std::get_if<DriftSetup>(&left.contents.attachments.setup);
    const bool of_bar = setup != nullptr && setup->of_bar;
    TakenOver taken;
    taken.closing.reason = std::string{"Nobody watched the resting "} +
                           (of_bar ? "ballbar" : "axis") + " while the station was away.";
    taken.closing.fault = Fault::datum_lost;
    co_return taken;
}

tl::unexpected<Error> refuse_more_rest(const RunSummary& newest) {
    return fail(Fault::no_run_armed,
                "the last test, " + newest.run_id +
                    ", is a drift test of an earlier start: a run before it cannot be added "
                    "to, arm a new one");
}

} // namespace

extern constinit const MeasurementKind drift_kind{
    .driven_by_cnc = false,
    .take_over = take_over_drift,
    .refuse_addition = refuse_more_rest,
};

} // namespace axiscal

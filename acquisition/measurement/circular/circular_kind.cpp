// How a circular test is armed, and what becomes of one that an earlier daemon left.
#include "acquisition/measurement/measurement_kind.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/circular/circle_facts.hpp"
#include "acquisition/measurement/circular/open_circles.hpp"
#include "acquisition/measurement/circular/take_over_circles.hpp"

#include <utility>

namespace axiscal {
namespace {

Task<Result<TakenOver>> take_over_left_circles(PositioningContext context, LeftRun left) {
    return take_over_circles(context, std::move(left));
}

tl::unexpected<Error> refuse_more_circles(const RunSummary& newest) {
    return fail(Fault::no_run_armed, "the last run, " + newest.run_id +
                                         ", is a circular test: its circles are driven again");
}

bool can_measure_circles(const OrderContext& context) {
    return context.roles.ballbar && context.config.circular;
}

} // namespace

extern constinit const MeasurementKind circular_kind{
    .take_over = take_over_left_circles,
    .refuse_addition = refuse_more_circles,
    .is_set_up = can_measure_circles,
    .open = open_circles,
    .add_facts = add_circle_facts,
    .wanted_drift = drift_for_circles,
    .eve_facts = eve_facts_of_circles,
};

} // namespace axiscal

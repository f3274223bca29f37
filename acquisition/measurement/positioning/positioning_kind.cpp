// How a positioning run is armed, and what becomes of one that an earlier daemon left.
#include "acquisition/measurement/measurement_kind.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"
#include "acquisition/measurement/positioning/open_positioning.hpp"
#include "acquisition/measurement/positioning/take_over_positioning.hpp"

namespace axiscal {
namespace {

bool can_measure_axis(const OrderContext& context) {
    return measures_axis(context.config, context.roles);
}

} // namespace

extern constinit const MeasurementKind positioning_kind{
    .take_over = take_over_positioning,
    .take_over_closed = take_over_closed_positioning,
    .is_set_up = can_measure_axis,
    .open = open_positioning,
    .add_facts = add_axis_facts,
    .wanted_drift = drift_for_axis,
    .eve_facts = eve_facts_of_axis,
};

} // namespace axiscal

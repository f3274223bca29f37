// How a squareness run is armed, and what becomes of one that an earlier daemon left. Between the
// two it is a straightness run: the lines that it is evaluated with stand in its file already.
#include "acquisition/measurement/measurement_kind.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/measurement/squareness/armed_squareness.hpp"
#include "acquisition/measurement/squareness/open_squareness.hpp"
#include "acquisition/measurement/squareness/squareness_config.hpp"
#include "acquisition/measurement/straightness/straightness_facts.hpp"
#include "acquisition/measurement/straightness/take_over_across.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 4> options_of_squareness{"mirror", "square", "first",
                                                                "reversal_of"};

bool can_measure_squareness(const OrderContext& context) {
    return context.roles.laser && square_tables_of(context.config);
}

/// As the straightness of this axis.
std::optional<DrivenPlan> driven_squareness(const StationConfig& station) {
    const StraightnessConfig* const config = straightness_config_of(station);
    if (config == nullptr || squareness_config_of(station) == nullptr) return std::nullopt;
    return DrivenPlan{plan_of_kind(*config, TestKind::squareness), config->feed, config->dwell};
}

} // namespace

extern constinit const MeasurementKind squareness_kind{
    .read = read_squareness_section,
    .driven = driven_squareness,
    .take_over = take_over_across,
    .take_over_closed = take_over_closed_across,
    .options = options_of_squareness,
    .is_set_up = can_measure_squareness,
    .open = open_squareness,
    .add_facts = add_axis_facts,
    .wanted_drift = drift_for_straightness,
    .eve_facts = eve_facts_of_straightness,
};

} // namespace axiscal

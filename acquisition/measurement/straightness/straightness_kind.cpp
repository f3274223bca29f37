// How a straightness run is armed, and what becomes of one that an earlier daemon left. Between the
// two it is a positioning run whose readings say nothing of the place.
#include "acquisition/measurement/measurement_kind.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/measurement/straightness/open_straightness.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/measurement/straightness/straightness_facts.hpp"
#include "acquisition/measurement/straightness/take_over_across.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 2> options_of_straightness{"mirror", "reversal_of"};

bool can_measure_straightness(const OrderContext& context) {
    return context.roles.laser && straightness_config_of(context.config) != nullptr;
}

std::optional<DrivenPlan> driven_straightness(const StationConfig& station) {
    const StraightnessConfig* const config = straightness_config_of(station);
    if (config == nullptr) return std::nullopt;
    return DrivenPlan{plan_of_kind(*config, TestKind::straightness), config->feed, config->dwell};
}

} // namespace

extern constinit const MeasurementKind straightness_kind{
    .read = read_straightness_section,
    .driven = driven_straightness,
    .take_over = take_over_across,
    .take_over_closed = take_over_closed_across,
    .options = options_of_straightness,
    .is_set_up = can_measure_straightness,
    .open = open_straightness,
    .add_facts = add_axis_facts,
    .wanted_drift = drift_for_straightness,
    .eve_facts = eve_facts_of_straightness,
};

} // namespace axiscal

// How a straightness run is armed, and what becomes of one that an earlier daemon left. Between the
// two it is a positioning run whose readings say nothing of the place.
#include "acquisition/measurement/measurement_kind.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/measurement/positioning/take_over_positioning.hpp"
#include "acquisition/measurement/straightness/armed_straightness.hpp"
#include "acquisition/measurement/straightness/open_straightness.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/measurement/straightness/straightness_facts.hpp"

#include <array>
#include <utility>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 1> options_of_straightness{"mirror"};

bool can_measure_straightness(const OrderContext& context) {
    return context.roles.laser && straightness_config_of(context.config) != nullptr;
}

Task<Result<TakenOver>> take_over_straightness(PositioningContext context, LeftRun left) {
    auto reading = reading_across(context.config, left.contents.attachments);
    return take_over_read_by(context, std::move(left), std::move(reading));
}

Task<std::shared_ptr<Measurement>>
take_over_closed_straightness(PositioningContext context,
                              std::string path,
                              RunFileContents contents,
                              const SetUpWatch& set_up,
                              const std::optional<JournalReceipt>& told) {
    auto reading = reading_across(context.config, contents.attachments);
    return take_over_closed_read_by(context, std::move(path), std::move(contents),
                                    std::move(reading), set_up, told);
}

} // namespace

extern constinit const MeasurementKind straightness_kind{
    .read = read_straightness_section,
    .take_over = take_over_straightness,
    .take_over_closed = take_over_closed_straightness,
    .options = options_of_straightness,
    .is_set_up = can_measure_straightness,
    .open = open_straightness,
    .add_facts = add_axis_facts,
    .wanted_drift = drift_for_straightness,
    .eve_facts = eve_facts_of_straightness,
};

} // namespace axiscal

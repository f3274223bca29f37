#include "acquisition/measurement/straightness/armed_straightness.hpp"

#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/measurement/straightness/across_rule.hpp"
#include "config/measure.hpp"
#include "drivers/instrument.hpp"

#include <string>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

/// 0 where neither says it.
Length resolution_across(const RunHeaderParts& parts, const StraightnessConfig& config) {
    if (config.setup.resolution > Length{} || !parts.roles.laser) return config.setup.resolution;
    const int seat = parts.supervisor.channel(*parts.roles.laser).instrument;
    return parts.supervisor.instrument(seat).resolution().value_or(Length{});
}

/// What a person stated in other words stays.
void state_motion_across(const StationConfig& station,
                         const StraightnessConfig& config,
                         Statements& stated) {
    const AxisUnits units{AxisKind::linear};
    const auto dwell_text = [](Duration dwell) { return write_number(seconds_of(dwell)) + " s"; };
    if (stated.feed == units.write_speed(station.cycle.feed))
        stated.feed = units.write_speed(config.feed);
    if (stated.dwell == dwell_text(station.cycle.dwell)) stated.dwell = dwell_text(config.dwell);
}

/// The budget of positions, dead path and cosine speak of lengths along the beam.
void speak_of_motion_across(const RunHeaderParts& parts,
                            const StraightnessConfig& config,
                            RunRecord& header) {
    header.uncertainty.reset();
    LaserSetup& laser = header.laser;
    laser.dead_path = laser.beam_walk = laser.beam_walk_travel = Length{};
    state_motion_across(parts.config, config, header.statements);
    header.instruments.push_back(config.optics);
}

/// Of this run, whichever of the two kinds it is; null: of neither.
const StraightnessSetup* optics_across_of(const RunAttachments& attachments) {
    if (const auto* const square = std::get_if<SquarenessSetup>(&attachments.setup))
        return &square->optics;
    return std::get_if<StraightnessSetup>(&attachments.setup);
}

} // namespace

RunPlan plan_of_order(const StraightnessConfig& config, TestKind kind, const ArmRequest& request) {
    RunPlan plan = plan_of_kind(config, kind);
    if (request.datum_mm) plan.datum = mm(*request.datum_mm);
    return plan;
}

Result<MirrorPosition> mirror_of(const StraightnessConfig& config, const ArmRequest& request) {
    const auto said = request.options.find("mirror");
    if (said == request.options.end()) return config.setup.mirror;
    for (const MirrorPosition position : {MirrorPosition::normal, MirrorPosition::reversed})
        if (said->second == name_of(position)) return position;
    return refuse(Fault::bad_request, "options.mirror",
                  "'" + said->second +
                      "' is no position of the mirror: say normal, or reversed where it is turned "
                      "by 180 degrees about the beam");
}

Result<ArmedRun> armed_straightness(const RunHeaderParts& parts,
                                    const StraightnessConfig& config,
                                    const ArmRequest& request,
                                    const std::optional<FoundEve>& eve,
                                    std::optional<RecordedLine> other) {
    StraightnessSetup setup = config.setup;
    AXISCAL_TRY(setup.mirror, mirror_of(config, request));
    if (other) setup.reversal_of = other->run_id;
    setup.reversal = std::move(other);
    AXISCAL_TRY(ArmedRun armed, armed_run(parts, request, std::nullopt));
    setup.resolution = resolution_across(parts, config);
    if (eve) {
        setup.uncertainty.eve = eve->eve * setup.factor;
        armed.attachments.eve_source = eve->run_id;
    }
    speak_of_motion_across(parts, config, armed.header);
    armed.attachments.setup = std::move(setup);
    armed.reading = reading_across(parts.config, armed.attachments);
    return armed;
}

std::shared_ptr<const ReadingRule> reading_across(const StationConfig& station,
                                                  const RunAttachments& attachments) {
    const StraightnessConfig* const config = straightness_config_of(station);
    const Length range = config != nullptr ? config->range : usual_range_across;
    const StraightnessSetup* const setup = optics_across_of(attachments);
    return across_the_axis(setup != nullptr ? *setup : StraightnessSetup{}, range);
}

} // namespace axiscal

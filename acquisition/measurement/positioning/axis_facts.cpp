#include "acquisition/measurement/positioning/axis_facts.hpp"

#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/measurement/preflight_facts.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <algorithm>
#include <string>

namespace axiscal {
namespace {

void add_autocollimator(const OrderContext& context, int channel, PreflightFacts& facts) {
    facts.faces_read = true;
    if (const auto& last = context.readings.latest(channel)) facts.face_age = facts.now - last->at;
}

/// Of a laser or scale.
void add_length(const OrderContext& context, int channel, PreflightFacts& facts) {
    add_strengths(context, channel, facts);
    const SampleHistory& reference = context.readings.reference();
    const PreflightConfig& limits = context.config.preflight;
    const auto reading = reference.newest();
    if (reading && reading->value()) facts.laser_age = facts.now - reading->at;
    facts.laser_samples = reference.between(facts.now - drift_reach(limits), facts.now);
    const auto within = reference.between(facts.now - limits.drift_window, facts.now);
    facts.laser_range = metre(reference.summary_of(within).spread_m());
}

/// Dead path included.
void add_beam(const StationConfig& config,
              const RunPlan& plan,
              const FoundEve& found,
              EveFacts& facts) {
    const Length dead = config.axis.dead_path;
    facts.beam = dead + abs(found.rest - plan.datum);
    facts.longest_beam = dead;
    for (const Length target : plan.targets)
        facts.longest_beam = std::max(*facts.longest_beam, dead + abs(target - plan.datum));
}

} // namespace

std::vector<int> add_axis_facts(const OrderContext& context, PreflightFacts& facts) {
    const StationRoles& roles = context.roles;
    std::vector<int> channels = roles.environment();
    add_sensors(context, channels, facts);
    if (roles.laser) channels.push_back(*roles.laser);
    if (roles.autocollimator) {
        add_autocollimator(context, *roles.autocollimator, facts);
        channels.push_back(*roles.autocollimator);
    }
    if (roles.laser) add_length(context, *roles.laser, facts);
    return channels;
}

WantedDrift drift_for_axis(const OrderContext& context) {
    const StationConfig& config = context.config;
    const std::string& stated = config.statements.axis;
    return WantedDrift{config.eve_run, false, stated.empty() ? config.axis.name : stated};
}

Result<EveFacts>
eve_facts_of_axis(const OrderContext& context, const ArmRequest& request, const FoundEve& found) {
    const StationConfig& config = context.config;
    AXISCAL_TRY(const RunPlan plan, plan_for(config, request));
    EveFacts facts;
    facts.run_id = found.run_id;
    facts.lasted = found.lasted;
    facts.order = WantedDrift{{}, false, {}}.order();
    facts.run_takes = least_time_of(plan, config.cycle.feed, config.cycle.dwell);
    facts.rest = found.rest;
    facts.angle = plan.axis_kind == AxisKind::rotary;
    if (!facts.angle && !config.axis.scale) add_beam(config, plan, found, facts);
    return facts;
}

} // namespace axiscal

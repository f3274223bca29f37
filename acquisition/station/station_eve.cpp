// Which drift test the budget of a run takes its E_VE from, and what the checks look at of it.
#include "acquisition/station/station.hpp"

#include "acquisition/measurement/positioning/armed_run.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
bool Station::takes_circles(const ArmRequest& request) const {
    const bool asked = request.kind == TestKind::circular || (!roles_.laser && !reads_polygon());
    return asked && roles_.ballbar && config_.circular;
}

Task<Result<std::optional<FoundEve>>> Station::eve_for(bool circles) {
    WantedDrift wanted{circles ? config_.circular->eve_run : config_.eve_run, circles, {}};
    if (wanted.which.empty()) co_return std::optional<FoundEve>{};
    const std::string& stated = config_.statements.axis;
    const std::string& axis = stated.empty() ? config_.axis.name : stated;
    wanted.of = circles ? shown_name_of(*roles_.ballbar) : axis;
    const AxisKind kind = circles ? AxisKind::linear : config_.cycle.axis_kind;
    AXISCAL_CO_TRY(FoundEve found,
                   co_await find_eve(journal_, runs_folder(), std::move(wanted), kind));
    co_return std::optional{std::move(found)};
}

Result<EveFacts> Station::eve_facts(const ArmRequest& request, const FoundEve& found) const {
    EveFacts facts;
    facts.run_id = found.run_id;
    facts.lasted = found.lasted;
    const bool circles = takes_circles(request);
    facts.order = WantedDrift{{}, circles, {}}.order();
    if (circles) {
        facts.run_takes = least_time_of(config_.circular->setup.plan);
        return facts;
    }
    AXISCAL_TRY(const RunPlan plan, plan_for(config_, request));
    facts.run_takes = least_time_of(plan, config_.cycle.feed, config_.cycle.dwell);
    facts.rest = found.rest;
    facts.angle = plan.axis_kind == AxisKind::rotary;
    if (facts.angle || config_.axis.scale) return facts;
    const Length dead = config_.axis.dead_path;
    facts.beam = dead + abs(found.rest - plan.datum);
    facts.longest_beam = dead;
    for (const Length target : plan.targets)
        facts.longest_beam = std::max(*facts.longest_beam, dead + abs(target - plan.datum));
    return facts;
}

} // namespace axiscal

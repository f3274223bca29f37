#include "acquisition/measurement/straightness/straightness_facts.hpp"

#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "acquisition/run/cycle_plan.hpp"

namespace axiscal {

WantedDrift drift_for_straightness(const OrderContext& context) {
    WantedDrift wanted = drift_for_axis(context);
    wanted.which = straightness_config_of(context.config)->eve_run;
    return wanted;
}

Result<EveFacts> eve_facts_of_straightness(const OrderContext& context,
                                           const ArmRequest& /*request*/,
                                           const FoundEve& found) {
    const StraightnessConfig& config = *straightness_config_of(context.config);
    EveFacts facts;
    facts.run_id = found.run_id;
    facts.lasted = found.lasted;
    facts.order = WantedDrift{{}, false, {}}.order();
    facts.run_takes = least_time_of(config.plan, config.feed, config.dwell);
    facts.rest = found.rest;
    return facts;
}

} // namespace axiscal

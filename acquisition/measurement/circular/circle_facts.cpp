#include "acquisition/measurement/circular/circle_facts.hpp"

#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/measurement/preflight_facts.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/runfile/run_file.hpp"

namespace axiscal {

std::vector<int> add_circle_facts(const OrderContext& context, PreflightFacts& facts) {
    const int bar = *context.roles.ballbar;
    facts.circular = true;
    std::vector<int> channels = context.roles.of_circles();
    add_sensors(context, channels, facts);
    channels.push_back(bar);
    add_strengths(context, bar, facts);
    if (const auto& reading = context.readings.latest(bar)) facts.bar_age = facts.now - reading->at;
    facts.bar = &context.readings.log_of(bar);
    return channels;
}

WantedDrift drift_for_circles(const OrderContext& context) {
    const StationChannel& bar = context.instruments.channel(*context.roles.ballbar);
    return WantedDrift{context.config.circular->eve_run, true,
                       bar.instrument_name + "/" + bar.shown}; // as in a run file
}

Result<EveFacts> eve_facts_of_circles(const OrderContext& context,
                                      const ArmRequest& /*request*/,
                                      const FoundEve& found) {
    EveFacts facts;
    facts.run_id = found.run_id;
    facts.lasted = found.lasted;
    facts.order = WantedDrift{{}, true, {}}.order();
    facts.run_takes = least_time_of(context.config.circular->setup.plan);
    return facts;
}

} // namespace axiscal

// The limits of the environment: outside them nothing is captured, and the run goes on when it is
// back.
#include "acquisition/station/station.hpp"

namespace axiscal {
std::vector<SensorFacts> Station::environment_facts() const {
    std::vector<SensorFacts> facts;
    const std::vector<int> channels = roles_.environment();
    facts.reserve(channels.size());
    for (const int id : channels)
        facts.push_back(sensor_facts(id));
    return facts;
}

void Station::judge_environment() {
    if (!config_.environment.stated()) return;
    if (const auto news = readings_.judge_limits(environment_facts(), scheduler_.now()))
        record_instrument(news->sentence, news->fault);
}

} // namespace axiscal

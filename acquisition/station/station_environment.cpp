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

Result<double> Station::within_limits(Result<double> scale) const {
    const bool held_to_limits = !run_ || !run_->limits_waived;
    if (scale && readings_.outside() && held_to_limits)
        return tl::unexpected<Error>(*readings_.outside());
    return scale;
}

Result<double> Station::live_scale_now() const {
    return readings_.scale_minus_1(scheduler_.now(),
                                   run_ ? run_->header.laser.vacuum_wavelength : nm(632.991));
}

} // namespace axiscal

// The limits of the environment: outside them nothing is captured, and the run goes on when it is
// back.
#include "acquisition/preflight/environment_limits.hpp"
#include "acquisition/station/station.hpp"

namespace axiscal {
namespace {

constexpr Duration calm = std::chrono::seconds{10}; // a reading at its limit is no news each second

} // namespace

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
    const MonotonicTime now = scheduler_.now();
    const std::string outside = outside_limits(config_.environment, environment_facts(), now);
    const bool was_outside = environment_outside_.has_value();
    if (!outside.empty()) {
        environment_outside_ = Error{Fault::environment_outside, outside + ".", {}, {}};
        last_outside_ = now;
    } else if (was_outside && now - last_outside_ >= calm) {
        environment_outside_.reset();
    }
    if (was_outside == environment_outside_.has_value()) return;
    record_instrument(was_outside ? "The environment is within its limits again."
                                  : "The environment is out of limits: " + outside + ".",
                      was_outside ? Fault::none : Fault::environment_outside);
}

Result<double> Station::within_limits(Result<double> scale) const {
    const bool held_to_limits = !run_ || !run_->limits_waived;
    if (scale && environment_outside_ && held_to_limits)
        return tl::unexpected<Error>(*environment_outside_);
    return scale;
}

} // namespace axiscal

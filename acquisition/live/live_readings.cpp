#include "acquisition/live/live_readings.hpp"

#include "acquisition/preflight/environment_limits.hpp"
#include "analysis/air/air_refraction.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr Duration calm = std::chrono::seconds{10}; // a reading at its limit is no news each second

std::vector<WatchedChannel> watched(const StationRoles& roles,
                                    const std::vector<StationChannel>& channels) {
    std::vector<WatchedChannel> list;
    const auto add = [&](EnvironmentRole role, std::optional<int> id) {
        if (!id) return;
        const StationChannel& channel = channels[static_cast<std::size_t>(*id)];
        list.push_back({role, channel.instrument_name + "/" + channel.name, channel.place});
    };
    add(EnvironmentRole::air_temperature, roles.air_temperature);
    add(EnvironmentRole::air_pressure, roles.air_pressure);
    add(EnvironmentRole::air_humidity, roles.air_humidity);
    for (const int id : roles.material)
        add(EnvironmentRole::material_temperature, id);
    for (const int id : roles.scale)
        add(EnvironmentRole::scale_temperature, id);
    return list;
}

/// A capture looks back, and so does the check for drift.
SampleHistory::Limits history_limits(const StationConfig& config) {
    SampleHistory::Limits limits;
    limits.depth = std::max<Duration>(config.capture.history, drift_reach(config.preflight));
    return limits;
}

/// A little more than the checks look back.
std::vector<SensorLog> sensor_logs(const std::vector<StationChannel>& channels,
                                   const StationConfig& config) {
    constexpr Duration shortest = std::chrono::minutes{1};
    Duration window = config.preflight.soak_window;
    if (config.environment.asks_for_change())
        window = std::max(window, config.environment.change_window);
    const Duration depth = std::max<Duration>(window * 5 / 4, shortest);
    std::vector<SensorLog> logs;
    logs.reserve(channels.size());
    for (const StationChannel& channel : channels)
        logs.emplace_back(depth, channel.kind == ChannelKind::strength ? SensorLog::Keep::lowest
                                                                       : SensorLog::Keep::newest);
    return logs;
}

} // namespace

LiveReadings::LiveReadings(const StationConfig& config,
                           const StationRoles& roles,
                           const std::vector<StationChannel>& channels)
    : config_{config}
    , reference_{history_limits(config)}
    , watch_{watched(roles, channels)}
    , environment_{roles.environment()}
    , latest_(channels.size())
    , logs_{sensor_logs(channels, config)} {}

bool LiveReadings::take_sensor(const Sample& sample) {
    log(sample);
    bool of_the_environment = false;
    for (std::size_t i = 0; i < environment_.size(); ++i)
        if (environment_[i] == sample.channel) {
            watch_.take(i, sample);
            of_the_environment = true;
        }
    return of_the_environment;
}

Result<void> LiveReadings::environment_is_fresh(MonotonicTime now) const {
    return watch_.check(now, config_.axis.air.oldest);
}

std::optional<double> LiveReadings::mean(EnvironmentRole role, MonotonicTime now) const {
    return watch_.fresh_mean(role, now, config_.axis.air.oldest);
}

/// Of readings that check() has just found fresh.
double LiveReadings::strain(EnvironmentRole role, Expansion coefficient, MonotonicTime now) const {
    const Temperature temperature =
        Temperature::celsius(*watch_.fresh_mean(role, now, config_.axis.air.oldest));
    return (coefficient * (temperature - reference_temperature)).si();
}

Result<double> LiveReadings::scale_minus_1(MonotonicTime now, Length vacuum_wavelength) const {
    const Duration oldest = config_.axis.air.oldest;
    AXISCAL_CHECK(watch_.check(now, oldest));
    if (config_.axis.angle && config_.axis.angle->setup.method == AngleMethod::polygon)
        return 0.0;           // an autocollimator counts no wavelengths
    if (config_.axis.scale) { // a scale that grows itself counts less
        const double machine =
            strain(EnvironmentRole::material_temperature, config_.axis.material.coefficient, now);
        const double scale =
            strain(EnvironmentRole::scale_temperature, config_.axis.scale->setup.coefficient, now);
        return (1 + machine) / (1 + scale) - 1;
    }
    AirState air;
    air.temperature =
        Temperature::celsius(*watch_.fresh_mean(EnvironmentRole::air_temperature, now, oldest));
    air.pressure = pascal(*watch_.fresh_mean(EnvironmentRole::air_pressure, now, oldest));
    air.relative_humidity = percent(*watch_.fresh_mean(EnvironmentRole::air_humidity, now, oldest));
    air.vacuum_wavelength = vacuum_wavelength;
    air.co2_ppm = config_.axis.air.co2_ppm;
    AXISCAL_TRY(const Refractivity refractivity, refractivity_of(config_.axis.air.formula, air));
    if (config_.axis.angle) return refractivity.n_minus_1; // an angle does not expand
    const double growth =
        strain(EnvironmentRole::material_temperature, config_.axis.material.coefficient, now);
    return refractivity.n_minus_1 + growth + refractivity.n_minus_1 * growth;
}

std::optional<LiveReadings::News>
LiveReadings::judge_limits(const std::vector<SensorFacts>& sensors, MonotonicTime now) {
    const std::string outside = outside_limits(config_.environment, sensors, now);
    const bool was_outside = outside_.has_value();
    if (!outside.empty()) {
        outside_ = Error{Fault::environment_outside, outside + ".", {}, {}};
        last_outside_ = now;
    } else if (was_outside && now - last_outside_ >= calm) {
        outside_.reset();
    }
    if (was_outside == outside_.has_value()) return std::nullopt;
    if (was_outside) return News{"The environment is within its limits again.", Fault::none};
    return News{"The environment is out of limits: " + outside + ".", Fault::environment_outside};
}

} // namespace axiscal

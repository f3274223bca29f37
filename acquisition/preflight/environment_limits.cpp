#include "acquisition/preflight/environment_limits.hpp"

#include "acquisition/capture/wording.hpp"
#include "analysis/drift/settling.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr double nearly_whole = 0.95; // of a window: the first reading came a little late
constexpr double seconds_of_an_hour = 3600;

/// How a quantity is written for people.
struct Paper {
    double factor = 1; ///< from the stored unit
    int decimals = 1;
    std::string unit;
};

Paper paper_for(ChannelKind kind, bool change) {
    if (kind == ChannelKind::pressure) return {0.01, 1, " hPa"};
    if (kind == ChannelKind::humidity) return {1, 0, " %"};
    return {1, 2, change ? " K" : " degC"};
}

std::string written(double stored, const Paper& paper) {
    return plain_number(stored * paper.factor, paper.decimals) + paper.unit;
}

const EnvironmentBand& band_of(const EnvironmentLimits& limits, const SensorFacts& sensor) {
    if (sensor.kind == ChannelKind::pressure) return limits.air_pressure;
    if (sensor.kind == ChannelKind::humidity) return limits.air_humidity;
    return sensor.medium == Medium::material ? limits.material_temperature : limits.air_temperature;
}

std::string allowed(const EnvironmentBand& band, const Paper& paper) {
    const std::string words = band.low && band.high
                                  ? written(*band.low, paper) + " to " + written(*band.high, paper)
                              : band.low ? written(*band.low, paper) + " and more"
                                         : written(*band.high, paper) + " at most";
    return words + " are allowed";
}

std::string objection_to_reading(const EnvironmentBand& band, const SensorFacts& sensor) {
    const auto value = sensor.log->newest();
    const bool outside =
        value && ((band.low && *value < *band.low) || (band.high && *value > *band.high));
    if (!outside) return {};
    const Paper paper = paper_for(sensor.kind, false);
    return sensor.name + " shows " + written(*value, paper) + ", " + allowed(band, paper);
}

/// In the stored unit; empty while the sensor has not been read for the whole window.
std::optional<double>
change_per_hour(const SensorFacts& sensor, Duration window, MonotonicTime now) {
    const DriftSeries series = sensor.log->last(window, now);
    const bool whole =
        seconds_of(sensor.log->covered(window, now)) >= seconds_of(window) * nearly_whole;
    if (!whole || series.times.size() < 2) return std::nullopt;
    const auto slopes = window_slopes(series, series.times.back() - series.times.front());
    if (slopes.empty()) return std::nullopt;
    return slopes.back().slope * seconds_of_an_hour;
}

std::string objection_to_change(const EnvironmentBand& band,
                                const SensorFacts& sensor,
                                Duration window,
                                MonotonicTime now) {
    if (!band.change_per_hour) return {};
    const auto change = change_per_hour(sensor, window, now);
    if (!change || std::abs(*change) <= *band.change_per_hour) return {};
    const Paper paper = paper_for(sensor.kind, true);
    return sensor.name + " changes by " + written(*change, paper) + " an hour, " +
           written(*band.change_per_hour, paper) + " are allowed";
}

} // namespace

std::string outside_limits(const EnvironmentLimits& limits,
                           std::span<const SensorFacts> sensors,
                           MonotonicTime now) {
    std::string all;
    for (const SensorFacts& sensor : sensors) {
        const EnvironmentBand& band = band_of(limits, sensor);
        for (const std::string& objection :
             {objection_to_reading(band, sensor),
              objection_to_change(band, sensor, limits.change_window, now)})
            if (!objection.empty()) all += (all.empty() ? "" : "; ") + objection;
    }
    return all;
}

bool waives_limits(std::span<const PreflightRecord> checks) {
    return std::ranges::any_of(checks, [](const PreflightRecord& check) {
        return check.name == "environment" && !check.passed && !check.override_reason.empty();
    });
}

} // namespace axiscal

// What is asked of temperatures, and of the environment they stand for.
#include "acquisition/preflight/preflight_checks.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/preflight/environment_limits.hpp"
#include "analysis/setup/air_share.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal::preflight_checks {
namespace {

/// Of the two residuals: below it they move by chance.
constexpr double telling_correlation = 0.8;

std::string in_kelvin(double kelvins) {
    return plain_number(kelvins, 3) + " K";
}

/// Fitted change over the soak window, or how much of the window there is.
struct Soak {
    std::optional<double> change_K;
    Duration covered{};
};
Soak soak_of(const SensorFacts& sensor, const PreflightFacts& facts) {
    const Duration window = facts.config.preflight.soak_window;
    const DriftSeries series = sensor.log->last(window, facts.now);
    Soak soak;
    soak.covered = sensor.log->covered(window, facts.now);
    if (series.times.size() >= 2 && seconds_of(soak.covered) >= seconds_of(window) * nearly_whole)
        soak.change_K = slope_of(series) * seconds_of(window);
    return soak;
}

} // namespace

PreflightRecord check_soak(const PreflightFacts& facts) {
    const PreflightConfig& limits = facts.config.preflight;
    if (limits.soak_window <= Duration{})
        return passed("soak", "Not asked: preflight.soak_window is 0.");
    const double limit_K = limits.soak_change.in(kelvin);
    std::string wrong;
    double largest_K = 0;
    for (const SensorFacts& sensor : facts.sensors) {
        if (sensor.kind != ChannelKind::temperature) continue;
        const Soak soak = soak_of(sensor, facts);
        if (!soak.change_K)
            join(wrong, sensor.name + " has been read for " + in_minutes(soak.covered) + " of " +
                            in_minutes(limits.soak_window));
        else if (std::fabs(*soak.change_K) > limit_K)
            join(wrong, sensor.name + " changes by " + in_kelvin(*soak.change_K) + " in " +
                            in_minutes(limits.soak_window) + ", " + in_kelvin(limit_K) +
                            " are allowed");
        else
            largest_K = std::max(largest_K, std::fabs(*soak.change_K));
    }
    if (wrong.empty())
        return passed("soak", "Every temperature changes by " + in_kelvin(largest_K) +
                                  " or less in " + in_minutes(limits.soak_window) + ".");
    return failed("soak", wrong + ". Let sensors and machine come to rest, and wait.");
}

PreflightRecord check_sensors(const PreflightFacts& facts) {
    const double limit_K = facts.config.preflight.sensor_difference.in(kelvin);
    const SensorFacts *lowest = nullptr, *highest = nullptr;
    int compared = 0;
    for (const SensorFacts& sensor : facts.sensors) {
        if (sensor.medium != Medium::material || sensor.on_scale || !sensor.log->newest()) continue;
        ++compared;
        if (lowest == nullptr || *sensor.log->newest() < *lowest->log->newest()) lowest = &sensor;
        if (highest == nullptr || *sensor.log->newest() > *highest->log->newest())
            highest = &sensor;
    }
    if (lowest == nullptr && facts.config.axis.angle)
        return passed("sensors", "No material sensor: an angle does not expand.");
    if (lowest == nullptr && facts.circular)
        return passed("sensors", "No material sensor: F and D stand as measured.");
    if (lowest == nullptr) return failed("sensors", "No material sensor gives a reading.");
    const double apart_K = *highest->log->newest() - *lowest->log->newest();
    if (compared == 1)
        return passed("sensors", "One material sensor alone: nothing to compare it with.");
    if (apart_K <= limit_K)
        return passed("sensors", "The material sensors agree within " + in_kelvin(apart_K) + ".");
    return failed("sensors", highest->name + " shows " + in_kelvin(apart_K) + " more than " +
                                 lowest->name + "; " + in_kelvin(limit_K) +
                                 " are allowed. One of them does not touch the machine, or its "
                                 "correction is wrong.");
}

PreflightRecord check_contact(const PreflightFacts& facts) {
    const PreflightConfig& limits = facts.config.preflight;
    const Duration window = limits.soak_window;
    if (window <= Duration{}) return passed("contact", "Not asked: preflight.soak_window is 0.");
    const auto air = std::ranges::find_if(facts.sensors, [](const SensorFacts& sensor) {
        return sensor.medium == Medium::air && sensor.kind == ChannelKind::temperature;
    });
    if (air == facts.sensors.end())
        return passed("contact", "There is no air sensor to compare with.");
    const DriftSeries air_series = air->log->last(window, facts.now);
    std::string wrong, unread;
    for (const SensorFacts& sensor : facts.sensors) {
        if (sensor.medium != Medium::material) continue;
        const DriftSeries series = sensor.log->last(window, facts.now);
        if (tells_no_share(series) || tells_no_share(air_series)) {
            join(unread, sensor.name);
            continue;
        }
        AirShare over;
        over.add_window(series, air_series);
        const auto share = over.share(telling_correlation);
        if (share && *share >= limits.air_share)
            join(wrong, sensor.name + " shows " + plain_number(*share * 100, 0) +
                            " % of each change of " + air->name);
    }
    if (!wrong.empty())
        return failed("contact",
                      wrong + ". It reads the air: press it on with paste and cover it.");
    if (!unread.empty())
        return passed("contact", "Not judged for " + unread + ": within " + in_minutes(window) +
                                     " (preflight.soak_window) there are fewer than 10 readings "
                                     "of it or of the air.");
    return passed("contact", "No material sensor follows the air.");
}

PreflightRecord check_environment(const PreflightFacts& facts) {
    const EnvironmentLimits& limits = facts.config.environment;
    if (!limits.stated())
        return passed("environment", "The station file states no limits of the environment.");
    const std::string outside = outside_limits(limits, facts.sensors, facts.now);
    if (outside.empty()) return passed("environment", "Air and machine are within their limits.");
    return failed("environment",
                  outside +
                      ". Wait until each value is within its limits again, or remove the cause.");
}

} // namespace axiscal::preflight_checks

#include "acquisition/station/preflight.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/station/environment_limits.hpp"
#include "analysis/drift/settling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace axiscal {
namespace {

constexpr double nearly_whole = 0.95; // of a window: the first reading came a little late
constexpr double longest_break = 0.5; // of a window: what happened meanwhile nobody knows
/// Below this the air is too steady to tell whether a sensor follows it.
constexpr double telling_change_K = 0.03;
/// Of the two residuals: below it they move by chance.
constexpr double telling_correlation = 0.8;

PreflightRecord passed(std::string name, std::string verdict) {
    return {std::move(name), true, false, std::move(verdict), {}};
}
PreflightRecord warned(std::string name, std::string verdict) {
    return {std::move(name), true, true, std::move(verdict), {}};
}
PreflightRecord failed(std::string name, std::string verdict) {
    return {std::move(name), false, false, std::move(verdict), {}};
}

std::string in_kelvin(double kelvins) {
    return plain_number(kelvins, 3) + " K";
}
std::string in_minutes(Duration span) {
    return span < std::chrono::minutes{2} ? in_seconds(span)
                                          : plain_number(seconds_of(span) / 60, 1) + " min";
}

void join(std::string& list, const std::string& item) {
    list += (list.empty() ? "" : "; ") + item;
}

std::string length_of(const PreflightFacts& facts) {
    return facts.circular ? "the ballbar" : "the laser";
}

PreflightRecord check_instruments(const PreflightFacts& facts) {
    constexpr Duration length_limit = std::chrono::seconds{2};
    std::string wrong;
    for (const std::string& name : facts.unavailable)
        join(wrong, name + " is not there");
    for (const SensorFacts& sensor : facts.sensors)
        if (!sensor.fresh)
            join(wrong, sensor.name + " gives no fresh reading (" + sensor.quality + ")");
    // At rest a ballbar may be out of its range: that it speaks is enough.
    const auto& age = facts.circular ? facts.bar_age : facts.laser_age;
    if (!facts.typed && (!age || *age > length_limit))
        join(wrong, length_of(facts) + " gives no fresh reading");
    if (wrong.empty())
        return passed("instruments", "Every instrument is there and its readings are fresh.");
    return failed("instruments", wrong + ". Look at the cables; 'axiscal devices' tells more.");
}

/// Slope of the straight line through a whole series, in its units a second.
double slope_of(const DriftSeries& series) {
    const auto slopes = window_slopes(series, series.times.back() - series.times.front());
    return slopes.empty() ? 0 : slopes.back().slope;
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
    for (const SensorFacts& sensor : facts.sensors) {
        if (sensor.medium != Medium::material || !sensor.log->newest()) continue;
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
    if (lowest == highest)
        return passed("sensors", "One material sensor alone: nothing to compare it with.");
    if (apart_K <= limit_K)
        return passed("sensors", "The material sensors agree within " + in_kelvin(apart_K) + ".");
    return failed("sensors", highest->name + " shows " + in_kelvin(apart_K) + " more than " +
                                 lowest->name + "; " + in_kelvin(limit_K) +
                                 " are allowed. One of them does not touch the machine, or its "
                                 "correction is wrong.");
}

/// Residuals of a series about its own straight line, at its own times.
std::vector<double> residuals_of(const std::vector<double>& times,
                                 const std::vector<double>& readings) {
    const auto n = static_cast<double>(times.size());
    double mean_t = 0, mean_x = 0, tt = 0, tx = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        mean_t += times[i] / n, mean_x += readings[i] / n;
    for (std::size_t i = 0; i < times.size(); ++i) {
        tt += (times[i] - mean_t) * (times[i] - mean_t);
        tx += (times[i] - mean_t) * (readings[i] - mean_x);
    }
    const double slope = tt > 0 ? tx / tt : 0;
    std::vector<double> residuals;
    residuals.reserve(times.size());
    for (std::size_t i = 0; i < times.size(); ++i)
        residuals.push_back(readings[i] - mean_x - slope * (times[i] - mean_t));
    return residuals;
}

double value_at(const DriftSeries& series, double time) {
    const auto after = std::ranges::lower_bound(series.times, time);
    if (after == series.times.begin()) return series.readings.front();
    if (after == series.times.end()) return series.readings.back();
    const auto i = static_cast<std::size_t>(after - series.times.begin());
    const double share = (time - series.times[i - 1]) / (series.times[i] - series.times[i - 1]);
    return series.readings[i - 1] + share * (series.readings[i] - series.readings[i - 1]);
}

/// Share of the air's swings that the sensor shows; empty when nothing can be told.
std::optional<double> air_share_of(const DriftSeries& material, const DriftSeries& air) {
    constexpr std::size_t fewest = 10;
    if (material.times.size() < fewest || air.times.size() < fewest) return std::nullopt;
    std::vector<double> beside;
    beside.reserve(material.times.size());
    for (const double time : material.times)
        beside.push_back(value_at(air, time));
    const auto sensor = residuals_of(material.times, material.readings);
    const auto driver = residuals_of(material.times, beside);
    double aa = 0, as = 0, ss = 0;
    for (std::size_t i = 0; i < sensor.size(); ++i) {
        aa += driver[i] * driver[i];
        as += driver[i] * sensor[i];
        ss += sensor[i] * sensor[i];
    }
    const bool moves = std::sqrt(aa / static_cast<double>(sensor.size())) >= telling_change_K;
    if (!moves || ss <= 0 || as / std::sqrt(aa * ss) < telling_correlation) return std::nullopt;
    return as / aa;
}

PreflightRecord check_contact(const PreflightFacts& facts) {
    const PreflightConfig& limits = facts.config.preflight;
    const Duration window = std::max<Duration>(limits.soak_window, std::chrono::seconds{1});
    const auto air = std::ranges::find_if(facts.sensors, [](const SensorFacts& sensor) {
        return sensor.medium == Medium::air && sensor.kind == ChannelKind::temperature;
    });
    if (air == facts.sensors.end())
        return passed("contact", "There is no air sensor to compare with.");
    const DriftSeries air_series = air->log->last(window, facts.now);
    std::string wrong;
    for (const SensorFacts& sensor : facts.sensors) {
        if (sensor.medium != Medium::material) continue;
        const auto share = air_share_of(sensor.log->last(window, facts.now), air_series);
        if (share && *share >= limits.air_share)
            join(wrong, sensor.name + " shows " + plain_number(*share * 100, 0) +
                            " % of each change of " + air->name);
    }
    if (wrong.empty()) return passed("contact", "No material sensor follows the air.");
    return failed("contact", wrong + ". It reads the air: press it on with paste and cover it.");
}

PreflightRecord check_strength(const PreflightFacts& facts) {
    const double limit = facts.config.preflight.least_strength_percent;
    std::optional<double> lowest;
    for (const SensorFacts& strength : facts.strengths)
        if (const auto found = strength.log->lowest())
            lowest = std::min(lowest.value_or(*found), *found);
    if (facts.typed) return passed("strength", "A person reads the autocollimator.");
    if (!lowest && facts.circular)
        return passed("strength", "The ballbar does not tell the strength of its signal.");
    if (!lowest) return passed("strength", "The laser does not tell the strength of its signal.");
    const std::string seen = "The weakest signal lately was " + plain_number(*lowest, 0) + " %";
    if (*lowest >= limit) return passed("strength", seen + ".");
    return failed("strength", seen + "; " + plain_number(limit, 0) +
                                  " % are asked. Align the beam over the whole travel.");
}

/// The standing axis's readings in micrometres that span the drift window until now: also the last
/// one before it. Times are seconds since its beginning.
DriftSeries readings_of_the_laser(const PreflightFacts& facts) {
    const MonotonicTime begin = facts.now - facts.config.preflight.drift_window;
    DriftSeries series;
    for (const Sample& sample : facts.laser_samples) {
        const auto reading_m = sample.value();
        const double at_s = seconds_of(sample.at - begin);
        if (!reading_m || (!series.times.empty() && at_s <= series.times.back())) continue;
        if (at_s <= 0) series = {}; // only the last one before the window is of use
        series.times.push_back(at_s);
        series.readings.push_back(*reading_m * 1e6);
    }
    return series;
}

/// No more than some thousand readings, evenly taken: a line needs no more, and the loop no wait.
DriftSeries thinned(const DriftSeries& series) {
    constexpr std::size_t enough = 1000;
    const std::size_t stride = series.times.size() / enough + 1;
    DriftSeries few;
    for (std::size_t i = 0; i < series.times.size(); i += stride) {
        few.times.push_back(series.times[i]);
        few.readings.push_back(series.readings[i]);
    }
    return few;
}

bool spans_window(const DriftSeries& series, double window_s) {
    if (series.times.size() < 2 || window_s - series.times.front() < window_s * nearly_whole)
        return false;
    double longest_s = window_s - series.times.back();
    for (std::size_t i = 1; i < series.times.size(); ++i)
        longest_s = std::max(longest_s, series.times[i] - series.times[i - 1]);
    return longest_s <= window_s * longest_break;
}

/// The standing bar's good readings within the window, in micrometres.
DriftSeries readings_of_the_bar(const PreflightFacts& facts) {
    constexpr double um_per_m = 1e6;
    DriftSeries series = facts.bar != nullptr
                             ? facts.bar->last(facts.config.preflight.drift_window, facts.now)
                             : DriftSeries{};
    for (double& reading : series.readings)
        reading *= um_per_m;
    return series;
}

PreflightRecord check_drift(const PreflightFacts& facts) {
    const PreflightConfig& limits = facts.config.preflight;
    if (limits.drift_window <= Duration{})
        return passed("drift", "Not asked: preflight.drift_window is 0.");
    if (facts.typed) return passed("drift", "Not judged: a person reads the autocollimator.");
    constexpr double moved_um = 50; // no drift: the axis was driven
    const DriftSeries series =
        facts.circular ? readings_of_the_bar(facts) : readings_of_the_laser(facts);
    const double window_s = seconds_of(limits.drift_window);
    if (facts.circular && series.times.empty())
        return passed("drift", "Not judged: at rest the ballbar gives no reading in its range.");
    if (!spans_window(series, window_s))
        return failed("drift", (facts.circular ? "The ballbar" : "The laser") +
                                   std::string{" has been read for less than "} +
                                   in_minutes(limits.drift_window) + " without a break. Wait.");
    if (total_range(series).range > moved_um)
        return failed("drift", "The axis moved within the last " + in_minutes(limits.drift_window) +
                                   (facts.circular ? ". Let the machine rest beside the circle."
                                                   : ". Let it stand at its datum."));
    const double change_um = slope_of(thinned(series)) * window_s;
    const std::string seen =
        std::string{"The reading of the standing "} + (facts.circular ? "ballbar" : "axis") +
        " drifts by " + plain_number(change_um, 2) + " um in " + in_minutes(limits.drift_window);
    if (std::fabs(change_um) <= limits.drift_limit.in(um)) return passed("drift", seen + ".");
    return failed("drift", seen + ", " + in_um(limits.drift_limit) + " are allowed. Let " +
                               (facts.circular ? "ballbar" : "laser") + " and machine warm up.");
}

/// F and D at 20 degC need the machine's coefficient; form alone does not.
PreflightRecord check_expansion_of_circles(const PreflightFacts& facts) {
    const CircularSetup& setup = facts.config.circular->setup;
    const double alpha_per_K = setup.machine_alpha_per_K.value_or(0);
    if (alpha_per_K <= 0)
        return warned("expansion", "The machine's coefficient of expansion is not stated: F and D "
                                   "stand as measured.");
    const std::string coefficient =
        plain_number(per_kelvin(alpha_per_K).in(um_per_m_kelvin), 2) + " um/(m*K)";
    if (setup.uncertainty.machine_alpha_width_per_K ||
        facts.config.axis.material.standard_uncertainty)
        return passed("expansion", "The coefficient " + coefficient + " has its uncertainty.");
    return failed("expansion", "The coefficient " + coefficient +
                                   " stands without its uncertainty. State "
                                   "circular.uncertainty.machine_expansion_width.");
}

PreflightRecord check_expansion(const PreflightFacts& facts) {
    if (facts.circular) return check_expansion_of_circles(facts);
    const auto& material = facts.config.axis.material;
    const bool width = facts.config.uncertainty && facts.config.uncertainty->expansion_width;
    const bool rotary = facts.config.cycle.axis_kind == AxisKind::rotary;
    const std::string coefficient =
        plain_number(material.coefficient.in(um_per_m_kelvin), 2) + " um/(m*K)";
    if (rotary) return passed("expansion", "A rotary axis has no length to expand.");
    if (material.coefficient.si() <= 0)
        return failed("expansion", "The coefficient of expansion is 0. Write the real one into "
                                   "axis.material.coefficient.");
    if (material.standard_uncertainty || width)
        return passed("expansion", "The coefficient " + coefficient + " has its uncertainty.");
    return failed("expansion", "The coefficient " + coefficient +
                                   " stands without its uncertainty. State "
                                   "axis.material.standard_uncertainty.");
}

PreflightRecord check_compensation(const PreflightFacts& facts) {
    constexpr std::array<std::string_view, 3> known{"as found", "raw", "as left"};
    const bool said = std::ranges::find(known, facts.state) != known.end();
    if (!said)
        return failed(
            "compensation",
            "The state of the machine is " +
                (facts.state.empty() ? std::string{"not stated"} : "\"" + facts.state + "\"") +
                ". Say \"as found\", \"raw\" or \"as left\": axiscal arm --state-that "
                "state=\"as found\".");
    if (facts.control_compensation.empty())
        return failed("compensation",
                      "Which compensation of the control is active is not stated. Say it: axiscal "
                      "arm --state-that control_compensation=\"none\".");
    return passed("compensation", "The machine is measured " + facts.state +
                                      "; compensation: " + facts.control_compensation + ".");
}

/// A date that is past blocks. What is not stated does not, for a shop may have no certificates: it
/// is named, and the certificate says so.
PreflightRecord check_certificates(const PreflightFacts& facts) {
    std::string expired, silent;
    for (const InstrumentConfig& instrument : facts.config.instruments) {
        if (std::ranges::find(facts.in_use, instrument.name) == facts.in_use.end()) continue;
        for (const ChannelConfig& channel : instrument.channels)
            if (!channel.calibration.due_on.empty() && channel.calibration.due_on < facts.today)
                join(expired, instrument.name + "/" + channel.channel +
                                  " was due for calibration on " + channel.calibration.due_on);
        if (!instrument.due_on.empty() && instrument.due_on < facts.today)
            join(expired, instrument.name + " was due for calibration on " + instrument.due_on);
        else if (instrument.certificate_number.empty())
            join(silent, instrument.name + " has no certificate_number in the station file");
        else if (instrument.due_on.empty())
            join(silent, instrument.name + " has no due_on in the station file");
    }
    if (facts.config.axis.angle && !facts.circular) {
        const InstrumentRecord& artefact = facts.config.axis.angle->artefact;
        if (!artefact.due_on.empty() && artefact.due_on < facts.today)
            join(expired, artefact.name + " was due for calibration on " + artefact.due_on);
        else if (artefact.certificate_number.empty())
            join(silent, artefact.name + " has no certificate_number in the station file");
    }
    const std::string unknown =
        silent.empty() ? "" : silent + ". Whether it is calibrated and in date is not known.";
    if (!expired.empty())
        return failed("certificates", expired +
                                          ". Have it calibrated, or enter the new certificate." +
                                          (unknown.empty() ? "" : " Besides: " + unknown));
    if (!unknown.empty()) return warned("certificates", unknown);
    return passed("certificates", "Every instrument has a certificate that is in date.");
}

/// Asked for, for the eccentricity of the artefact over the axis shows in the readings; what is not
/// stated is printed as "not stated".
PreflightRecord check_run_out(const PreflightFacts& facts) {
    if (facts.run_out.empty())
        return warned("run_out", "The run-out of the set-up is not stated. Turn the axis under a "
                                 "dial gauge at the artefact's rim and say what it shows: axiscal "
                                 "arm --state-that run_out=\"8 um\".");
    return passed("run_out", "Run-out of the set-up: " + facts.run_out + ".");
}

PreflightRecord check_environment(const PreflightFacts& facts) {
    const EnvironmentLimits& limits = facts.config.environment;
    if (!limits.stated())
        return passed("environment", "The station file states no limits of the environment.");
    const std::string outside = outside_limits(limits, facts.sensors, facts.now);
    if (outside.empty()) return passed("environment", "Air and machine are within their limits.");
    return failed("environment", outside + ". Wait until it is back, or mend what drives it.");
}

} // namespace

std::vector<PreflightRecord> judge_preflight(const PreflightFacts& facts) {
    std::vector<PreflightRecord> checks{check_instruments(facts),  check_soak(facts),
                                        check_sensors(facts),      check_contact(facts),
                                        check_strength(facts),     check_drift(facts),
                                        check_expansion(facts),    check_compensation(facts),
                                        check_certificates(facts), check_environment(facts)};
    if (facts.config.axis.angle && !facts.circular) checks.push_back(check_run_out(facts));
    return checks;
}

Result<void> override_checks(std::vector<PreflightRecord>& checks,
                             const std::map<std::string, std::string>& reasons) {
    for (const auto& [name, reason] : reasons) {
        const auto check = std::ranges::find(checks, name, &PreflightRecord::name);
        if (check == checks.end()) {
            std::string known;
            for (const PreflightRecord& known_check : checks)
                known += (known.empty() ? "" : ", ") + known_check.name;
            return refuse(Fault::bad_request, "overrides." + name,
                          "is no check; there are " + known);
        }
        if (reason.find_first_not_of(" \t") == std::string::npos)
            return refuse(Fault::bad_request, "overrides." + name, "needs a reason: it is printed");
        if (!check->passed) check->override_reason = reason;
    }
    return {};
}

std::string open_objections(const std::vector<PreflightRecord>& checks) {
    std::string text;
    for (const PreflightRecord& check : checks)
        if (!check.passed && check.override_reason.empty())
            text += (text.empty() ? "" : " ") + check.name + ": " + check.verdict;
    return text;
}

} // namespace axiscal

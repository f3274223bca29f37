#include "analysis/drift/run_drift.hpp"

#include "analysis/air_refraction.hpp"
#include "analysis/environment_history.hpp"
#include "analysis/thermal_compensation.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr double seconds_a_minute = 60;

/// The channel that measures the axis: the displacement of the run's laser.
const ChannelRecord* laser_channel_of(const RunRecord& run) {
    const auto found = std::ranges::find_if(run.channels, [&](const ChannelRecord& channel) {
        return channel.kind == ChannelKind::displacement &&
               channel.instrument == run.laser.instrument;
    });
    return found == run.channels.end() ? nullptr : &*found;
}

std::vector<EnvironmentReading> readings_of(const RunRecord& run, int channel) {
    std::vector<EnvironmentReading> readings;
    for (const EnvironmentReading& reading : run.environment)
        if (reading.channel == channel && std::isfinite(reading.value)) readings.push_back(reading);
    std::ranges::stable_sort(readings, {}, &EnvironmentReading::at);
    return readings;
}

/// As stored, or a length in um.
ChannelDrift drift_of(const ChannelRecord& channel,
                      const std::vector<EnvironmentReading>& readings,
                      MonotonicTime origin,
                      double window_min) {
    ChannelDrift drift;
    drift.name = channel.name;
    drift.place = channel.place;
    drift.kind = channel.kind;
    drift.medium = channel.medium;
    drift.correction = channel.correction;
    const bool length = channel.kind == ChannelKind::displacement;
    drift.unit = length ? "um" : std::string{stored_unit_of(channel.kind)};
    const double first = length && !readings.empty() ? readings.front().value : 0;
    for (const EnvironmentReading& reading : readings) {
        const double minute = seconds_of(reading.at - origin) / seconds_a_minute;
        auto& times = drift.series.times;
        if (!times.empty() && minute <= times.back()) continue;
        times.push_back(minute);
        drift.series.readings.push_back(length ? metre(reading.value - first).in(um)
                                               : reading.value);
    }
    if (drift.series.times.empty()) return drift;
    drift.total = total_range(drift.series);
    drift.window = largest_window_range(drift.series, window_min);
    return drift;
}

/// Carries the readings of the resting axis to 20 degC.
class RestingAxis {
public:
    RestingAxis(const RunRecord& run, const DriftSetup& setup)
        : run_{run}
        , environment_{run}
        , from_datum_{(setup.place - run.plan.datum) * static_cast<double>(run.laser.sign)}
        , cosine_{cosine_factor_of(run.laser)} {}

    /// Coordinate of the axis; the first call fixes where it stands.
    Result<Length> coordinate(const EnvironmentReading& reading) {
        AXISCAL_TRY(const Temperature material, environment_.material_at(reading.at, "drift"));
        AXISCAL_TRY(const Length length, run_.scale ? by_scale(reading) : by_laser(reading));
        const Length at_20C =
            displacement_at_20C(length, run_.material.coefficient, material, run_.material.form);
        return at_20C * static_cast<double>(run_.laser.sign);
    }

private:
    Result<Length> by_laser(const EnvironmentReading& reading) {
        AXISCAL_TRY(const AirState air, environment_.air_at(reading.at, "drift"));
        AXISCAL_TRY(const Refractivity index, refractivity_of(run_.air.formula, air));
        if (!first_m_) first_m_ = reading.value, n0_minus_1_ = index.n_minus_1;
        const Length vacuum = from_datum_ * (1 + n0_minus_1_) + metre(reading.value - *first_m_);
        return displacement_in_air(vacuum, index.n_minus_1, n0_minus_1_, run_.laser.dead_path) *
               cosine_;
    }

    /// As if the scale had been zeroed at the datum: (D_0 / (1 + s_0) + V - V_0) (1 + s).
    Result<Length> by_scale(const EnvironmentReading& reading) {
        AXISCAL_TRY(const Temperature scale, environment_.scale_at(reading.at, "drift"));
        const Expansion alpha = run_.scale->coefficient;
        if (!first_m_) {
            first_m_ = reading.value;
            counted_at_first_ =
                from_datum_ / displacement_by_scale(metre(1), alpha, scale).in(metre);
        }
        const Length counted = counted_at_first_ + metre(reading.value - *first_m_);
        return displacement_by_scale(counted, alpha, scale);
    }

    const RunRecord& run_;
    EnvironmentHistory environment_;
    Length from_datum_, counted_at_first_;
    double cosine_;
    std::optional<double> first_m_;
    double n0_minus_1_ = 0;
};

void follow_axis(const RunRecord& run,
                 const std::vector<EnvironmentReading>& readings,
                 RunDrift& drift,
                 DriftSeries& as_read) {
    RestingAxis axis{run, drift.setup};
    std::optional<Length> first;
    double first_m = 0;
    for (const EnvironmentReading& reading : readings) {
        const auto coordinate = axis.coordinate(reading);
        if (!coordinate) {
            ++drift.without_air;
            continue;
        }
        if (!first) first = *coordinate, first_m = reading.value;
        const double minute = seconds_of(reading.at - run.opened.before) / seconds_a_minute;
        drift.axis.times.push_back(minute);
        drift.axis.readings.push_back((*coordinate - *first).in(um));
        as_read.times.push_back(minute);
        as_read.readings.push_back(metre(reading.value - first_m).in(um));
    }
}

Result<void> check_test(const RunRecord& run, const DriftSetup& setup) {
    if (!run.complete)
        return fail(Fault::incomplete_run,
                    "the drift test was not closed as complete" +
                        (run.closing_reason.empty() ? std::string{} : ": " + run.closing_reason));
    if (run.plan.axis_kind == AxisKind::rotary)
        return fail(Fault::refused, "a rotary axis has no length to bring to 20 degC");
    if (!laser_channel_of(run))
        return fail(Fault::bad_run_file, "the drift test holds no channel of its laser or scale");
    if (setup.interval <= Duration{} || setup.duration < setup.interval)
        return fail(Fault::bad_run_file, "the interval of the drift test cannot be");
    return {};
}

} // namespace

Result<RunDrift> evaluate_drift(const RunRecord& run, const DriftSetup& setup) {
    AXISCAL_CHECK(check_test(run, setup));
    RunDrift drift;
    drift.setup = setup;
    const ChannelRecord& laser = *laser_channel_of(run);
    const auto readings = readings_of(run, laser.id);
    DriftSeries as_read;
    follow_axis(run, readings, drift, as_read);
    if (auto usable = check_series(drift.axis, "laser", 2); !usable)
        return fail(Fault::incomplete_run, "the drift test has " +
                                               std::to_string(drift.axis.times.size()) +
                                               " usable readings of the laser; it needs two");
    const auto planned = setup.duration / setup.interval;
    drift.missing = static_cast<int>(
        std::max<std::int64_t>(0, planned - static_cast<std::int64_t>(readings.size())));
    drift.eve = total_range(drift.axis);
    drift.window = largest_window_range(drift.axis, drift.window_min);
    drift.as_read = total_range(as_read);
    drift.end_change = drift.axis.readings.back();
    for (const ChannelRecord& channel : run.channels)
        if (channel.id != laser.id)
            drift.channels.push_back(drift_of(channel, readings_of(run, channel.id),
                                              run.opened.before, drift.window_min));
    return drift;
}

} // namespace axiscal

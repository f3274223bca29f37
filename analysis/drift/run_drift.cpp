#include "analysis/drift/run_drift.hpp"

#include "analysis/drift/resting_axis.hpp"
#include "analysis/quantity/counted.hpp"
#include "analysis/uncertainty/run_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr double seconds_a_minute = 60, minutes_an_hour = 60;

/// The channel that measures the axis: the displacement of the run's laser, scale or ballbar. Of an
/// instrument with several it stands first.
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

std::optional<double> slope_per_hour(const DriftSeries& series) {
    const auto per_minute = least_squares_slope(series);
    return per_minute ? std::optional{*per_minute * minutes_an_hour} : std::nullopt;
}

/// As stored, or a length in um.
ChannelDrift drift_of(const ChannelRecord& channel,
                      const std::vector<EnvironmentReading>& readings,
                      MonotonicTime origin,
                      double window_min) {
    ChannelDrift drift;
    drift.name = channel.name;
    drift.instrument = channel.instrument;
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
    drift.slope_per_h = slope_per_hour(drift.series);
    return drift;
}

/// A change of the bare reading in the direction of the axis; of a rotary one the angle that it
/// shows with the reflectors square.
double bare_in_budget_units(const RunRecord& run, Length change) {
    const Length forwards = change * static_cast<double>(run.laser.sign);
    return run.rotary ? radian(forwards / run.rotary->arm).in(arcsec) : forwards.in(um);
}

/// What became no coordinate at that minute is counted with its like.
void leave_out(const Error& why, double minute, RunDrift& drift) {
    if (why.fault == Fault::environment_stale) {
        ++drift.without_air;
        return;
    }
    auto like = std::ranges::find(drift.refused, why.fault, &RefusedReadings::fault);
    if (like == drift.refused.end()) {
        const std::string field = why.field.empty() ? "" : why.field + " ";
        like = drift.refused.insert(like, {why.fault, field + why.detail, 0, minute, minute});
    }
    ++like->count;
    like->last_min = minute;
}

void follow_axis(const RunRecord& run,
                 const std::vector<EnvironmentReading>& readings,
                 RunDrift& drift) {
    RestingAxis axis{run, drift.setup};
    std::optional<Length> first;
    double first_m = 0;
    for (const EnvironmentReading& reading : readings) {
        const double minute = seconds_of(reading.at - run.opened.before) / seconds_a_minute;
        const auto coordinate = axis.coordinate(reading);
        if (!coordinate) {
            leave_out(coordinate.error(), minute, drift);
            continue;
        }
        if (!first) first = *coordinate, first_m = reading.value;
        drift.axis.times.push_back(minute);
        drift.axis.readings.push_back(in_budget_units(run, *coordinate - *first));
        drift.bare.times.push_back(minute);
        drift.bare.readings.push_back(bare_in_budget_units(run, metre(reading.value - first_m)));
    }
}

/// Too few readings are left, and why.
tl::unexpected<Error> too_few(const RunRecord& run, const RunDrift& drift) {
    const std::string watched{drift.of_bar ? "ballbar" : reference_word_of(run)};
    const long usable = static_cast<long>(drift.axis.times.size());
    std::string words = "the drift test has " + counted(usable, "usable reading") + " of the " +
                        watched + "; it needs two";
    if (drift.without_air > 0)
        words += "; " + counted(drift.without_air, "has", "have") + " no fresh " +
                 (run.scale ? "temperature of scale and material" : "air or material") +
                 (drift.without_air == 1 ? " beside it" : " beside them");
    for (const RefusedReadings& refused : drift.refused)
        words += "; " + std::to_string(refused.count) + " cannot be evaluated: " + refused.reason;
    return fail(Fault::incomplete_run, words);
}

/// A linear axis has no artefact; a rotary one needs a table that something reads.
Result<void> check_angle(const RunRecord& run) {
    if (run.plan.axis_kind != AxisKind::rotary) {
        if (!run.rotary) return {};
        return fail(Fault::bad_run_file, "the drift test of a linear axis states an artefact of "
                                         "angles");
    }
    if (!run.rotary || run.rotary->method == AngleMethod::polygon)
        return fail(Fault::refused, "the drift test of a rotary axis needs an indexing table under "
                                    "an angular interferometer; before a polygon it is not "
                                    "supported: state uncertainty.eve by hand");
    if (!(run.rotary->arm > Length{}))
        return fail(Fault::bad_run_file, "the drift test states no arm of its interferometer");
    return {};
}

Result<void> check_test(const RunRecord& run, const DriftSetup& setup) {
    if (!run.complete)
        return fail(Fault::incomplete_run,
                    "the drift test was not closed as complete" +
                        (run.closing_reason.empty() ? std::string{} : ": " + run.closing_reason));
    AXISCAL_CHECK(check_angle(run));
    if (!laser_channel_of(run))
        return fail(Fault::bad_run_file, std::string{"the drift test holds no channel of its "} +
                                             (setup.of_bar ? "ballbar" : "laser or scale"));
    if (setup.interval <= Duration{} || setup.duration < setup.interval)
        return fail(Fault::bad_run_file, "the interval of the drift test cannot be");
    return {};
}

} // namespace

std::string full_name_of(const ChannelDrift& channel) {
    return channel.instrument + "/" + channel.name;
}

Result<RunDrift> evaluate_drift(const RunRecord& run, const DriftSetup& setup) {
    AXISCAL_CHECK(check_test(run, setup));
    RunDrift drift;
    drift.setup = setup;
    drift.of_bar = setup.of_bar;
    if (run.rotary) drift.unit = "arcsec";
    const ChannelRecord& laser = *laser_channel_of(run);
    const auto readings = readings_of(run, laser.id);
    follow_axis(run, readings, drift);
    if (!check_series(drift.axis, "laser", 2)) return too_few(run, drift);
    const auto planned = setup.duration / setup.interval;
    drift.missing = static_cast<int>(
        std::max<std::int64_t>(0, planned - static_cast<std::int64_t>(readings.size())));
    drift.eve = total_range(drift.axis);
    drift.window = largest_window_range(drift.axis, drift.window_min);
    drift.as_read = total_range(drift.bare);
    drift.end_change = drift.axis.readings.back();
    drift.slope_per_h = slope_per_hour(drift.axis);
    drift.reading = drift_of(laser, readings, run.opened.before, drift.window_min);
    for (const ChannelRecord& channel : run.channels)
        if (channel.id != laser.id)
            drift.channels.push_back(drift_of(channel, readings_of(run, channel.id),
                                              run.opened.before, drift.window_min));
    return drift;
}

} // namespace axiscal

#include "analysis/setup/frozen_sensor.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// Ten minutes; of a window of that length a sensor that is asked seldom shows a little less.
constexpr double least_span_s = 570;
constexpr std::ptrdiff_t fewest_readings = 10;
/// The air of a shop changes by more in ten minutes.
constexpr double telling_K = 0.02, telling_Pa = 5;

/// The last decimal place of a figure: 0.1 of 20.4, 100 of 101300. What has more than six places
/// was computed, and its last digit is none of an instrument.
std::optional<double> last_digit_of(double value) {
    double digit = 1000;
    for (int places = -3; places <= 6; ++places, digit /= 10) {
        const double digits = value / digit;
        if (std::fabs(digits - std::round(digits)) < 1e-6) return digit;
    }
    return std::nullopt;
}

std::optional<double> resolution_of(const SensorTrack& track) {
    const std::vector<double>& values = track.readings.readings;
    std::optional<double> smallest;
    for (std::size_t i = 1; i < values.size(); ++i)
        if (const double change = std::fabs(values[i] - values[i - 1]); change > 0)
            smallest = std::min(smallest.value_or(change), change);
    if (smallest || values.empty() || !track.as_sent) return smallest;
    return last_digit_of(values.front());
}

bool is_fine(const SensorTrack& track) {
    const double coarsest = track.kind == ChannelKind::temperature ? telling_K
                            : track.kind == ChannelKind::pressure  ? telling_Pa
                                                                   : 0;
    const auto resolution = resolution_of(track);
    return resolution && *resolution <= coarsest;
}

/// Times at which a quantity shows something new, its first reading included.
std::vector<double> changes_of(std::span<const SensorTrack> instrument) {
    std::vector<double> changes;
    for (const SensorTrack& track : instrument) {
        const auto& [times, values] = track.readings;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (i == 0 || values[i] != values[i - 1]) changes.push_back(times[i]);
    }
    std::ranges::sort(changes);
    return changes;
}

/// The readings of a fine quantity from `begin_s` on and before `end_s`.
std::span<const double> times_between(const SensorTrack& track, double begin_s, double end_s) {
    const auto& times = track.readings.times;
    const auto first = std::ranges::lower_bound(times, begin_s);
    return {first, std::ranges::lower_bound(first, times.end(), end_s)};
}

bool is_corrected(const RunRecord& run, const ChannelRecord& channel) {
    const auto calibration =
        std::ranges::find(run.calibrations, channel.id, &ChannelCalibration::channel);
    return channel.correction != 0 ||
           (calibration != run.calibrations.end() && !calibration->corrections.empty());
}

} // namespace

std::optional<FrozenSpan> find_frozen_span(std::span<const SensorTrack> instrument) {
    const auto fine = std::ranges::find_if(instrument, is_fine);
    if (fine == instrument.end()) return std::nullopt;
    const std::vector<double> changes = changes_of(instrument);
    std::optional<FrozenSpan> longest;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const double next = i + 1 < changes.size() ? changes[i + 1] : HUGE_VAL;
        const auto times = times_between(*fine, changes[i], next);
        if (std::ssize(times) < fewest_readings) continue;
        const FrozenSpan span{times.front(), times.back()};
        const double length_s = span.end_s - span.begin_s;
        if (length_s < least_span_s) continue;
        if (!longest || length_s > longest->end_s - longest->begin_s) longest = span;
    }
    return longest;
}

DriftSeries readings_within(const RunRecord& run, int channel) {
    DriftSeries series;
    const MonotonicTime begin = run.points.front().window_begin, end = run.points.back().window_end;
    for (const EnvironmentReading& reading : run.environment) {
        if (reading.channel != channel || reading.at < begin || reading.at > end) continue;
        const double at_s = seconds_of(reading.at - begin);
        if (!series.times.empty() && at_s <= series.times.back()) continue;
        series.times.push_back(at_s);
        series.readings.push_back(reading.value);
    }
    return series;
}

std::vector<AirInstrument> air_instruments_of(const RunRecord& run) {
    std::vector<AirInstrument> instruments;
    if (run.points.empty()) return instruments;
    for (const ChannelRecord& channel : run.channels) {
        if (channel.medium != Medium::air) continue;
        auto found = std::ranges::find(instruments, channel.instrument, &AirInstrument::name);
        if (found == instruments.end()) {
            instruments.push_back({channel.instrument, {}});
            found = std::prev(instruments.end());
        }
        found->tracks.push_back(
            {channel.kind, readings_within(run, channel.id), !is_corrected(run, channel)});
    }
    return instruments;
}

} // namespace axiscal

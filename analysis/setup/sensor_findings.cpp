#include "analysis/setup/sensor_findings.hpp"

#include "analysis/setup/air_share.hpp"
#include "analysis/setup/frozen_sensor.hpp"
#include "analysis/setup/setup_words.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

constexpr double window_s = 1200;
constexpr double least_share = 0.7, least_correlation = 0.9;

DriftSeries between(const DriftSeries& series, double begin_s, double end_s) {
    DriftSeries part;
    for (std::size_t i = 0; i < series.times.size(); ++i) {
        if (series.times[i] < begin_s || series.times[i] >= end_s) continue;
        part.times.push_back(series.times[i]);
        part.readings.push_back(series.readings[i]);
    }
    return part;
}

/// Over all whole windows of the run; a last one that is shorter is looked at where it has half the
/// length.
std::optional<double> share_of(const DriftSeries& material, const DriftSeries& air) {
    if (material.times.empty()) return std::nullopt;
    AirShare share;
    const double end_s = material.times.back();
    for (double begin_s = material.times.front(); end_s - begin_s >= window_s / 2;
         begin_s += window_s)
        share.add_window(between(material, begin_s, begin_s + window_s),
                         between(air, begin_s, begin_s + window_s));
    return share.share(least_correlation);
}

const SensorTrack* air_temperature_of(const std::vector<AirInstrument>& instruments) {
    for (const AirInstrument& instrument : instruments)
        for (const SensorTrack& track : instrument.tracks)
            if (track.kind == ChannelKind::temperature) return &track;
    return nullptr;
}

SetupFinding told(SetupError error, double value, std::string sensor) {
    SetupFinding finding;
    finding.error = error;
    finding.value = value;
    finding.sensor = std::move(sensor);
    put_into_words(finding);
    return finding;
}

} // namespace

std::vector<SetupFinding> find_sensor_errors(const RunRecord& run) {
    std::vector<SetupFinding> findings;
    if (run.points.empty()) return findings;
    const auto instruments = air_instruments_of(run);
    for (const AirInstrument& instrument : instruments) {
        const auto span = find_frozen_span(instrument.tracks);
        if (span && !run.scale)
            findings.push_back(
                told(SetupError::frozen_air, (span->end_s - span->begin_s) / 60, instrument.name));
    }
    const SensorTrack* const air = air_temperature_of(instruments);
    if (air == nullptr) return findings;
    for (const ChannelRecord& channel : run.channels) {
        if (channel.medium != Medium::material || sits_on_scale(run, channel.id)) continue;
        const auto share = share_of(readings_within(run, channel.id), air->readings);
        if (share && *share >= least_share)
            findings.push_back(told(SetupError::sensor_in_air, *share, channel.name));
    }
    return findings;
}

} // namespace axiscal

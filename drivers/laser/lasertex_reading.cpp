#include "drivers/laser/lasertex_reading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

/// [rate] A distance comes about 25 times a second, the readings of a sensor once a second.
constexpr Duration distance_period = std::chrono::milliseconds{40};
constexpr Duration meteo_period = std::chrono::seconds{1};
/// A host that stalls finds every frame of its pause afterwards. Where fewer than half of them come
/// after so long, the laser itself was silent: it was switched off, or restarted.
constexpr Duration longest_pause = std::chrono::seconds{1};
/// Asked by the grid of the frames, half of their period beside it: by the moment of a frame a tape
/// that is played could ask one frame earlier than the recorder did.
constexpr Duration forget_period = std::chrono::milliseconds{980};
/// A position may wander by this within one frame, beside the motion of the axis.
constexpr double wander_m = 1e-6;

} // namespace

LasertexReading::LasertexReading(Speed fastest, InstrumentCounters& counters)
    : fastest_{fastest}
    , counters_{counters} {}

void LasertexReading::opened(MonotonicTime now, Duration late) {
    late_ = late;
    last_read_at_ = now;
    forget_next_ = now;
    begun_ = signal_lost_ = false;
    told_ = Fault::none;
    signal_ = {};
    last_position_m_.reset();
    if (datum_in_use_) ++epoch_;
    datum_in_use_ = false;
}

void LasertexReading::lose_datum(SampleSink& sink, Fault fault, std::string sentence) {
    sink.note(fault, std::move(sentence));
    last_position_m_.reset();
    if (datum_in_use_) ++epoch_;
    datum_in_use_ = false;
}

void LasertexReading::take(std::span<const LasertexArrival> arrivals, SampleSink& sink) {
    for (const LasertexArrival& arrival : arrivals) {
        if (!arrival.message) continue;
        if (const auto* distance = std::get_if<LasertexDistance>(&*arrival.message)) {
            if (arrival.read_at != last_read_at_)
                follow_stream(arrival.read_at, arrival.behind + 1, sink);
            last_read_at_ = arrival.read_at;
            if (begun_) take_distance(*distance, arrival.behind, sink);
        } else if (const auto* meteo = std::get_if<LasertexMeteo>(&*arrival.message)) {
            if (begun_) take_meteo(*meteo, arrival.read_at, sink);
        }
    }
}

/// @param together  distances that were read at this moment
void LasertexReading::follow_stream(MonotonicTime read_at,
                                    std::int64_t together,
                                    SampleSink& sink) {
    const Duration pause = read_at - last_read_at_;
    if (!begun_ || pause <= longest_pause || together * distance_period * 2 >= pause) return;
    ++counters_.restarts;
    lose_datum(sink, Fault::datum_lost, "the laser was silent: it may have restarted");
    signal_lost_ = false; // told with it
}

LasertexReading::Trouble LasertexReading::trouble_of(const LasertexSignal& signal) {
    if (!signal.laser_ready)
        return {Fault::signal_error, Quality::signal_error,
                "the laser is not ready: it warms up, or has lost its frequency"};
    if (signal.weak)
        return {Fault::beam_lost, Quality::beam_lost, "the measuring beam is lost or too weak"};
    if (signal.overspeed)
        return {Fault::overspeed, Quality::signal_error,
                "the axis moved faster than the laser can count"};
    return {};
}

/// Frames read together are as far apart as they were sent; the last is as old as one can be.
void LasertexReading::take_distance(const LasertexDistance& distance,
                                    std::int64_t behind,
                                    SampleSink& sink) {
    signal_ = distance.signal;
    PlacedTime placed =
        placed_at_end(last_read_at_ - behind * distance_period, distance_period + late_);
    // Never back: what came late in one piece is spread over the time before it.
    placed.at = std::max(placed.at, last_at_ + std::chrono::microseconds{1});
    last_at_ = placed.at;
    hand_up(lasertex_level, placed, signal_.level, sink);
    ++counters_.samples;
    const Trouble trouble = trouble_of(signal_);
    if (std::exchange(told_, trouble.fault) != trouble.fault && trouble.fault != Fault::none)
        sink.note(trouble.fault, trouble.sentence);
    if (trouble.fault != Fault::none) {
        signal_lost_ = true;
        sink.take(Sample::bad(lasertex_position, placed.at, trouble.quality, 0, epoch_));
        return;
    }
    if (std::exchange(signal_lost_, false))
        lose_datum(sink, Fault::datum_lost, "the signal is back, counts were lost");
    judge_jump(distance.position_m, placed.at, sink);
    datum_in_use_ = true;
    Sample sample{lasertex_position, placed.at, distance.position_m, 0, epoch_};
    sample.time_uncertainty = placed.uncertainty;
    sink.take(sample);
}

/// The time between two frames is known to one period.
void LasertexReading::judge_jump(double position_m, MonotonicTime at, SampleSink& sink) {
    if (last_position_m_) {
        const double way_m = std::abs(position_m - *last_position_m_) - wander_m;
        const Duration passed = at - last_position_at_ + distance_period;
        if (way_m > fastest_.in(metre_per_second)*seconds_of(passed))
            lose_datum(sink, Fault::implausible_jump,
                       "the position jumped further than the axis can move: zeroed by hand or by "
                       "another program, restarted, or counts were lost");
    }
    last_position_m_ = position_m;
    last_position_at_ = at;
}

void LasertexReading::take_meteo(const LasertexMeteo& meteo,
                                 MonotonicTime read_at,
                                 SampleSink& sink) {
    const PlacedTime placed = placed_at_end(read_at, meteo_period + late_);
    constexpr int materials = lasertex_material_3 - lasertex_material_1 + 1;
    if (meteo.sensor > materials) return;
    if (meteo.sensor > 0)
        return hand_up(lasertex_material_1 + meteo.sensor - 1, placed, meteo.temperature_degC,
                       sink);
    hand_up(lasertex_air_temperature, placed, meteo.temperature_degC, sink);
    hand_up(lasertex_air_pressure, placed, meteo.pressure_Pa, sink);
    hand_up(lasertex_air_humidity, placed, meteo.humidity_percent, sink);
}

void LasertexReading::hand_up(int channel,
                              const PlacedTime& placed,
                              std::optional<double> value,
                              SampleSink& sink) {
    ++counters_.samples;
    sink.take(sample_at(channel, placed, value));
}

/// The first is told at once, then once a second, since the cause may still be there.
std::optional<LasertexCommand> LasertexReading::to_forget() {
    if (!begun_ || !(signal_.weak || signal_.overspeed) || last_read_at_ < forget_next_)
        return std::nullopt;
    forget_next_ = last_read_at_ + forget_period;
    return signal_.weak ? LasertexCommand::forget_weak_signal : LasertexCommand::forget_overspeed;
}

} // namespace axiscal

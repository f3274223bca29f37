#pragma once
// From frames of a Lasertex HPI-3D to samples: signal faults, datum, time. No I/O. Loop-bound.

#include "analysis/quantity/quantity.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/instrument.hpp"
#include "drivers/laser/lasertex_frame.hpp"

#include <span>

namespace axiscal {

/// Channel numbers of the driver; sensor n of the material is `lasertex_material_1 + n - 1`.
enum LasertexChannel : int {
    lasertex_position,
    lasertex_level,
    lasertex_air_temperature,
    lasertex_air_pressure,
    lasertex_air_humidity,
    lasertex_material_1,
    lasertex_material_2,
    lasertex_material_3
};

/// The frames bear no number and the laser keeps no record of its restarts, so the epoch rises
/// whenever counts may have been lost: new connection, a stream that stopped, a signal that was
/// lost, a jump that no axis makes.
class LasertexReading {
public:
    LasertexReading(Speed fastest, InstrumentCounters& counters);
    /// A link was opened that may hand bytes over so much late. Samples come after `begin`.
    void opened(MonotonicTime now, Duration late);
    /// The laser has forgotten its old faults: from now on they are new ones.
    void begin() { begun_ = true; }
    /// Frames that were confirmed together, the oldest first.
    void take(std::span<const LasertexArrival> arrivals, SampleSink& sink);
    /// What the laser is to be told so that its faults do not stand for ever; empty: nothing, or
    /// not yet.
    std::optional<LasertexCommand> to_forget();
    [[nodiscard]] MonotonicTime last_distance_at() const { return last_read_at_; }

private:
    struct Trouble {
        Fault fault = Fault::none;
        Quality quality = Quality::good;
        const char* sentence = "";
    };
    static Trouble trouble_of(const LasertexSignal& signal);
    void follow_stream(MonotonicTime read_at, std::int64_t together, SampleSink& sink);
    void take_distance(const LasertexDistance& distance, std::int64_t behind, SampleSink& sink);
    void take_meteo(const LasertexMeteo& meteo, MonotonicTime read_at, SampleSink& sink);
    void hand_up(int channel, const PlacedTime& placed, std::optional<double> value, SampleSink&);
    void judge_jump(double position_m, MonotonicTime at, SampleSink& sink);
    void lose_datum(SampleSink& sink, Fault fault, std::string sentence);

    Speed fastest_;
    InstrumentCounters& counters_;
    std::uint32_t epoch_ = 0;
    bool datum_in_use_ = false; ///< a sample was handed up in this epoch
    bool begun_ = false, signal_lost_ = false;
    Fault told_ = Fault::none;
    LasertexSignal signal_; ///< of the last distance
    Duration late_{};
    MonotonicTime last_read_at_{}, last_at_{}, forget_next_{};
    std::optional<double> last_position_m_;
    MonotonicTime last_position_at_{};
};

} // namespace axiscal

#pragma once
// From uMD records to samples: continuity, signal faults, datum, time. No I/O. Loop-bound.

#include "drivers/clock/device_clock.hpp"
#include "drivers/instrument.hpp"
#include "drivers/laser/umd_facts.hpp"
#include "drivers/laser/umd_record.hpp"

#include <span>

namespace axiscal {

/// Channel numbers of the uMD driver. The environment slots exist on the uMD1 only.
enum UmdChannel : int {
    umd_displacement,
    umd_temperature_1,
    umd_temperature_2,
    umd_pressure,
    umd_humidity
};

/// Hands up one displacement sample a record once the instrument's facts are known. The epoch
/// rises whenever counts may have been lost: restart, new connection, lost signal, slew error, or
/// a jump that no axis makes.
class UmdCounter {
public:
    UmdCounter(UmdSetup setup, InstrumentCounters& counters);
    /// A link was opened that hands up bytes once a `frame`: what the counter did meanwhile is
    /// unknown.
    void opened(Duration frame);
    /// The instrument printed its greeting: it restarted.
    void greeted(SampleSink& sink);
    /// Records that arrived together; their numbers and the record rate place them in time.
    void take(std::span<const UmdRecord> records, MonotonicTime read_at, SampleSink& sink);
    /// 65536 once the instrument is known to be a uMD0, whose number has 16 bits.
    [[nodiscard]] std::uint64_t modulus() const;

private:
    enum class Signal : std::uint8_t { good, doubtful, lost };
    struct Reading {
        Signal signal = Signal::good;
        Quality quality = Quality::good;
        Fault fault = Fault::none;
        const char* what = "";
        double counts = 0;
    };

    /// What a record is read with; all of it follows from the facts.
    struct Scale {
        UmdHead head = UmdHead::homodyne;
        UmdPhase phase = UmdPhase::none;
        double rate_Hz = 0, metres_per_count = 0;
    };

    void learn(const UmdRecord& record);
    void learn_environment(const UmdRecord& record, MonotonicTime at, SampleSink& sink);
    void introduce(SampleSink& sink);
    void complain_without_facts(SampleSink& sink);
    void follow_sequence(std::int64_t sequence, MonotonicTime read_at, SampleSink& sink);
    [[nodiscard]] std::int64_t step_of(std::int64_t sequence) const;
    void lose_datum(SampleSink& sink, Fault fault, std::string sentence);
    [[nodiscard]] Reading read(const UmdRecord& record) const;
    [[nodiscard]] Reading read_signal(const UmdRecord& record, const UmdAxisFields& axis) const;
    void judge_jump(double counts, SampleSink& sink);
    void hand_up(const Reading& reading, PlacedTime placed, SampleSink& sink);
    UmdSetup setup_;
    UmdFacts facts_;
    std::optional<Scale> scale_; ///< empty until everything is known
    Duration period_{};
    InstrumentCounters& counters_;
    std::uint32_t epoch_ = 0;
    bool datum_in_use_ = false; ///< a sample was handed up in this epoch
    bool signal_lost_ = false;
    bool introduced_ = false, complained_ = false, contradicted_ = false, doubted_ = false;
    std::optional<std::int64_t> last_sequence_;
    std::uint64_t device_count_ = 0;
    DeviceClock clock_{Duration{}};
    std::int64_t last_step_ = 1;
    int records_without_facts_ = 0;
    std::optional<double> last_counts_;
    std::int64_t steps_since_counts_ = 0;
    MonotonicTime last_read_at_{}, last_at_{};
};

} // namespace axiscal

#include "drivers/laser/umd_counter.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// The slowest low-speed schedule has 256 slots (uMD0); two cycles must tell everything.
constexpr int records_to_wait_for_facts = 600;
/// Below 0.1 MHz, and above twice the reference less 0.1 MHz, the counter misses edges.
constexpr double slew_margin_Hz = 1e5;
/// Until code 8 tells: the uMD2's.
constexpr double rate_before_told_Hz = 1000;
/// A sequence number may run ahead of the host's clock by what the host had buffered, no more.
constexpr double buffered_seconds = 5;
/// Interpolation and the last digit may move by this without any motion.
constexpr double jitter_counts = 2;
/// uMD1, field 4.
constexpr std::int64_t no_reference_bits = 0x0400 | 0x2000, no_measurement_bits = 0x0800 | 0x4000;

} // namespace

UmdCounter::UmdCounter(UmdSetup setup, InstrumentCounters& counters)
    : setup_{setup}
    , facts_{setup}
    , period_{from_seconds(1 / rate_before_told_Hz)}
    , counters_{counters} {}

void UmdCounter::opened(Duration frame) {
    clock_ = DeviceClock{frame};
    facts_ = UmdFacts{setup_}; // another firmware may answer now
    scale_.reset();
    period_ = from_seconds(1 / rate_before_told_Hz);
    records_without_facts_ = 0;
    introduced_ = complained_ = contradicted_ = false;
    last_sequence_.reset();
    last_counts_.reset();
    signal_lost_ = false;
    if (datum_in_use_) ++epoch_;
    datum_in_use_ = false;
}

void UmdCounter::greeted(SampleSink& sink) {
    if (!last_sequence_) return;
    ++counters_.restarts;
    lose_datum(sink, Fault::datum_lost, "the counter restarted");
    last_sequence_.reset();
}

/// Most records tell nothing new.
void UmdCounter::learn(const UmdRecord& record) {
    facts_.learn(record.low_speed_code, record.low_speed_data);
    if (record.low_speed_code == 0 && scale_) return;
    period_ = from_seconds(1 / facts_.rate_Hz().value_or(rate_before_told_Hz));
    if (facts_.complete())
        scale_ =
            Scale{*facts_.head(), *facts_.phase(), *facts_.rate_Hz(), facts_.metres_per_count()};
}

void UmdCounter::lose_datum(SampleSink& sink, Fault fault, std::string sentence) {
    sink.note(fault, std::move(sentence));
    last_counts_.reset();
    if (datum_in_use_) ++epoch_;
    datum_in_use_ = false;
}

void UmdCounter::take(std::span<const UmdRecord> records, MonotonicTime read_at, SampleSink& sink) {
    auto behind = std::ssize(records);
    for (const UmdRecord& record : records) {
        follow_sequence(record.sequence, read_at, sink);
        learn(record);
        PlacedTime placed = clock_.place(device_count_, read_at, period_, --behind);
        // Never back: a record that came quicker than all before moves the clock's origin.
        placed.at = std::max(placed.at, last_at_ + std::chrono::microseconds{1});
        last_at_ = placed.at;
        if (record.low_speed_code != 0) {
            learn_environment(record, placed.at, sink);
            introduce(sink);
        }
        if (scale_)
            hand_up(read(record), placed, sink);
        else
            complain_without_facts(sink);
    }
    last_read_at_ = read_at;
}

void UmdCounter::complain_without_facts(SampleSink& sink) {
    if (complained_ || ++records_without_facts_ < records_to_wait_for_facts) return;
    complained_ = true;
    sink.note(Fault::bad_configuration, facts_.missing());
}

void UmdCounter::introduce(SampleSink& sink) {
    if (!contradicted_ && !facts_.contradiction().empty()) {
        contradicted_ = true;
        sink.note(Fault::bad_configuration, facts_.contradiction());
    }
    if (introduced_ || !facts_.rate_Hz() || facts_.firmware().empty()) return;
    introduced_ = true;
    sink.identify(Identity{"Goldwasser/Beck", facts_.model(), "", facts_.firmware()});
}

/// -1 in a slot: the firmware was built without that sensor.
void UmdCounter::learn_environment(const UmdRecord& record, MonotonicTime at, SampleSink& sink) {
    const auto code = record.low_speed_code;
    if (code < 3 || code > 6) return;
    const auto raw = static_cast<double>(record.low_speed_data);
    const int channel = umd_temperature_1 + static_cast<int>(code) - 3;
    const bool absent = record.low_speed_data == -1;
    const double value = code == 5 ? raw : code == 6 ? raw / 10 : raw / 100;
    sink.take(absent ? Sample::bad(channel, at, Quality::absent) : Sample{channel, at, value});
}

std::uint64_t UmdCounter::modulus() const {
    return facts_.family() == UmdFamily::umd0 ? 65536 : 0;
}

/// How many records on `sequence` is. The uMD0 prints a 16-bit signed number that wraps.
std::int64_t UmdCounter::step_of(std::int64_t sequence) const {
    const std::int64_t step = sequence - *last_sequence_;
    const bool sixteen_bit =
        facts_.family() == UmdFamily::umd0 || sequence < 0 || *last_sequence_ < 0;
    return sixteen_bit ? ((step % 65536) + 65536) % 65536 : step;
}

void UmdCounter::follow_sequence(std::int64_t sequence, MonotonicTime read_at, SampleSink& sink) {
    last_step_ = 1;
    if (!last_sequence_) {
        last_sequence_ = sequence;
        device_count_ = static_cast<std::uint64_t>(sequence < 0 ? sequence + 65536 : sequence);
        clock_.restart();
        return;
    }
    const std::int64_t step = step_of(sequence);
    last_sequence_ = sequence;
    if (step == 1) {
        ++device_count_;
        return;
    }
    const double passed_s = seconds_of(read_at - last_read_at_) + buffered_seconds;
    const bool too_far =
        static_cast<double>(step) > passed_s * facts_.rate_Hz().value_or(rate_before_told_Hz);
    if (step <= 0 || too_far) {
        ++counters_.restarts;
        device_count_ = static_cast<std::uint64_t>(sequence < 0 ? sequence + 65536 : sequence);
        clock_.restart();
        lose_datum(sink, Fault::datum_lost, "the counter restarted");
        return;
    }
    device_count_ += static_cast<std::uint64_t>(step);
    last_step_ = step;
    ++counters_.gaps;
    counters_.lost_records += static_cast<std::uint64_t>(step - 1);
}

/// The order of these tests is the GUI's. A homodyne firmware prints 0 0 here and tells nothing.
UmdCounter::Reading UmdCounter::read_signal(const UmdRecord& record,
                                            const UmdAxisFields& axis) const {
    const double margin = slew_margin_Hz / scale_->rate_Hz;
    const auto reference = static_cast<double>(record.reference);
    const auto measurement = static_cast<double>(axis.measurement);
    if (record.reference == 0)
        return {Signal::lost, Quality::beam_lost, Fault::beam_lost, "the reference is lost"};
    if (axis.measurement == 0)
        return {Signal::lost, Quality::beam_lost, Fault::beam_lost, "the measuring beam is lost"};
    if (measurement > 2 * reference - margin)
        return {Signal::lost, Quality::signal_error, Fault::overspeed, "slew error +"};
    if (measurement < margin)
        return {Signal::lost, Quality::signal_error, Fault::overspeed, "slew error -"};
    return {};
}

UmdCounter::Reading UmdCounter::read(const UmdRecord& record) const {
    if (setup_.axis > record.axis_count)
        return {Signal::lost, Quality::absent, Fault::signal_error,
                "the instrument does not send this axis"};
    const UmdAxisFields& axis = record.axes[static_cast<std::size_t>(setup_.axis - 1)];
    if (scale_->head == UmdHead::heterodyne) {
        const Reading fault = read_signal(record, axis);
        if (fault.signal != Signal::good) return fault;
    }
    const auto counts = umd_position(axis.displacement, axis.phase, scale_->phase);
    if (counts) return {Signal::good, Quality::good, Fault::none, "", *counts};
    if (scale_->phase == UmdPhase::truncated)
        return {Signal::doubtful, Quality::signal_error, Fault::signal_error,
                "firmware 3.15 cannot tell the sign within one count of its zero: move away"};
    if ((axis.phase & no_reference_bits) != 0)
        return {Signal::lost, Quality::beam_lost, Fault::beam_lost, "the reference is lost"};
    if ((axis.phase & no_measurement_bits) != 0)
        return {Signal::lost, Quality::beam_lost, Fault::beam_lost, "the measuring beam is lost"};
    return {Signal::doubtful, Quality::signal_error, Fault::signal_error,
            "the phase could not be measured"};
}

void UmdCounter::judge_jump(double counts, SampleSink& sink) {
    if (last_counts_) {
        const double seconds = static_cast<double>(steps_since_counts_) / scale_->rate_Hz;
        const double metres =
            (std::abs(counts - *last_counts_) - jitter_counts) * scale_->metres_per_count;
        if (metres > setup_.fastest.in(metre_per_second)*seconds)
            lose_datum(sink, Fault::implausible_jump,
                       "the count jumped further than the axis can move");
    }
    last_counts_ = counts;
    steps_since_counts_ = 0;
}

void UmdCounter::hand_up(const Reading& reading, PlacedTime placed, SampleSink& sink) {
    ++counters_.samples;
    steps_since_counts_ += last_step_;
    if (reading.signal != Signal::good) {
        const bool news = reading.signal == Signal::lost ? !signal_lost_ : !doubted_;
        if (news) sink.note(reading.fault, reading.what);
        if (reading.signal == Signal::lost) signal_lost_ = true;
        doubted_ = true;
        sink.take(Sample::bad(umd_displacement, placed.at, reading.quality, device_count_, epoch_));
        return;
    }
    doubted_ = false;
    if (signal_lost_) lose_datum(sink, Fault::datum_lost, "the signal is back, counts were lost");
    signal_lost_ = false;
    judge_jump(reading.counts, sink);
    datum_in_use_ = true;
    const double metres = reading.counts * scale_->metres_per_count;
    Sample sample{umd_displacement, placed.at, metres, device_count_, epoch_};
    sample.time_uncertainty = placed.uncertainty;
    sink.take(sample);
}

} // namespace axiscal

#include "drivers/ballbar/u6_stream.hpp"

#include "analysis/quantity/counted.hpp"

#include <cmath>
#include <utility>

namespace axiscal {
namespace {

constexpr int counter_modulus = 256;
constexpr Duration tick = std::chrono::nanoseconds{250}; ///< of the 4 MHz clock

} // namespace

U6Stream::U6Stream(U6StreamSetup setup, U6Scale scale, Duration frame, InstrumentCounters& counters)
    : setup_{setup}
    , scale_{scale}
    , period_{setup.interval_ticks * tick}
    , counters_{counters}
    , clock_{frame} {}

void U6Stream::begin(const U6Range& range) {
    if (std::exchange(begun_, true)) {
        ++epoch_;
        ++counters_.restarts;
    }
    range_ = range;
    clock_.restart();
    number_ = 0;
    next_counter_ = 0;
    overflow_told_ = false;
}

void U6Stream::skip(std::uint64_t scans, SampleSink& sink, const char* why) {
    ++counters_.gaps;
    counters_.lost_records += scans;
    number_ += scans;
    sink.note(Fault::samples_lost, counted(static_cast<long>(scans), "sample of the stream is",
                                           "samples of the stream are") +
                                       " lost: " + why);
}

Result<void>
U6Stream::take(std::span<const std::byte> bytes, MonotonicTime read_at, SampleSink& sink) {
    const auto packet = decode_u6_packet(bytes, setup_.samples_per_packet);
    if (!packet) {
        ++(packet.error().fault == Fault::checksum ? counters_.checksum_errors
                                                   : counters_.bad_frames);
        return tl::unexpected<Error>(packet.error());
    }
    ++counters_.frames;
    // More than 255 packets lost in a row look like fewer; by then the U6's buffer has run over
    // and tells the rest.
    const int missing = (packet->counter - next_counter_ + counter_modulus) % counter_modulus;
    if (missing > 0)
        skip(static_cast<std::uint64_t>(missing) *
                 static_cast<std::uint64_t>(setup_.samples_per_packet),
             sink, "packets did not arrive");
    next_counter_ = (packet->counter + 1) % counter_modulus;
    if (packet->lost_scans > 0) skip(packet->lost_scans, sink, "the U6's buffer ran over");
    if (packet->overflowed && !std::exchange(overflow_told_, true))
        sink.note(Fault::samples_lost, "the U6's buffer ran over: this computer reads too slowly");
    if (!packet->overflowed) overflow_told_ = false;
    hand_up(*packet, read_at, sink);
    return {};
}

void U6Stream::hand_up(const U6Packet& packet, MonotonicTime read_at, SampleSink& sink) {
    auto behind = static_cast<std::int64_t>(packet.samples.size());
    for (const std::uint16_t count : packet.samples) {
        ++number_;
        --behind;
        const auto [at, uncertainty] = clock_.place(number_, read_at, period_, behind);
        const double volts = u6_volts(count, range_);
        ++counters_.samples;
        // The ends of the converter's scale stand for everything beyond them.
        const bool inside = count != 0 && count != 0xFFFF && std::abs(volts) <= scale_.usable_V;
        Sample sample = inside ? Sample{0, at, volts * scale_.metres_per_volt, number_, epoch_}
                               : Sample::bad(0, at, Quality::absent, number_, epoch_);
        sample.time_uncertainty = uncertainty;
        sink.take(sample);
    }
}

} // namespace axiscal

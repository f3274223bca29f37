#pragma once
// Samples out of a U6's stream packets: numbered without a hole, timed, in metres. Loop-bound.

#include "drivers/ballbar/u6_frame.hpp"
#include "drivers/clock/device_clock.hpp"
#include "drivers/instrument.hpp"

namespace axiscal {

/// How the voltage stands for a length.
struct U6Scale {
    double metres_per_volt = 0;
    double usable_V = 10; ///< beyond it the transducer is outside of its range
};

class U6Stream {
public:
    U6Stream(U6StreamSetup setup, U6Scale scale, Duration frame, InstrumentCounters& counters);

    /// A stream begins: numbers from 1 again, in a new epoch after the first.
    void begin(const U6Range& range);
    /// Hands up the samples of one packet that was read at `read_at`; what is missing before it is
    /// counted and told.
    /// @errors those of decode_u6_packet, counted.
    Result<void> take(std::span<const std::byte> bytes, MonotonicTime read_at, SampleSink& sink);

private:
    void skip(std::uint64_t scans, SampleSink& sink, const char* why);
    void hand_up(const U6Packet& packet, MonotonicTime read_at, SampleSink& sink);

    U6StreamSetup setup_;
    U6Scale scale_;
    Duration period_;
    InstrumentCounters& counters_;
    U6Range range_;
    DeviceClock clock_;
    std::uint64_t number_ = 0; ///< of the last sample, from 1
    int next_counter_ = 0;
    bool overflow_told_ = false, begun_ = false;
    std::uint32_t epoch_ = 0;
};

} // namespace axiscal

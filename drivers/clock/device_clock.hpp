#pragma once
// When was record n taken? The instrument's own number tells better than the arrival of its bytes.
// Pure but for its memory. Loop-bound.

#include "drivers/clock/lower_hull.hpp"
#include "drivers/clock/placed_time.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace axiscal {

/// Fits the instrument's clock to this computer's. A record never arrives before it was taken, so
/// delays have one side: the line below all arrivals, nearest to them in the mean, is the clock.
/// A host that stalls delays many records and moves that line by nothing.
///
/// A bus that is polled in frames (USB) hides when within a frame a record was taken. Where records
/// are as far apart as frames, the delay is a saw-tooth of the beat between both clocks; the line
/// holds once it has touched the floor of three teeth, two beats apart. Until then a record is
/// placed in the middle of its frame with u(t) = frame / sqrt(12) and a little more, and so it
/// stays where the beat is longer than the window.
///
/// Accuracy (simulated, loaded host): below 10 us rms and 20 us at most after 10 s for a serial
/// line and for streams of 10 kHz and more; below 15 us rms at 1 kHz over frames after two beats.
class DeviceClock {
public:
    /// @param frame how often the bus is polled: 1 ms for USB, 0 where bytes come unasked
    explicit DeviceClock(Duration frame);
    /// Numbers began anew, or the link did.
    void restart();
    /// Time of record `number`, whose bytes were read at `read_at` together with those of `behind`
    /// later ones; never after it. A new `period` restarts.
    PlacedTime
    place(std::uint64_t number, MonotonicTime read_at, Duration period, std::int64_t behind = 0);

private:
    struct Read {
        Duration newest; ///< its last record, since the first of all
        MonotonicTime read_at;
        bool operator==(const Read&) const = default;
    };
    void observe(ClockPoint newest);
    void close_bucket();
    void refit();
    void begin_flat();
    void state_uncertainty();
    [[nodiscard]] double window_s() const;
    [[nodiscard]] double grain_s() const;
    [[nodiscard]] double delay_s(double device_s) const;

    Duration frame_, period_{};
    std::uint64_t first_number_ = 0;
    MonotonicTime first_read_{};
    bool begun_ = false;
    std::deque<ClockPoint> lowest_;  ///< of each bucket of the window
    std::optional<ClockPoint> open_; ///< of the bucket that is filling
    std::optional<Read> seen_;       ///< the last one
    ClockLine line_;
    double fit_uncertainty_s_ = 0;
    double early_s_ = 0;     ///< a record lies this much before the line
    Duration uncertainty_{}; ///< u(t); both change with the line only
    bool pinned_ = false;    ///< the line is known to touch the floor of the delays
};

} // namespace axiscal

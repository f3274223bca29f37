#pragma once
// When was record n taken? The instrument's own number tells better than the arrival of its bytes.
// Pure but for its memory. Loop-bound.

#include "analysis/quantity/time.hpp"

#include <cstdint>
#include <optional>

namespace axiscal {

/// A record cannot arrive before it was taken, so of all origins (arrival - number x period) the
/// earliest of the last 5 to 10 s is the one least delayed, and every record is placed from it.
/// A host that stalls, or bytes that wait in a USB buffer, for less than that move no stamp;
/// crystals that disagree by 100 ppm leave 1 ms at most.
class CountClock {
public:
    /// Numbers began anew, or the link did.
    void restart();
    /// Time of record `number`, whose bytes were read at `read_at` together with those of `behind`
    /// later ones; never after it. A new `period` restarts.
    MonotonicTime
    place(std::uint64_t number, MonotonicTime read_at, Duration period, std::int64_t behind = 0);

private:
    Duration period_{};
    std::optional<MonotonicTime> earliest_, earlier_; ///< origins of this span and the one before
    MonotonicTime span_began_{};
};

} // namespace axiscal

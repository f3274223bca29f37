#pragma once
// Which sample is missing in a stream of PDOs that have no number? Their times tell. Pure but for
// its memory.

#include "drivers/canopen/canopen_session.hpp"

#include <optional>
#include <vector>

namespace axiscal {

/// A frame that comes late was either held up on the bus, and those after it catch up, or those
/// before it are missing, and nothing after it catches up. So from a late frame on the stream is
/// held back until one has caught up (nothing is missing) or 32 have not (then as many are missing
/// as the least delay has periods). What the kernel dropped is counted by the kernel.
///
/// Bounds: hold-ups below 32 periods are never taken for a loss; a device whose period is wrong by
/// more than 1 % is. Each time is that of the device's own steady clock, followed by 1/64 a frame
/// and never later than the arrival.
class PdoStream {
public:
    struct Numbered {
        PdoArrival arrival;
        std::uint64_t number = 0; ///< from 1, with a hole where samples are missing
        MonotonicTime at;
    };
    explicit PdoStream(Duration period);

    void restart();
    /// What is settled by this frame, oldest first; perhaps nothing.
    std::vector<Numbered> take(const PdoArrival& arrival);
    /// What was held back, when the stream ends.
    std::vector<Numbered> finish();
    [[nodiscard]] std::uint64_t lost() const { return lost_; }

private:
    void lose(std::uint64_t samples);
    std::vector<Numbered> settle();
    Numbered number(const PdoArrival& arrival);

    Duration period_;
    std::optional<MonotonicTime> due_; ///< of the frame after the last numbered one
    std::uint64_t number_ = 0, lost_ = 0, dropped_ = 0;
    std::vector<PdoArrival> held_;
    Duration least_delay_{};
};

} // namespace axiscal

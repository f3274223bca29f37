#include "drivers/laser/count_clock.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration span = std::chrono::seconds{5};

} // namespace

void CountClock::restart() {
    earliest_.reset();
    earlier_.reset();
}

MonotonicTime CountClock::place(std::uint64_t number,
                                MonotonicTime read_at,
                                Duration period,
                                std::int64_t behind) {
    if (std::exchange(period_, period) != period) restart();
    const Duration since_zero = period * static_cast<std::int64_t>(number);
    const MonotonicTime origin = read_at - since_zero - period * behind;
    if (!earliest_ || read_at - span_began_ > span) {
        earlier_ = std::exchange(earliest_, origin);
        span_began_ = read_at;
    }
    earliest_ = std::min(*earliest_, origin);
    return (earlier_ ? std::min(*earlier_, *earliest_) : *earliest_) + since_zero;
}

} // namespace axiscal

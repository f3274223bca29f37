#pragma once
#include "drivers/loop/scheduler.hpp"

#include <boost/asio/io_context.hpp>

namespace axiscal {

/// Real time: CLOCK_BOOTTIME, which goes on while the computer is suspended. Timers are
/// CLOCK_MONOTONIC's: a sleeper sleeps that much longer, and nothing comes due at once on waking.
/// Loop-bound.
class AsioScheduler final : public Scheduler {
public:
    explicit AsioScheduler(boost::asio::io_context& loop)
        : loop_{loop} {}
    [[nodiscard]] MonotonicTime now() const override;
    [[nodiscard]] Duration asleep() const override;
    [[nodiscard]] ClockTie clock_tie() const override;
    Task<void> sleep_until(MonotonicTime when) override;
    [[nodiscard]] boost::asio::any_io_executor executor() override { return loop_.get_executor(); }

private:
    boost::asio::io_context& loop_;
};

/// CLOCK_BOOTTIME now, for threads that have no scheduler (they only stamp).
MonotonicTime monotonic_now();

} // namespace axiscal

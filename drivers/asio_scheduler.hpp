#pragma once
#include "drivers/scheduler.hpp"

#include <boost/asio/io_context.hpp>

namespace axiscal {

/// Real time: CLOCK_MONOTONIC through one io_context. Loop-bound.
class AsioScheduler final : public Scheduler {
public:
    explicit AsioScheduler(boost::asio::io_context& loop)
        : loop_{loop} {}
    [[nodiscard]] MonotonicTime now() const override;
    [[nodiscard]] ClockTie clock_tie() const override;
    Task<void> sleep_until(MonotonicTime when) override;
    [[nodiscard]] boost::asio::any_io_executor executor() override { return loop_.get_executor(); }

private:
    boost::asio::io_context& loop_;
};

/// CLOCK_MONOTONIC now, for threads that have no scheduler (they only stamp).
MonotonicTime monotonic_now();

} // namespace axiscal

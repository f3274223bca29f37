#pragma once
// One waits without a look at the clock, others ring. Loop-bound.

#include "drivers/loop/scheduler.hpp"

#include <boost/asio/steady_timer.hpp>

#include <optional>
#include <utility>

namespace axiscal {

class Doorbell {
public:
    explicit Doorbell(const boost::asio::any_io_executor& loop)
        : sleep_{loop, boost::asio::steady_timer::time_point::max()} {}
    Doorbell(const Doorbell&) = delete;
    Doorbell& operator=(const Doorbell&) = delete;
    ~Doorbell() = default;

    /// Ends the wait, or the next one where nobody waits.
    void ring() {
        if (std::exchange(rung_, true)) return;
        sleep_.cancel();
    }
    /// For one coroutine at a time: until a ring, at `latest` where that is given, or early with
    /// the coroutine's cancellation.
    Task<void> wait(Scheduler& scheduler, std::optional<MonotonicTime> latest);

private:
    Task<bool> rung();

    boost::asio::steady_timer sleep_;
    bool rung_ = false;
};

} // namespace axiscal

#include "drivers/loop/asio_scheduler.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <algorithm>
#include <ctime>

namespace axiscal {
namespace {

std::int64_t clock_ns(clockid_t clock) {
    timespec stamp{};
    ::clock_gettime(clock, &stamp);
    return std::int64_t{stamp.tv_sec} * 1'000'000'000 + stamp.tv_nsec;
}

} // namespace

MonotonicTime monotonic_now() {
    return monotonic_from_ns(clock_ns(CLOCK_BOOTTIME));
}

/// Boot time first: what the thread waits between the two readings makes it too small, never more.
Duration AsioScheduler::asleep() const {
    const std::int64_t with_sleep = clock_ns(CLOCK_BOOTTIME);
    return std::max(Duration{}, Duration{with_sleep - clock_ns(CLOCK_MONOTONIC)});
}

MonotonicTime AsioScheduler::now() const {
    return monotonic_now();
}

ClockTie AsioScheduler::clock_tie() const {
    ClockTie tie;
    tie.before = monotonic_now();
    tie.utc_ns = clock_ns(CLOCK_REALTIME);
    tie.after = monotonic_now();
    return tie;
}

Task<void> AsioScheduler::sleep_until(MonotonicTime when) {
    boost::asio::steady_timer timer{loop_};
    timer.expires_after(
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(when - now()));
    co_await timer.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
}

} // namespace axiscal

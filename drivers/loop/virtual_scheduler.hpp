#pragma once
// Virtual time: what lasts for minutes on a tape, or a week in a test, passes in moments. The loop
// is polled until nothing is ready, then time jumps to the next sleeper. No wall clock is involved.
// Loop-bound.

#include "drivers/loop/scheduler.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

namespace axiscal {

class VirtualScheduler final : public Scheduler {
public:
    [[nodiscard]] MonotonicTime now() const override { return now_; }
    [[nodiscard]] Duration asleep() const override { return asleep_; }
    [[nodiscard]] ClockTie clock_tie() const override {
        return ClockTie{now_, utc_at_zero_ns + nanoseconds_of(now_), now_};
    }
    [[nodiscard]] boost::asio::any_io_executor executor() override { return loop_.get_executor(); }

    /// The timer never expires by itself: it is cancelled when virtual time reaches `when`, or by
    /// the coroutine's own cancellation.
    Task<void> sleep_until(MonotonicTime when) override {
        if (when <= now_) co_return;
        boost::asio::steady_timer timer{loop_, boost::asio::steady_timer::time_point::max()};
        const auto place = sleepers_.emplace(when, &timer);
        co_await timer.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
        sleepers_.erase(place);
    }

    /// Runs until nothing is left to do before `end`; afterwards now() == end.
    void run_until(MonotonicTime end) {
        while (step(end)) {
        }
        now_ = std::max(now_, end);
    }
    void run_for(Duration span) { run_until(now_ + span); }
    /// The computer is suspended so long: nothing runs, and every clock goes on.
    void suspend(Duration span) {
        now_ += span;
        asleep_ += span;
    }
    boost::asio::io_context& loop() { return loop_; }
    /// How many sleepers time has woken.
    [[nodiscard]] std::uint64_t wakeups() const { return wakeups_; }

    std::int64_t utc_at_zero_ns = 1'795'255'200'000'000'000; // 2026-11-21T10:00:00Z

private:
    bool step(MonotonicTime end) {
        loop_.restart();
        if (loop_.poll() > 0) return true;
        const auto next = sleepers_.begin();
        if (next == sleepers_.end() || next->first > end) return false;
        now_ = std::max(now_, next->first);
        for (auto due = sleepers_.begin(); due != sleepers_.end() && due->first <= now_; ++due) {
            due->second->cancel();
            ++wakeups_;
        }
        return true;
    }

    boost::asio::io_context loop_{1};
    MonotonicTime now_ = monotonic_from_ns(1'000'000'000);
    Duration asleep_{};
    std::multimap<MonotonicTime, boost::asio::steady_timer*> sleepers_;
    std::uint64_t wakeups_ = 0;
};

} // namespace axiscal

#pragma once
// Time is injected: drivers and stations ask a Scheduler for now and for sleep. Loop-bound.

#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <utility>

namespace axiscal {

template <class T> using Task = boost::asio::awaitable<T>;

class Scheduler {
public:
    virtual ~Scheduler() = default;
    [[nodiscard]] virtual MonotonicTime now() const = 0;
    /// For how long the computer has been suspended since its boot; now() went on meanwhile.
    [[nodiscard]] virtual Duration asleep() const { return {}; }
    /// Mono-real-mono, read at once.
    [[nodiscard]] virtual ClockTie clock_tie() const = 0;
    /// Returns at `when`, or early with the coroutine's cancellation.
    virtual Task<void> sleep_until(MonotonicTime when) = 0;
    [[nodiscard]] virtual boost::asio::any_io_executor executor() = 0;

    Task<void> sleep_for(Duration span) { return sleep_until(now() + span); }
};

} // namespace axiscal

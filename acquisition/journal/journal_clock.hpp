#pragma once
// What the journal's own thread tells time by and sleeps on; a test turns it by hand.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>

namespace axiscal {

/// now() is thread-safe; sleep() belongs to the journal's thread.
class JournalClock {
public:
    using Time = std::chrono::steady_clock::time_point;
    /// Who sleeps: `wake` is notified when what `lock` guards has changed.
    struct Sleeper {
        std::unique_lock<std::mutex>& lock;
        std::condition_variable_any& wake;
        const std::stop_token& stop;
    };
    virtual ~JournalClock() = default;
    [[nodiscard]] virtual Time now() const = 0;
    /// Returns when `ready` (asked under the lock), at `until` if there is one, or to stop.
    virtual void sleep(const Sleeper& sleeper,
                       std::optional<Time> until,
                       const std::function<bool()>& ready) = 0;

    /// CLOCK_MONOTONIC.
    static JournalClock& steady();
};

} // namespace axiscal

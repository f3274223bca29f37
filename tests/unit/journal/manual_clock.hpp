#pragma once
#include "acquisition/journal/journal_clock.hpp"

namespace axiscal::testing {

/// A journal's clock that goes only when it is told to. Must outlive the journal.
class ManualClock final : public JournalClock {
public:
    using Duration = std::chrono::steady_clock::duration;

    [[nodiscard]] Time now() const override {
        const std::scoped_lock lock{mutex_};
        return now_;
    }

    void sleep(const Sleeper& sleeper,
               std::optional<Time> until,
               const std::function<bool()>& ready) override {
        fall_asleep(sleeper, until);
        sleeper.wake.wait(sleeper.lock, sleeper.stop,
                          [&] { return ready() || (until && now() >= *until); });
        const std::scoped_lock lock{mutex_};
        asleep_ = false;
    }

    /// Only while the journal lives. Under the sleeper's lock, so that it cannot miss the wake.
    void advance(Duration span) {
        std::unique_lock lock{mutex_};
        now_ += span;
        std::mutex* const journal_mutex = journal_mutex_;
        std::condition_variable_any* const wake = wake_;
        lock.unlock();
        if (wake == nullptr) return; // nobody sleeps yet
        const std::scoped_lock missed_by_nobody{*journal_mutex};
        wake->notify_all();
    }

    /// Whether the journal's thread comes to rest, to wake that long after the start.
    bool rests_until(Duration after_start) { return rests(start_ + after_start); }
    /// Whether it comes to rest with nothing to wake it but work.
    bool rests() { return rests(Time::max()); }

private:
    // The deadline only bounds a failing test.
    bool rests(Time until) {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, std::chrono::seconds{20},
                                 [&] { return asleep_ && until_ == until; });
    }

    void fall_asleep(const Sleeper& sleeper, std::optional<Time> until) {
        const std::scoped_lock lock{mutex_};
        journal_mutex_ = sleeper.lock.mutex();
        wake_ = &sleeper.wake;
        until_ = until.value_or(Time::max());
        asleep_ = true;
        changed_.notify_all();
    }

    const Time start_ = Time{std::chrono::hours{1}};
    mutable std::mutex mutex_; // guards all below
    std::condition_variable changed_;
    Time now_ = start_;
    Time until_ = Time::max();
    bool asleep_ = false;
    std::mutex* journal_mutex_ = nullptr;
    std::condition_variable_any* wake_ = nullptr;
};

} // namespace axiscal::testing

// What only time decides, and when nothing does: an idle station sleeps until somebody rings.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "drivers/loop/spawn.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Duration heartbeat = std::chrono::milliseconds{100};
constexpr Duration judge_every = std::chrono::seconds{1};
constexpr Duration judge_outbox_every = std::chrono::seconds{10};
/// Of an outbox that was empty: a person may have put something there.
constexpr Duration look_into_empty_outbox_every = std::chrono::minutes{1};

} // namespace

Task<void> Station::tick() {
    while (!stopping_) {
        co_await pause_before_looking();
        look_at_the_time();
    }
}

Task<void> Station::pause_before_looking() {
    if (time_counts()) {
        co_await scheduler_.sleep_for(heartbeat);
        co_return;
    }
    asleep_ = true;
    co_await bell_.wait(scheduler_, outbox_due());
    asleep_ = false;
}

bool Station::time_counts() const {
    const bool unwritten = run_ && !run_->closing_row_durable;
    return run_open() || unwritten || drift_open() || aligning_ || supervisor_.somebody_speaks() ||
           scheduler_.now() < time_counts_until_;
}

std::optional<MonotonicTime> Station::outbox_due() const {
    if (config_.publish.destination.empty()) return std::nullopt;
    const bool empty = outbox_waiting_ == 0 && outbox_alarm_.empty();
    return judged_outbox_ + (empty ? look_into_empty_outbox_every : judge_outbox_every);
}

/// While a person may still want the run: until its file is shut.
void Station::keep_awake() {
    sleep_lock_.want(run_open() || (run_ && !run_->closing_row_durable) || drift_open());
}

/// The lock may be refused, and root may suspend in spite of it.
void Station::notice_sleep() {
    constexpr Duration noticeable = std::chrono::milliseconds{500};
    const Duration slept = scheduler_.asleep() - slept_;
    if (slept < noticeable) return;
    slept_ += slept;
    std::string message =
        "The computer was suspended for " + in_seconds(slept) + "; nothing was recorded meanwhile.";
    if (recording() || drift_open())
        perform(RecordEvent{{EventKind::note, scheduler_.now(), 0, message, Fault::none, 0}});
    note(std::move(message));
}

void Station::look_at_the_time() {
    const MonotonicTime now = scheduler_.now();
    notice_sleep();
    keep_awake();
    if (now - judged_ >= judge_every) {
        supervisor_.judge();
        judge_environment();
        judge_instruments();
        judged_ = now;
    }
    if (now - judged_outbox_ >= judge_outbox_every) {
        judge_outbox();
        judged_outbox_ = now;
    }
    feed_with_air(Tick{now});
    publish_to_port();
    if (run_ && !run_->closing_row_durable && journal_.failure() &&
        !std::exchange(waiting_for_disk_, true))
        spawn(scheduler_, wait_for_disk());
}

/// Told once when it begins and once when it is over, however the count goes meanwhile.
void Station::judge_outbox() {
    const OutboxView outbox = outbox_watch_.look(scheduler_.clock_tie());
    outbox_waiting_ = outbox.waiting;
    if (outbox.alarm.empty() == outbox_alarm_.empty()) return;
    outbox_alarm_ = outbox.alarm;
    note(outbox_alarm_.empty() ? "The share takes results again."
                               : "Alarm: " + outbox_alarm_ + ".");
}

} // namespace axiscal

// What only time decides, and when nothing does: an idle station sleeps until somebody rings.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Duration heartbeat = std::chrono::milliseconds{100};
constexpr Duration judge_every = std::chrono::seconds{1};

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
    co_await bell_.wait(scheduler_, outbox_watch_.due());
    asleep_ = false;
}

bool Station::time_counts() const {
    return run_open() || is_unwritten() || drift_open() || beam_.running() ||
           supervisor_.somebody_speaks() || scheduler_.now() < time_counts_until_;
}

/// While a person may still want the run: until its file is shut.
void Station::keep_awake() {
    sleep_lock_.want(run_open() || is_unwritten() || drift_open());
}

/// The lock may be refused, and root may suspend in spite of it.
void Station::notice_sleep() {
    const Duration slept = sleep_lock_.slept_in_spite_of_it();
    if (slept <= Duration{}) return;
    std::string message =
        "The computer was suspended for " + in_seconds(slept) + "; nothing was recorded meanwhile.";
    if (takes_records() || drift_open()) record(EventKind::note, message);
    note(std::move(message));
}

/// Outside them nothing is captured, and the run goes on when it is back.
void Station::judge_environment() {
    if (!config_.environment.stated()) return;
    const MonotonicTime now = scheduler_.now();
    if (const auto news = readings_.judge_limits(channels().environment(now), now))
        record_instrument(news->sentence, {news->fault});
}

void Station::look_at_the_time() {
    const MonotonicTime now = scheduler_.now();
    notice_sleep();
    keep_awake();
    if (now - judged_ >= judge_every) {
        supervisor_.judge();
        judge_environment();
        if (const auto& run = last_run()) run->judge_instruments();
        judged_ = now;
    }
    if (const auto news = outbox_watch_.judge(scheduler_.clock_tie())) note(*news);
    if (const auto& run = last_run()) run->on_time(now);
    publish_to_port();
    if (is_unwritten() && journal_.failure()) disk_.begin();
}

} // namespace axiscal

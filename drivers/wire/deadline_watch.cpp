#include "drivers/wire/deadline_watch.hpp"

#include "drivers/loop/spawn.hpp"

#include <boost/asio/bind_cancellation_slot.hpp>
#include <boost/asio/cancellation_signal.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <optional>
#include <utility>

namespace axiscal {

/// Shared with the sleeper, which may end after the watch.
struct DeadlineWatch::State {
    std::function<void()> give_up;
    std::optional<MonotonicTime> deadline; ///< of the operation under way
    MonotonicTime wakes_at;                ///< while `asleep`
    bool begun = false, asleep = false, given_up = false, over = false;
    boost::asio::cancellation_signal wake; ///< may be given while `asleep` only
};

namespace {

/// True as long as it lives, also where the loop ends and takes the sleeping coroutine with it.
class Holding {
public:
    explicit Holding(bool& flag)
        : flag_{flag} {
        flag_ = true;
    }
    ~Holding() { flag_ = false; }
    Holding(const Holding&) = delete;
    Holding& operator=(const Holding&) = delete;

private:
    bool& flag_;
};

} // namespace

DeadlineWatch::DeadlineWatch(Scheduler& scheduler, std::function<void()> give_up)
    : scheduler_{scheduler}
    , state_{std::make_shared<State>()} {
    state_->give_up = std::move(give_up);
}

DeadlineWatch::~DeadlineWatch() {
    dismiss(*state_);
}

void DeadlineWatch::begin(MonotonicTime deadline) {
    if (state_->asleep && deadline < state_->wakes_at) {
        // A sleeper that was cancelled cannot sleep again: another one takes over.
        auto fresh = std::make_shared<State>();
        fresh->give_up = std::move(state_->give_up);
        dismiss(*std::exchange(state_, std::move(fresh)));
    }
    state_->deadline = deadline;
    state_->given_up = false;
    if (std::exchange(state_->begun, true)) return;
    boost::asio::co_spawn(
        scheduler_.executor(), keep(state_, scheduler_),
        boost::asio::bind_cancellation_slot(state_->wake.slot(), RethrowOnLoop{}));
}

bool DeadlineWatch::end() {
    state_->deadline.reset();
    return state_->given_up;
}

void DeadlineWatch::dismiss(State& state) {
    state.over = true;
    if (state.asleep) state.wake.emit(boost::asio::cancellation_type::terminal);
}

Task<void> DeadlineWatch::keep(std::shared_ptr<State> state, Scheduler& scheduler) {
    // Not from within begin(): the operation is not under way yet.
    co_await boost::asio::post(scheduler.executor(), boost::asio::use_awaitable);
    while (!state->over && state->deadline) {
        if (scheduler.now() >= *state->deadline) {
            state->given_up = true;
            state->give_up();
            break;
        }
        state->wakes_at = *state->deadline;
        const Holding asleep{state->asleep};
        co_await scheduler.sleep_until(state->wakes_at);
    }
    state->begun = false;
}

} // namespace axiscal

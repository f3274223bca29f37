#include "drivers/wire/turns.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <deque>

namespace axiscal {

struct Turns::State {
    void pass_on();

    boost::asio::any_io_executor loop;
    bool taken = false;
    std::deque<Waiter*> waiting;
};

/// Lives in the frame of who waits, and leaves the queue with it.
struct Turns::Waiter {
    explicit Waiter(std::shared_ptr<State> of)
        : state{std::move(of)}
        , woken{state->loop, boost::asio::steady_timer::time_point::max()} {
        state->waiting.push_back(this);
    }
    ~Waiter() {
        if (has_turn)
            state->pass_on();
        else
            std::erase(state->waiting, this);
    }
    Waiter(const Waiter&) = delete;
    Waiter& operator=(const Waiter&) = delete;

    std::shared_ptr<State> state;
    boost::asio::steady_timer woken;
    bool has_turn = false;
};

void Turns::State::pass_on() {
    taken = !waiting.empty();
    if (!taken) return;
    Waiter* const next = waiting.front();
    waiting.pop_front();
    next->has_turn = true;
    next->woken.cancel();
}

Turns::Turns(boost::asio::any_io_executor loop)
    : state_{std::make_shared<State>()} {
    state_->loop = std::move(loop);
}

Turns::Turn::Turn(std::shared_ptr<State> state)
    : state_{std::move(state)} {}

Turns::Turn::~Turn() {
    if (state_) state_->pass_on();
}

Task<Turns::Turn> Turns::take() {
    const std::shared_ptr<State> state = state_;
    if (!std::exchange(state->taken, true)) co_return Turn{state};
    Waiter me{state};
    // Woken without the turn it was cancelled: the next wait throws that.
    while (!me.has_turn)
        co_await me.woken.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    me.has_turn = false;
    co_return Turn{state};
}

} // namespace axiscal

#pragma once
// One at a time, in the order of asking. Loop-bound.

#include "drivers/loop/scheduler.hpp"

#include <memory>

namespace axiscal {

class Turns {
    struct State;
    struct Waiter;

public:
    explicit Turns(boost::asio::any_io_executor loop);

    /// Ends with this object. It may outlive the Turns.
    class Turn {
    public:
        explicit Turn(std::shared_ptr<State> state);
        ~Turn();
        Turn(Turn&&) noexcept = default;
        Turn& operator=(Turn&&) = delete;
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        std::shared_ptr<State> state_;
    };
    /// Whoever is cancelled while it waits is passed over.
    Task<Turn> take();

private:
    std::shared_ptr<State> state_;
};

} // namespace axiscal

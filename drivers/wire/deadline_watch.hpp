#pragma once
// A deadline for one operation after another, where before() would start two coroutines and a timer
// for each: at a thousand reads a second that is most of a read. Loop-bound.

#include "drivers/loop/scheduler.hpp"

#include <functional>
#include <memory>

namespace axiscal {

/// While deadlines only move on, it wakes once a deadline, not once an operation.
class DeadlineWatch {
public:
    /// @param give_up  ends the operation that is under way; called from the loop
    DeadlineWatch(Scheduler& scheduler, std::function<void()> give_up);
    ~DeadlineWatch();
    DeadlineWatch(const DeadlineWatch&) = delete;
    DeadlineWatch& operator=(const DeadlineWatch&) = delete;

    void begin(MonotonicTime deadline);
    /// @returns whether the operation was given up.
    bool end();

private:
    struct State;
    static Task<void> keep(std::shared_ptr<State> state, Scheduler& scheduler);
    static void dismiss(State& state);

    Scheduler& scheduler_;
    std::shared_ptr<State> state_;
};

} // namespace axiscal

#pragma once
// Starts a task on the loop. An exception in it is a bug and leaves through the loop to main.

#include "drivers/loop/scheduler.hpp"

#include <boost/asio/co_spawn.hpp>

#include <exception>

namespace axiscal {

struct RethrowOnLoop {
    void operator()(std::exception_ptr bug) const {
        if (bug) std::rethrow_exception(std::move(bug));
    }
};

inline void spawn(Scheduler& scheduler, Task<void> task) {
    boost::asio::co_spawn(scheduler.executor(), std::move(task), RethrowOnLoop{});
}

}  // namespace axiscal

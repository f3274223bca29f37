#pragma once
// A loop, its scheduler and the threads of an opener, which end before the loop does.

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/work_thread.hpp"
#include "tests/support/loop_until.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

namespace axiscal::testing {

template <class T> Task<void> keep_result(Task<T> task, std::optional<T>& result) {
    result = co_await std::move(task);
}

struct LinkBench {
    template <class T> void begin(Task<T> task, std::optional<T>& result) {
        boost::asio::co_spawn(loop, keep_result(std::move(task), result), boost::asio::detached);
    }
    template <class T> T wait(Task<T> task) {
        std::optional<T> result;
        begin(std::move(task), result);
        EXPECT_TRUE(loop_until(loop, [&] { return result.has_value(); }));
        return *std::move(result);
    }
    [[nodiscard]] MonotonicTime soon() const { return scheduler.now() + std::chrono::seconds{10}; }
    /// Joins them: what they touched may be read.
    void end_threads() { threads.reset(); }

    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    std::unique_ptr<WorkThreads> threads = std::make_unique<WorkThreads>();
};

} // namespace axiscal::testing

// Opening and closing beside the loop: what hangs in the kernel holds nobody up.
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/serial_opener.hpp"
#include "tests/support/loop_until.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <array>
#include <fcntl.h>
#include <future>
#include <optional>
#include <poll.h>
#include <unistd.h>

namespace axiscal::serial_opener_test {
namespace {

/// The write end stands for a terminal; the read end sees when it is closed.
struct Pipe {
    Pipe() { EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0); }
    ~Pipe() { ::close(ends[0]); }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    [[nodiscard]] bool closed(int patience_ms = 0) const {
        pollfd end{ends[0], POLLIN, 0};
        return ::poll(&end, 1, patience_ms) == 1 && (end.revents & POLLHUP) != 0;
    }
    [[nodiscard]] int terminal() const { return ends[1]; }
    std::array<int, 2> ends{-1, -1};
};

struct Bench {
    void ask(TtyOpener opener, Duration patience = std::chrono::seconds{10}) {
        boost::asio::co_spawn(loop, keep(std::move(opener), scheduler.now() + patience),
                              boost::asio::detached);
    }
    Task<void> keep(TtyOpener opener, MonotonicTime deadline) {
        answer = co_await serial_opener->open(scheduler, std::move(opener), deadline);
    }
    bool answered() {
        return testing::loop_until(loop, [&] { return answer.has_value(); });
    }
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    std::shared_ptr<SerialOpener> serial_opener =
        std::make_shared<SerialOpener>("ttyX", loop.get_executor());
    std::optional<Result<int>> answer;
};

TEST(SerialOpener, HandsOverWhatWasOpened) {
    Bench bench;
    const Pipe pipe;
    bench.ask([&] { return pipe.terminal(); });
    ASSERT_TRUE(bench.answered());
    EXPECT_EQ(bench.answer->value(), pipe.terminal());
    EXPECT_FALSE(pipe.closed());
    bench.serial_opener->close(pipe.terminal());
    EXPECT_TRUE(pipe.closed(10'000));
}

TEST(SerialOpener, AnOpeningThatHangsEndsAtItsDeadlineAndIsClosedWhenItCameThrough) {
    Bench bench;
    const Pipe pipe;
    std::promise<void> kernel_is_done;
    auto done = kernel_is_done.get_future().share();
    bench.ask(
        [&, done]() -> Result<int> {
            done.wait();
            return pipe.terminal();
        },
        std::chrono::milliseconds{20});
    ASSERT_TRUE(bench.answered());
    ASSERT_FALSE(*bench.answer);
    EXPECT_EQ(bench.answer->error().fault, Fault::link_timeout);
    EXPECT_NE(bench.answer->error().detail.find("ttyX"), std::string::npos);
    kernel_is_done.set_value();
    EXPECT_TRUE(testing::loop_until(bench.loop, [&] { return pipe.closed(); }));
}

TEST(SerialOpener, ClosesWhatIsDeadBeforeItOpensTheSameLineAgain) {
    Bench bench;
    const Pipe dead, fresh;
    bench.serial_opener->close(dead.terminal());
    bench.ask([&]() -> Result<int> {
        if (!dead.closed()) return fail(Fault::busy, "the dead one still holds its node");
        return fresh.terminal();
    });
    ASSERT_TRUE(bench.answered());
    EXPECT_TRUE(*bench.answer) << describe(bench.answer->error());
    bench.serial_opener->close(fresh.terminal());
}

TEST(SerialOpener, WhatComesThroughAfterTheLoopIsClosed) {
    const Pipe pipe;
    std::promise<void> kernel_is_done;
    {
        Bench bench;
        auto done = kernel_is_done.get_future().share();
        bench.ask([&pipe, done]() -> Result<int> {
            done.wait();
            return pipe.terminal();
        });
        bench.loop.poll();
        bench.serial_opener->forget_loop();
    }
    EXPECT_FALSE(pipe.closed());
    kernel_is_done.set_value();
    EXPECT_TRUE(pipe.closed(10'000));
}

} // namespace
} // namespace axiscal::serial_opener_test

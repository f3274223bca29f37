// What can block does so on a thread of its own: the loop goes on, and no thread is left behind.
#include "drivers/asio_scheduler.hpp"
#include "drivers/link/work_thread.hpp"
#include "tests/support/loop_until.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <future>

namespace axiscal::work_thread_test {
namespace {

struct Asked {
    std::optional<Result<int>> reply;
};

Task<void> ask(std::shared_ptr<WorkThread> thread,
               Scheduler& scheduler,
               std::function<Result<int>()> job,
               Duration patience,
               Asked& asked) {
    asked.reply = co_await on_thread<int>(std::move(thread), scheduler, std::move(job),
                                          scheduler.now() + patience);
}

class WorkThreadTest : public ::testing::Test {
protected:
    void start(std::function<Result<int>()> job, Asked& asked, Duration patience) {
        boost::asio::co_spawn(loop, ask(thread, scheduler, std::move(job), patience, asked),
                              boost::asio::detached);
    }
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    WorkThreads threads;
    std::shared_ptr<WorkThread> thread = threads.start("device").value();
};

TEST_F(WorkThreadTest, GivesResultsInOrderOnTheLoop) {
    Asked first, second;
    start([] { return Result<int>{1}; }, first, std::chrono::seconds{10});
    start([] { return Result<int>{fail(Fault::refused, "no")}; }, second, std::chrono::seconds{10});
    ASSERT_TRUE(testing::loop_until(loop, [&] { return first.reply && second.reply; }));
    EXPECT_EQ(first.reply->value(), 1);
    EXPECT_EQ(second.reply->error().fault, Fault::refused);
}

TEST_F(WorkThreadTest, TellsTheLoopWhenAJobHangsAndNoSecondThreadHangsBehindIt) {
    std::promise<void> release;
    std::shared_future<void> released{release.get_future()};
    Asked asked;
    start([released] { return released.wait(), Result<int>{1}; }, asked,
          std::chrono::milliseconds{1});
    ASSERT_TRUE(testing::loop_until(loop, [&] { return asked.reply.has_value(); }));
    EXPECT_EQ(asked.reply->error().fault, Fault::link_timeout);
    EXPECT_EQ(threads.start("device").error().fault, Fault::busy);
    thread->finish();
    EXPECT_EQ(threads.start("device").error().fault, Fault::link_timeout);
    EXPECT_TRUE(threads.start("another device"));
    release.set_value();
    ASSERT_TRUE(testing::loop_until(loop, [&] { return thread->ended(); }));
    EXPECT_TRUE(threads.start("device"));
}

TEST_F(WorkThreadTest, RunsTheLastJobAndDropsTheOthers) {
    std::promise<void> release;
    std::shared_future<void> released{release.get_future()};
    std::atomic<int> dropped{0}, last{0};
    thread->post([released] { released.wait(); });
    thread->post([&] { ++dropped; });
    thread->finish([&] { ++last; });
    thread->post([&] { ++dropped; });
    release.set_value();
    thread->join();
    EXPECT_EQ(dropped, 0);
    EXPECT_EQ(last, 1);
}

} // namespace
} // namespace axiscal::work_thread_test

// What can block does so on a thread of its own: the loop goes on, and no thread is left behind.
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/work_thread.hpp"
#include "tests/support/loop_until.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <iterator>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

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

TEST(WorkThreadThatIsLeftBehind, DoesAllItsJobsInOrderAfterItsOwnerIsGone) {
    std::promise<void> release, done;
    std::vector<int> order; // of the thread alone until `done`
    auto thread = std::make_unique<WorkThread>(WorkThread::End::left_behind);
    thread->post([&, released = release.get_future().share()] {
        released.wait();
        order.push_back(1);
    });
    thread->post([&] { order.push_back(2); });
    thread->post([&] { done.set_value(); });
    thread.reset(); // the first job still hangs
    release.set_value();
    done.get_future().wait();
    EXPECT_EQ(order, (std::vector<int>{1, 2}));
}

/// Threads of this process, from the kernel.
std::size_t threads_now() {
    const std::filesystem::directory_iterator tasks{"/proc/self/task"};
    return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

TEST(WorkThreadThatIsLeftBehind, CostsNoThreadWhileItIsIdle) {
    // With the first one the thread sanitizer begins one of its own. One that was joined is still
    // counted until the kernel has removed it.
    std::atomic<pid_t> first = 0;
    std::thread{[&] { first = ::gettid(); }}.join();
    while (std::filesystem::exists("/proc/self/task/" + std::to_string(first)))
        std::this_thread::yield();
    const std::size_t before = threads_now();
    WorkThread thread{WorkThread::End::left_behind};
    EXPECT_EQ(threads_now(), before);
    for (int again = 0; again < 2; ++again) {
        std::promise<std::size_t> during;
        thread.post([&] { during.set_value(threads_now()); });
        EXPECT_EQ(during.get_future().get(), before + 1);
        boost::asio::io_context loop;
        EXPECT_TRUE(testing::loop_until(loop, [&] { return threads_now() == before; }));
    }
}

} // namespace
} // namespace axiscal::work_thread_test

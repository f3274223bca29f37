// One sleeper for many operations: what it may cost, and what it must not miss.
#include "drivers/loop/virtual_scheduler.hpp"
#include "drivers/wire/deadline_watch.hpp"

#include <boost/asio/post.hpp>
#include <gtest/gtest.h>

namespace axiscal::deadline_watch_test {
namespace {

using namespace std::chrono_literals;

struct DeadlineWatchTest : ::testing::Test {
    VirtualScheduler time;
    int given_up = 0;
    DeadlineWatch watch{time, [this] { ++given_up; }};
};

TEST_F(DeadlineWatchTest, GivesUpWhatOutlastsItsDeadlineAndNothingElse) {
    watch.begin(time.now() + 1s);
    time.run_for(999ms);
    EXPECT_EQ(given_up, 0);
    time.run_for(1ms);
    EXPECT_EQ(given_up, 1);
    EXPECT_TRUE(watch.end());

    watch.begin(time.now() + 1s);
    time.run_for(900ms);
    EXPECT_FALSE(watch.end());
    time.run_for(1min);
    EXPECT_EQ(given_up, 1) << "nothing is under way";
}

TEST_F(DeadlineWatchTest, WakesOnceADeadlineNotOnceAnOperation) {
    for (int operation = 0; operation < 10'000; ++operation) { // a second of a 10 kHz instrument
        watch.begin(time.now() + 8s);
        time.run_for(100us);
        EXPECT_FALSE(watch.end());
    }
    EXPECT_EQ(time.wakeups(), 0U);
    for (int operation = 0; operation < 80; ++operation) {
        watch.begin(time.now() + 8s);
        time.run_for(1s);
        EXPECT_FALSE(watch.end());
    }
    EXPECT_LE(time.wakeups(), 81U / 8 + 1); // 81 s, a deadline of 8 s
    EXPECT_EQ(given_up, 0);
}

TEST_F(DeadlineWatchTest, ASoonerDeadlineIsKeptWhileALaterOneIsSleptFor) {
    watch.begin(time.now() + 8s);
    time.run_for(10ms);
    EXPECT_FALSE(watch.end());
    watch.begin(time.now() + 20ms);
    time.run_for(20ms);
    EXPECT_EQ(given_up, 1);
    EXPECT_TRUE(watch.end());
}

TEST_F(DeadlineWatchTest, ADeadlineThatHasPassedGivesUpAtTheNextTurnOfTheLoop) {
    boost::asio::post(time.loop(), [this] {
        watch.begin(time.now() - 1ns);
        EXPECT_EQ(given_up, 0) << "never from within begin()";
    });
    time.run_for(0ns);
    EXPECT_EQ(given_up, 1);
}

TEST(DeadlineWatch, LeavesNobodyAsleepAndCallsNobodyWhenItGoes) {
    VirtualScheduler time;
    int given_up = 0;
    for (const Duration lived : {0ms, 5ms}) { // before and after its sleeper fell asleep
        auto watch = std::make_unique<DeadlineWatch>(time, [&] { ++given_up; });
        watch->begin(time.now() + 1s);
        if (lived > 0ms) time.run_for(lived);
        watch.reset();
        time.run_for(0ms);
        time.run_for(10s);
    }
    EXPECT_EQ(given_up, 0);
    EXPECT_EQ(time.wakeups(), 0U);
}

TEST(DeadlineWatch, OutlivesALoopThatTookItsSleeperAlong) {
    auto time = std::make_unique<VirtualScheduler>();
    auto watch = std::make_unique<DeadlineWatch>(*time, [] { FAIL(); });
    watch->begin(time->now() + 1s);
    time->run_for(5ms);
    time.reset();
    watch.reset(); // must not wake what is no more: the address sanitizer watches
}

} // namespace
} // namespace axiscal::deadline_watch_test

#include "bench.hpp"

#include <gtest/gtest.h>
#include <variant>
#include <vector>

namespace axiscal::run_machine_faults_test {
namespace {

using testing::at_s;
using testing::Bench;
using testing::expect_refused;
using testing::small_setup;

TEST(Place, WithinTheToleranceIsNear) {
    Bench bench;
    bench.arm().trigger(1).window(bench.capture_at(20.499_mm));
    EXPECT_TRUE(bench.saw<CommitPoint>());
    bench.commit().trigger(2).window(bench.capture_at(120.501_mm));
    expect_refused(bench, Fault::outside_window);
}

TEST(Place, LaterTargetsAreToldWhereTheAxisStands) {
    Bench bench;
    bench.arm().point(1).point(2).trigger(3).window(bench.capture_at(320.0_mm));
    expect_refused(bench, Fault::outside_window,
                   "The axis stands at 320 mm, 100 mm from the target at 220 mm; 0.5 mm are "
                   "allowed; it stands at the target at 320 mm.");
}

TEST(Place, ALaterTargetThatIsReadOneStepLateIsTold) {
    Bench bench;
    bench.arm().point(1).point(2).trigger(3).window(bench.capture_at(120.0_mm));
    expect_refused(bench, Fault::outside_window,
                   "it stands at the target at 120 mm, the one before: one step late.");
}

TEST(Place, AtTheFirstTargetsTheCauseIsNamed) {
    Bench bench;
    bench.arm().trigger(1).window(bench.capture_at(-20.0_mm));
    expect_refused(bench, Fault::wrong_direction, "the sign is turned");
    bench.trigger(1).window(bench.capture_at(508.0_mm));
    expect_refused(bench, Fault::outside_window, "inch");
    bench.trigger(1).window(bench.capture_at(0.0_mm));
    expect_refused(bench, Fault::wrong_target, "does not move");
    EXPECT_TRUE(bench.point(1).saw<Acknowledge>());
    bench.trigger(2).window(bench.capture_at(122.0_mm));
    expect_refused(bench, Fault::outside_window);
}

TEST(Place, TheSideIsJudgedAfterThePlace) {
    Bench bench;
    auto wrong_side = bench.arm().trigger(1).capture_at(20.0_mm);
    wrong_side.approach_travel = fail(Fault::wrong_direction, "Seen only 0 mm from below.");
    bench.window(wrong_side);
    expect_refused(bench, Fault::wrong_direction, "Seen only 0 mm from below");
    EXPECT_FALSE(bench.saw<CommitPoint>());
    wrong_side.mean = bench.reading_at(-20.0_mm);
    bench.trigger(1).window(wrong_side);
    expect_refused(bench, Fault::wrong_direction, "the sign is turned");
}

TEST(Environment, WithoutAFreshReadingNothingIsCaptured) {
    Bench bench;
    bench.arm();
    bench.give(EnvironmentNow{fail(Fault::environment_stale, "material 2 is 90 s old")});
    expect_refused(bench.trigger(1), Fault::environment_stale, "material 2 is 90 s old");
    EXPECT_FALSE(bench.saw<OpenWindow>());
    bench.give(EnvironmentNow{2.7e-4}).trigger(1);
    bench.give(EnvironmentNow{fail(Fault::environment_stale, "air is gone")}).window_here();
    expect_refused(bench, Fault::environment_stale, "air is gone");
}

TEST(Environment, CountsAsStaleBeforeItsFirstReading) {
    RunMachine machine{small_setup()};
    const auto actions = machine.handle(Arm{at_s(1), true});
    const auto* refusal = std::get_if<Refuse>(&actions.back());
    ASSERT_NE(refusal, nullptr);
    EXPECT_EQ(refusal->fault, Fault::environment_stale);
}

TEST(Laser, ALostBeamInTheWindowIsRefusedAndEndsTheRunAtTheNextRequest) {
    Bench bench;
    bench.arm().point(1).trigger(2).window(fail(Fault::beam_lost, "Interrupted."));
    expect_refused(bench, Fault::beam_lost);
    expect_refused(bench.trigger(2), Fault::datum_lost);
    EXPECT_FALSE(bench.the<Close>().complete);
    EXPECT_EQ(bench.the<Close>().fault, Fault::datum_lost);
}

TEST(Laser, AJumpInTheWindowEndsTheRunAtTheNextRequest) {
    Bench bench;
    bench.arm().trigger(1).window(fail(Fault::implausible_jump, "5 mm in 1 ms."));
    expect_refused(bench, Fault::implausible_jump);
    expect_refused(bench.trigger(1), Fault::datum_lost);
}

TEST(Laser, AnotherEpochThanTheDatumsClosesTheRun) {
    Bench bench;
    bench.arm().point(1).trigger(2);
    bench.epoch = 2;
    bench.window_here();
    expect_refused(bench, Fault::datum_lost, "restarted since the datum");
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_FALSE(bench.the<Close>().complete);
    expect_refused(bench.trigger(2), Fault::no_run_armed);
}

TEST(Laser, ALostZeroBetweenPointsClosesTheRun) {
    Bench bench;
    bench.arm().point(1).give(LaserFault{Fault::datum_lost, "Counter restarted.", bench.tick()});
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_EQ(bench.the<Close>().reason, "Counter restarted.");
}

TEST(Laser, ALostZeroWhileCommittingLetsThePointReachTheDisk) {
    Bench bench;
    bench.arm().trigger(1).window_here();
    bench.give(LaserFault{Fault::datum_lost, "Counter restarted.", bench.tick()});
    EXPECT_FALSE(bench.saw<Close>());
    bench.commit();
    EXPECT_EQ(bench.acknowledged, std::vector<std::uint16_t>{1});
    EXPECT_EQ(bench.the<Close>().fault, Fault::datum_lost);
}

TEST(Laser, AFaultDuringTheWindowIsToldAtOnce) {
    Bench bench;
    bench.arm().trigger(1).give(LaserFault{Fault::overspeed, "Slew error.", bench.tick()});
    expect_refused(bench, Fault::overspeed, "Slew error");
    EXPECT_TRUE(bench.saw<CloseWindow>());
    EXPECT_TRUE(bench.trigger(1).saw<OpenWindow>());
}

} // namespace
} // namespace axiscal::run_machine_faults_test

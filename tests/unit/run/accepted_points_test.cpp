// The durable points of a run, as they are shown.
#include "bench.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace axiscal::accepted_points_test {
namespace {

using testing::Bench;
using testing::small_setup;

/// Three approaches each way: thirty points.
RunSetup setup_of_three() {
    CycleConfig config;
    config.travel_low = 0.0_mm;
    config.travel_high = 500.0_mm;
    config.targets = std::vector<Length>{20.0_mm, 120.0_mm, 220.0_mm, 320.0_mm, 420.0_mm};
    config.overrun = 10.0_mm;
    config.approaches = 3;
    RunSetup setup = small_setup();
    setup.plan = plan_passes(config, 1)->front();
    return setup;
}

Bench whole_run_of_three() {
    Bench bench{setup_of_three()};
    bench.arm();
    for (std::uint16_t sequence = 1; sequence <= 30; ++sequence)
        bench.point(sequence);
    return bench;
}

Exclude exclusion_of_step(const Bench& bench, int step) {
    const PlannedPoint of = bench.machine.planned_at(step);
    Exclude exclude;
    exclude.selection = {of.target_index, of.direction, of.approach};
    exclude.reason = "somebody leaned on the table";
    return exclude;
}

TEST(AcceptedPoints, APointIsShownOnceItIsDurableAndNotBefore) {
    Bench bench;
    bench.arm().point(1);
    ASSERT_EQ(bench.machine.accepted().size(), 1U);
    bench.trigger(2).window_here();
    EXPECT_EQ(bench.machine.accepted().size(), 1U) << "it is on its way to the disk";
    bench.commit();
    ASSERT_EQ(bench.machine.accepted().size(), 2U);
    const AcceptedPoint& point = bench.machine.accepted().back();
    EXPECT_EQ(point.step, 1);
    EXPECT_EQ(point.sequence, 2);
    EXPECT_EQ(point.planned.target_index, 1);
    EXPECT_EQ(point.deviation, bench.points.back().live_deviation);
}

TEST(AcceptedPoints, APointTakenAgainFollowsTheOneThatItReplaces) {
    Bench bench;
    bench.arm();
    for (std::uint16_t sequence = 1; sequence <= 3; ++sequence)
        bench.point(sequence);
    Retake again;
    again.selection.target = 1;
    again.reason = "coolant on the mirror";
    bench.give(again);
    for (std::uint16_t sequence = 4; sequence <= 11; ++sequence)
        bench.point(sequence);
    ASSERT_EQ(bench.machine.accepted().size(), 11U);
    EXPECT_EQ(bench.machine.accepted().at(1).planned.target_index, 1);
    EXPECT_EQ(bench.machine.accepted().back().step, 10);
    EXPECT_EQ(bench.machine.accepted().back().planned.target_index, 1);
}

TEST(AcceptedPoints, OneThatIsLeftOutIsShownAndDoesNotCount) {
    Bench bench = whole_run_of_three();
    EXPECT_EQ(bench.machine.left_out(), 0U);
    ASSERT_TRUE(bench.give(exclusion_of_step(bench, 12)).saw<RecordExclusion>());
    EXPECT_EQ(bench.machine.accepted().size(), 30U);
    EXPECT_TRUE(bench.machine.leaves_out(12));
    EXPECT_FALSE(bench.machine.leaves_out(13));
    EXPECT_EQ(bench.machine.left_out(), 1U);
    const auto counting = bench.machine.counting();
    EXPECT_EQ(counting.size(), 29U);
    EXPECT_EQ(std::ranges::find(counting, 12, &AcceptedPoint::step), counting.end());
}

TEST(AcceptedPoints, OneIsLeftOutOnceTheOrderIsDurableAndNotBefore) {
    Bench bench = whole_run_of_three();
    bench.keeps_orders = false;
    bench.give(exclusion_of_step(bench, 12));
    EXPECT_FALSE(bench.machine.leaves_out(12));
    EXPECT_EQ(bench.machine.left_out(), 0U);
    EXPECT_EQ(bench.machine.counting().size(), 30U);
    bench.give(RevisionLost{bench.tick()});
    EXPECT_EQ(bench.machine.left_out(), 0U);
    bench.give(exclusion_of_step(bench, 12)).give(RevisionKept{bench.tick()});
    EXPECT_TRUE(bench.machine.leaves_out(12));
    EXPECT_EQ(bench.machine.left_out(), 1U);
}

TEST(AcceptedPoints, OfOneThatWasTakenAgainTheLastCounts) {
    Bench bench = whole_run_of_three();
    const Exclude out = exclusion_of_step(bench, 12);
    bench.give(out);
    bench.give(Retake{out.selection, "once more", bench.tick()}).point(31);
    EXPECT_TRUE(bench.machine.leaves_out(12)) << "it stays as it was";
    EXPECT_FALSE(bench.machine.leaves_out(30));
    const auto counting = bench.machine.counting();
    EXPECT_EQ(counting.size(), 30U);
    EXPECT_NE(std::ranges::find(counting, 30, &AcceptedPoint::step), counting.end());
    EXPECT_EQ(std::ranges::find(counting, 12, &AcceptedPoint::step), counting.end());
}

TEST(AcceptedPoints, ARunThatGoesOnShowsThePointsOfItsFile) {
    Bench bench;
    bench.arm().point(1).point(2);
    RunRecord file;
    file.plan = bench.setup.plan;
    file.points = {bench.points.at(1), bench.points.at(0)};
    const RunMachine machine{small_setup(), file, 1, bench.tick()};
    ASSERT_EQ(machine.accepted().size(), 2U);
    for (std::size_t nth = 0; nth < 2; ++nth) {
        EXPECT_EQ(machine.accepted().at(nth).step, static_cast<int>(nth));
        EXPECT_EQ(machine.accepted().at(nth).deviation, bench.points.at(nth).live_deviation);
    }
}

} // namespace
} // namespace axiscal::accepted_points_test

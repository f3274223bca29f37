// The durable points of a run, as they are shown.
#include "bench.hpp"

#include <gtest/gtest.h>
#include <utility>

namespace axiscal::accepted_points_test {
namespace {

using testing::Bench;
using testing::small_setup;

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

#include "cnc/commanded_axis.hpp"
#include "cnc/commanded_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::simulate::commanded_axis_test {
namespace {

TEST(TrapezoidMove, TakesTheTimeOfTheTextbook) {
    // 100 mm at 50 mm/s with 100 mm/s^2: 0.5 s up, 0.5 s down, 75 mm between in 1.5 s
    EXPECT_DOUBLE_EQ((TrapezoidMove{0, 0, 100, 50, 100}).duration_s(), 2.5);
    // 1 mm never reaches the feed: a triangle of 2 sqrt(d / a)
    EXPECT_DOUBLE_EQ((TrapezoidMove{0, 0, 1, 50, 100}).duration_s(), 0.2);
    EXPECT_DOUBLE_EQ((TrapezoidMove{0, 5, 5, 50, 100}).duration_s(), 0);
}

TEST(TrapezoidMove, NeverLeavesItsLimits) {
    for (const double to : {137.0, -12.0, 0.3}) {
        const TrapezoidMove move{2, 1, to, 40, 500};
        const double dt = 1e-4;
        double last = move.position_mm(2), last_speed = 0;
        for (double t = 2 + dt; t < 2 + move.duration_s() + 5 * dt; t += dt) {
            const double now = move.position_mm(t), speed = (now - last) / dt;
            EXPECT_LE(std::abs(speed), 40 * (1 + 1e-6));
            EXPECT_LE(std::abs(speed - last_speed) / dt, 500 * 1.01);
            last = now, last_speed = speed;
        }
        EXPECT_DOUBLE_EQ(last, to);
    }
}

TEST(CommandedAxis, StandsBetweenMovesAndRemembersItsPast) {
    CommandedAxis axis{10, 1000};
    const double end = axis.move(5, 20, 100);
    EXPECT_DOUBLE_EQ(axis.position_mm(0), 10);
    EXPECT_DOUBLE_EQ(axis.position_mm(end), 20);
    axis.move(end + 1, 0, 100);
    EXPECT_DOUBLE_EQ(axis.position_mm(end + 0.5), 20);
    EXPECT_LT(axis.position_mm(5 + 0.05), 20); // a late sampler
    EXPECT_GT(axis.position_mm(5 + 0.05), 10);
}

TEST(CommandedAxis, HaltsWhereItIs) {
    CommandedAxis axis{0, 1000};
    axis.move(0, 1000, 100);
    axis.halt(1);
    const double here = axis.position_mm(1);
    EXPECT_GT(here, 50);
    EXPECT_DOUBLE_EQ(axis.position_mm(100), here);
}

TEST(CommandedAxis, AMoveThatIsToldLateBeginsWhereTheAxisHasBeenSeen) {
    CommandedAxis axis{10, 1000};
    EXPECT_DOUBLE_EQ(axis.position_mm(5.2), 10); // a sampler, while the program was held up
    const double end = axis.move(5, 20, 100);
    EXPECT_DOUBLE_EQ(end, 5.2 + (TrapezoidMove{0, 10, 20, 100, 1000}).duration_s());
    EXPECT_NEAR(axis.position_mm(5.2 + 1e-6), 10, 1e-6) << "it does not jump";
    EXPECT_EQ(axis.shown().late(), 1);
    EXPECT_DOUBLE_EQ(axis.shown().latest_s(), 5.2 - 5);
}

TEST(CommandedAxis, AHaltThatIsToldLateDoesNotGoBack) {
    CommandedAxis axis{0, 1000};
    axis.move(0, 100, 10);
    const double seen_mm = axis.position_mm(3);
    axis.halt(2.5);
    EXPECT_DOUBLE_EQ(axis.position_mm(4), seen_mm);
}

TEST(CommandedPlane, AWayThatIsToldLateBeginsWhereThePlaneHasBeenSeen) {
    CommandedPlane plane{{0, 0}, 1000};
    EXPECT_EQ(plane.position(1.5), (PlanePoint{0, 0}));
    PlaneMove way;
    way.to = {30, 40};
    way.feed_mm_per_min = 6000;
    EXPECT_DOUBLE_EQ(plane.move(1, way), 1.5 + (TrapezoidMove{0, 0, 50, 100, 1000}).duration_s());
    EXPECT_NEAR(plane.position(1.5 + 1e-6)[1], 0, 1e-6) << "it does not jump";
    EXPECT_EQ(plane.shown().late(), 1);
}

} // namespace
} // namespace axiscal::simulate::commanded_axis_test

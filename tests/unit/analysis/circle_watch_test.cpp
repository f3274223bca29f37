#include "analysis/circular/circle_watch.hpp"

#include <gtest/gtest.h>

namespace axiscal::circle_watch_test {
namespace {

/// Rest 1.5 mm beside the circle; the step of a feed-in lies at 0.75 mm.
CircleWatch watch_outside() {
    CircularSetup setup;
    setup.plan.feed_in_mm = 1.5;
    setup.plan.feed_in_outside = true;
    return CircleWatch{setup};
}

void see(CircleWatch& watch, std::initializer_list<double> readings_mm) {
    for (const double reading_mm : readings_mm)
        watch.see(reading_mm * 1e-3);
}

TEST(CircleWatch, ACircleIsWholeBehindItsFeedOut) {
    CircleWatch watch = watch_outside();
    see(watch, {1.5, 1.5, 0.8, 0.7, 0.0, -0.005, 0.004, 0.7});
    EXPECT_FALSE(watch.whole());
    see(watch, {0.8});
    EXPECT_TRUE(watch.whole());
    see(watch, {1.5, 0.0});
    EXPECT_TRUE(watch.whole());
}

TEST(CircleWatch, ACircleThatWasUnderWayIsNotWhole) {
    CircleWatch watch = watch_outside();
    see(watch, {0.002, -0.003, 0.0, 0.7, 0.8, 1.5, 1.5});
    EXPECT_FALSE(watch.whole());
}

TEST(CircleWatch, AMachineThatRestsDrivesNoCircle) {
    CircleWatch watch = watch_outside();
    see(watch, {1.5, 1.5, 1.5});
    EXPECT_FALSE(watch.whole());
}

TEST(CircleWatch, GoesByTheSideOfTheFeedInAndByTheSignAndLengthOfTheBar) {
    CircularSetup setup;
    setup.plan.nominal_radius_mm = 100;
    setup.plan.feed_in_mm = 1.5;
    setup.plan.feed_in_outside = false; // the rest lies at a radius of 98.5 mm
    setup.bar_length_mm = 100.25;
    setup.bar_sign = -1;
    CircleWatch watch{setup};
    see(watch, {1.75, 0.25, 1.75}); // 98.5, 100, 98.5 mm
    EXPECT_TRUE(watch.whole());
}

} // namespace
} // namespace axiscal::circle_watch_test

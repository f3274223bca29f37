#include "analysis/setup/course_drift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace axiscal::course_drift_test {
namespace {

constexpr int targets = 6, approaches = 5;

/// Up and down, a point in 20 s: 59 steps in all.
RunCourse course_with(double drift_um_per_h, double scatter_um, unsigned seed) {
    std::mt19937_64 dice{seed};
    RunCourse course;
    for (int approach = 0; approach < approaches; ++approach)
        for (int place = 0; place < 2 * targets; ++place) {
            CoursePoint point;
            const bool up = place < targets;
            const int target = up ? place : 2 * targets - 1 - place;
            point.cell = 2 * target + (up ? 0 : 1);
            point.seconds = 20.0 * (2 * targets * approach + place);
            const double scatter =
                scatter_um > 0 ? std::normal_distribution{0.0, scatter_um}(dice) : 0;
            point.deviation_um =
                3 * target + (up ? 0 : 2) + drift_um_per_h * point.seconds / 3600 + scatter;
            course.points.push_back(point);
        }
    return course;
}

TEST(CourseDrift, OfAStraightDriftIsItsRangeWhateverTheAxisDoes) {
    const auto drift = drift_of(course_with(-6, 0, 1));
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->range_um, 6 * 59 * 20 / 3600.0, 1e-9);
    EXPECT_NEAR(drift->standard_uncertainty_um, 0, 1e-6);
}

/// Where nothing drifts the range is known within its u: in 68 of 100 runs (binomial 3 s: 14).
TEST(CourseDrift, OfScatterAloneIsAsLargeAsItsUncertaintyAllows) {
    int within = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        const auto drift = drift_of(course_with(0, 0.5, seed));
        ASSERT_TRUE(drift);
        within += drift->range_um <= drift->standard_uncertainty_um;
    }
    EXPECT_NEAR(within, 68, 14);
}

TEST(CourseDrift, IsNotKnownFromReadingsAtOneTimeOrTooFew) {
    RunCourse course = course_with(6, 0, 1);
    for (CoursePoint& point : course.points)
        point.seconds = 100.0 * point.cell;
    std::ranges::stable_sort(course.points, {}, &CoursePoint::seconds);
    EXPECT_FALSE(drift_of(course)) << "each target at one time";
    course = course_with(6, 0, 1);
    course.points.resize(19);
    EXPECT_FALSE(drift_of(course));
}

} // namespace
} // namespace axiscal::course_drift_test

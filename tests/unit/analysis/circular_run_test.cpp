// What stands between the capture of circles and their certificate.

#include "analysis/circular/circular_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace axiscal::circular_run_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// 0, 1, ... 359 deg, from `first_deg`; a cosine of `amplitude_mm`.
CircleCapture circle(Sense sense, int repeat, double amplitude_mm, double first_deg = 0) {
    CircleCapture capture;
    capture.repeat = repeat;
    capture.trace.sense = sense;
    for (int i = 0; i < 1440; ++i) {
        const double angle = (first_deg + i * 0.25) * degree;
        capture.trace.angle_rad.push_back(angle);
        capture.trace.radial_deviation_mm.push_back(amplitude_mm * std::cos(angle));
    }
    return capture;
}

CircularRun two_repeats() {
    CircularRun run;
    run.plan.nominal_radius_mm = 100;
    run.plan.feed_mm_per_s = 20;
    run.plan.repeats = 2;
    run.circles = {circle(Sense::ccw, 1, 0.010), circle(Sense::cw, 1, 0.020),
                   circle(Sense::ccw, 2, 0.014, 0.1), circle(Sense::cw, 2, 0.022, 0.1)};
    return run;
}

TEST(CircularRun, RepeatsAreAveragedAngleByAngle) {
    const auto test = mean_test(two_repeats());
    ASSERT_TRUE(test) << test.error().detail;
    ASSERT_EQ(test->traces.size(), 2U);
    // mean amplitudes 12 um and 21 um; chords of 0.25 deg stay within (0.25 deg)^2 / 8 of an arc
    const double chord = 0.022 * std::pow(0.25 * degree, 2) / 8;
    for (const auto& trace : test->traces)
        for (std::size_t i = 4; i < trace.angle_rad.size(); ++i)
            ASSERT_NEAR(trace.radial_deviation_mm[i],
                        (trace.sense == Sense::ccw ? 0.012 : 0.021) * std::cos(trace.angle_rad[i]),
                        chord);
}

TEST(CircularRun, WarmUpCirclesDoNotCount) {
    CircularRun run = two_repeats();
    CircleCapture warm = circle(Sense::ccw, 1, 5);
    warm.warm_up = true;
    run.circles.insert(run.circles.begin(), warm);
    const auto test = test_of_repeat(run, 1);
    ASSERT_TRUE(test);
    EXPECT_NEAR(test->traces[0].radial_deviation_mm[0], 0.010, 1e-15);
}

TEST(CircularRun, AnAngleThatOneRepeatMissesIsLeftOut) {
    CircularRun run = two_repeats();
    auto& trace = run.circles[2].trace; // readings between 25.1 and 50.1 deg are lost
    trace.angle_rad.erase(trace.angle_rad.begin() + 100, trace.angle_rad.begin() + 200);
    trace.radial_deviation_mm.erase(trace.radial_deviation_mm.begin() + 100,
                                    trace.radial_deviation_mm.begin() + 200);
    const auto test = mean_test(run);
    ASSERT_TRUE(test);
    for (const double angle : test->traces[0].angle_rad)
        EXPECT_FALSE(angle > 25.6 * degree && angle < 49.5 * degree) << angle / degree;
    EXPECT_EQ(test->traces[1].angle_rad.size(), 1440U); // the other sense is whole
}

TEST(CircularRun, AMissingCircleIsNamed) {
    CircularRun run = two_repeats();
    run.circles.pop_back();
    const auto test = mean_test(run);
    ASSERT_FALSE(test);
    EXPECT_EQ(test.error().fault, Fault::incomplete_run);
    EXPECT_NE(test.error().detail.find("circle 2 of sense cw"), std::string::npos);
}

TEST(CircularRun, ExpansionNeedsEveryNumber) {
    CircularRun run = two_repeats();
    run.bar_temperature.mean_degC = 21;
    run.machine_temperature.mean_degC = 22;
    run.bar.alpha_per_K = 1e-6;
    run.bar.length_mm = 100;
    EXPECT_FALSE(expansion_of(run));
    run.machine_alpha_per_K = 11e-6;
    ASSERT_TRUE(expansion_of(run));
    EXPECT_EQ(expansion_of(run)->machine_degC, 22);
}

TEST(CircularRun, ACircleAboutItsOwnCentreIsRound) {
    CircularTrace offset; // radius 100 about (0.3, -0.4), seen from the set-up centre
    for (int i = 0; i < 360; ++i) {
        const double x = 0.3 + 100 * std::cos(i * degree), y = -0.4 + 100 * std::sin(i * degree);
        offset.angle_rad.push_back(std::atan2(y, x));
        offset.radial_deviation_mm.push_back(std::hypot(x, y) - 100);
    }
    const auto round = centred(offset, 100, 0.3, -0.4);
    for (const double deviation : round.radial_deviation_mm)
        EXPECT_NEAR(deviation, 0, 1e-12);
}

TEST(CircularRun, APlaneNamesItsAxesInItsOwnOrder) {
    EXPECT_EQ(name_of(CircularPlane::zx), "ZX");
    EXPECT_EQ(axes_of(CircularPlane::zx)[0], "Z");
    EXPECT_EQ(axes_of(CircularPlane::yz)[1], "Z");
}

} // namespace
} // namespace axiscal::circular_run_test

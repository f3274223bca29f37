// The run machine of a rotary axis: near check behind the table, its faults, what a point keeps.
#include "analysis/rotary/rotary_position.hpp"
#include "bench.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace axiscal::rotary_run_test {
namespace {

using testing::air_index_minus_1;
using testing::Bench;

RotarySetup small_table() {
    RotarySetup rotary;
    rotary.step_deg = 5;
    rotary.arm = mm(32.61);
    return rotary;
}

RunSetup rotary_setup() {
    CycleConfig config;
    config.axis_kind = AxisKind::rotary;
    config.travel_low = -3.0_mm;
    config.travel_high = 95.0_mm;
    config.targets = std::vector<Length>{0.0_mm, 31.2_mm, 62.9_mm, 70.0_mm, 90.0_mm};
    config.overrun = 1.0_mm;
    config.approaches = 1;
    config.datum = -2.0_mm;
    RunSetup setup = testing::small_setup();
    const auto plans = plan_passes(config, 1);
    EXPECT_TRUE(plans) << describe(plans.error());
    if (plans) setup.plan = plans->front();
    setup.reading = against_artefact(small_table(), 1);
    return setup;
}

/// The axis at this angle, the table at this position.
Capture seen(const Bench& bench, double angle_deg, int position) {
    Capture capture = bench.capture_at(bench.setup.plan.datum);
    const double rest_deg = angle_deg + 2 - 5.0 * position;
    capture.mean = bench.reading_zero + mm(32.61 * (1 + air_index_minus_1) *
                                           std::sin(rest_deg * std::numbers::pi / 180));
    capture.approach_travel = mm(0.57); // of the reflectors
    return capture;
}

TEST(RotaryRun, KeepsTheReadingAndShowsTheAngle) {
    Bench bench{rotary_setup()};
    bench.arm().trigger(1).window(seen(bench, 0.003, 0)); // 2 degrees from the datum: position 0
    ASSERT_TRUE(bench.saw<CommitPoint>());
    EXPECT_NEAR(bench.points.back().live_deviation.in(mm), 0.003, 1e-9);
    EXPECT_NEAR(bench.points.back().approach_travel.in(mm), 0.57 / (32.61 * std::numbers::pi / 180),
                1e-9);
    bench.commit().trigger(2).window(seen(bench, 31.199, 7)); // 33.2: position 7, rest -1.8
    ASSERT_TRUE(bench.saw<CommitPoint>());
    EXPECT_NEAR(bench.points.back().live_deviation.in(mm), -0.001, 1e-9);
}

TEST(RotaryRun, AsksForTheOverrunInWhatTheInterferometerReads) {
    Bench bench{rotary_setup()};
    bench.arm().trigger(1);
    const auto open = bench.the<OpenWindow>();
    ASSERT_TRUE(open.approach);
    EXPECT_EQ(open.approach->overrun, least_reading_of_way(small_table(), 1.0_mm));
    EXPECT_NEAR(open.approach->overrun.in(mm), 0.5686, 5e-4);
}

TEST(RotaryRun, ATableThatWasNotTurnedFarEnoughIsNamed) {
    Bench bench{rotary_setup()};
    bench.arm().trigger(1).window(seen(bench, 0, 0)).commit();
    bench.trigger(2).window(seen(bench, 31.2, 6)); // one step short of 7
    const auto refused = bench.the<Refuse>();
    EXPECT_EQ(refused.fault, Fault::outside_window);
    EXPECT_NE(refused.sentence.find("36.2 deg"), std::string::npos) << refused.sentence;
    EXPECT_NE(refused.sentence.find("stands 1 step short of its position"), std::string::npos)
        << refused.sentence;
    EXPECT_FALSE(bench.saw<CommitPoint>());
}

TEST(RotaryRun, ARestBeyondTheRangeIsRefused) {
    Bench bench{rotary_setup()};
    bench.arm().trigger(1).window(seen(bench, 0, -2)); // rest 12 degrees
    const auto refused = bench.the<Refuse>();
    EXPECT_EQ(refused.fault, Fault::outside_window);
    EXPECT_NE(refused.sentence.find("beyond its range"), std::string::npos) << refused.sentence;
}

TEST(RotaryRun, SpeaksOfDegrees) {
    Bench bench{rotary_setup()};
    bench.arm();
    auto event = Bench::request(1);
    event.target_index = 3;
    bench.trigger(event);
    EXPECT_NE(bench.the<Refuse>().sentence.find("target index 0 at 0 deg from the positive"),
              std::string::npos)
        << bench.the<Refuse>().sentence;
}

TEST(RotaryRun, OfAPolygonTakesAReadingAsItIsTyped) {
    RunSetup setup = rotary_setup();
    setup.plan.targets = {mm(0), mm(45), mm(90)};
    setup.plan.points = order_points(CycleKind::standard, 3, 1, true);
    RotarySetup polygon;
    polygon.method = AngleMethod::polygon;
    polygon.step_deg = 45;
    polygon.range_deg = 0.2;
    setup.reading = against_artefact(polygon, 1);
    Bench bench{setup};
    bench.reading_zero = {};
    bench.arm();
    Capture typed;
    typed.mean = mm(7.2 / 3600);
    typed.n = 1;
    typed.epoch = bench.epoch;
    bench.trigger(1).window(typed);
    ASSERT_TRUE(bench.saw<CommitPoint>());
    EXPECT_NEAR(bench.points.back().live_deviation.in(mm), 7.2 / 3600, 1e-12);
    bench.commit();
    typed.mean = mm(0.21);
    bench.trigger(2).window(typed);
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::outside_window);
}

} // namespace
} // namespace axiscal::rotary_run_test

// Circles cut out of a stream whose truth is known.

#include "analysis/circular/circle_cut.hpp"
#include "driven_bar.hpp"

#include <gtest/gtest.h>

namespace axiscal::circle_cut_test {
namespace {

using circular::Cause;
using namespace test;

/// 100 mm, 2000 mm/min, 1 kHz: the circle of the design's example. Errors of the usual sizes.
DrivenBar usual_bar() {
    DrivenBar bar;
    bar.setup.plan.nominal_radius_mm = 100;
    bar.setup.plan.feed_mm_per_s = 2000.0 / 60;
    bar.truth = {{"scale_x", 40e-6},    {"scale_y", -25e-6},    {"square", 30e-6},
                 {"backlash_x", 0.004}, {"backlash_y", -0.003}, {"servo", 1e-4},
                 {"off_x_ccw", 0.010},  {"off_y_ccw", -0.008},  {"off_x_cw", 0.010},
                 {"off_y_cw", -0.008}};
    return bar;
}

std::vector<CircleMark> marks_of(const DrivenBar& bar) {
    std::vector<CircleMark> marks;
    for (const auto& [number, at] : bar.begun)
        marks.push_back({number, at});
    return marks;
}

CircularRun run_of(const DrivenBar& bar, std::vector<CircleCapture> circles) {
    CircularRun run;
    run.plan = bar.setup.plan;
    run.circles = std::move(circles);
    return run;
}

/// Every cause of the truth comes back. The form at the ends (at most 30 um) shifts the steps by as
/// much path: angles are wrong by 0.3 mrad at most, twice that of a deviation of 30 um is 18 nm a
/// reading; 0.1 um allows for a condition of 5.
void expect_truth(const DrivenBar& bar, const std::vector<CircleCapture>& circles) {
    const auto test = mean_test(run_of(bar, circles));
    ASSERT_TRUE(test) << test.error().detail;
    const auto found = diagnose_circle(*test, {"X", "Y"}).value();
    CircleTruth truth = bar.truth;
    const double R = bar.setup.plan.nominal_radius_mm, F = bar.setup.plan.feed_mm_per_s;
    for (const Cause cause : {Cause::scale_x, Cause::scale_y, Cause::squareness, Cause::backlash_x,
                              Cause::backlash_y, Cause::servo_lag_difference}) {
        const auto& estimate = found.of(cause);
        ASSERT_TRUE(estimate.value) << reference_name(cause);
        const double leverage = leverage_of(cause, R, F);
        EXPECT_NEAR(*estimate.value * leverage, truth[reference_name(cause)] * leverage,
                    3.5 * estimate.standard_uncertainty * leverage + 1e-4)
            << reference_name(cause);
    }
}

TEST(CircleCut, TheInjectedErrorsComeBackOfTheStream) {
    DrivenBar bar = usual_bar();
    bar.noise_mm = 3e-4;
    bar.setup.plan.repeats = 2;
    bar.setup.plan.warm_up = 1;
    const StreamSamples stream = bar.drive();
    const auto circles = cut_circles(bar.setup, stream, marks_of(bar));
    ASSERT_TRUE(circles) << circles.error().detail;
    ASSERT_EQ(circles->size(), 6U);
    EXPECT_TRUE((*circles)[0].warm_up);
    EXPECT_EQ((*circles)[5].repeat, 2);
    EXPECT_EQ((*circles)[5].trace.sense, Sense::cw);
    expect_truth(bar, *circles);
}

TEST(CircleCut, AFullCircleHasAsManyReadingsAsItsTimeAndNoAngleTwice) {
    DrivenBar bar = usual_bar();
    const StreamSamples stream = bar.drive();
    const auto circles = cut_circles(bar.setup, stream, {});
    ASSERT_TRUE(circles) << circles.error().detail;
    const double seconds = 2 * std::numbers::pi * 100 / bar.setup.plan.feed_mm_per_s; // 18.85
    for (const auto& circle : *circles) {
        EXPECT_NEAR(static_cast<double>(circle.trace.angle_rad.size()), seconds * 1000, 1);
        EXPECT_TRUE(cover_of(circle.trace.angle_rad).full_circle);
        const auto [low, high] = std::ranges::minmax(circle.trace.angle_rad);
        EXPECT_LT(high - low, 2 * std::numbers::pi);
    }
}

TEST(CircleCut, BrakingAtBothEndsDoesNotTurnTheCircleAndIsTold) {
    DrivenBar bar = usual_bar();
    bar.acceleration = 1000;
    const StreamSamples stream = bar.drive();
    const auto circles = cut_circles(bar.setup, stream, marks_of(bar));
    ASSERT_TRUE(circles) << circles.error().detail;
    // each of the two corners costs braking and starting: v / a; path v^2 / a each
    const double v = bar.setup.plan.feed_mm_per_s;
    for (const auto& circle : *circles)
        EXPECT_NEAR(circle.residual_mm, 2 * v * v / 1000, 0.06); // and twice the form at the ends
    expect_truth(bar, *circles);
}

/// Requests as the station keeps them, three a circle; the words reach it `late` after the machine
/// did what they say.
std::vector<EventRecord> requests_of(const DrivenBar& bar, Duration late) {
    std::vector<EventRecord> events;
    const auto note = [&](MonotonicTime at) {
        const auto sequence = static_cast<std::uint16_t>(events.size() + 1);
        events.push_back({EventKind::note, at, 0, "", Fault::none, sequence});
    };
    for (std::size_t i = 0; i < bar.arcs.size(); ++i) {
        note(bar.begun[i].second);
        note(bar.arcs[i][0] + late);
        note(bar.arcs[i][1] + late);
    }
    note(bar.begun.back().second);
    return events;
}

TEST(CircleCut, ByTheControllersWordsTheInjectedErrorsComeBack) {
    DrivenBar bar = usual_bar();
    bar.setup.plan.start = StartMethod::trigger;
    bar.setup.plan.trigger_delay_s = 0.008;
    bar.range_mm = 0.2; // neither rest nor feed-in is seen
    bar.acceleration = 1000;
    const StreamSamples stream = bar.drive();
    const auto events = requests_of(bar, std::chrono::milliseconds{8});
    const auto marks = circle_marks(bar.setup.plan, events);
    ASSERT_EQ(marks.size(), 3U);
    EXPECT_EQ(marks.back().number, 3);
    const auto circles = cut_circles(bar.setup, stream, marks);
    ASSERT_TRUE(circles) << circles.error().detail;
    const double v = bar.setup.plan.feed_mm_per_s;
    for (const auto& circle : *circles) {
        EXPECT_EQ(circle.start, StartMethod::trigger);
        EXPECT_NEAR(circle.residual_mm, v * v / 1000, 1e-3); // started and braked once
    }
    expect_truth(bar, *circles);
}

TEST(CircleCut, AWordThatNeverCameIsNamed) {
    DrivenBar bar = usual_bar();
    bar.setup.plan.start = StartMethod::trigger;
    const StreamSamples stream = bar.drive();
    auto events = requests_of(bar, Duration{});
    events.erase(events.begin() + 2); // the end of the first arc
    const auto circles = cut_circles(bar.setup, stream, circle_marks(bar.setup.plan, events));
    ASSERT_FALSE(circles);
    EXPECT_NE(circles.error().detail.find("no word at the end of the arc of circle 1 (ccw)"),
              std::string::npos);
}

/// r(t) of a circle about (a, 0) is a cos(v t / R): it moves with a v / R at most.
TEST(CircleCut, TheSynchronisationErrorIsTheSpeedOfTheRadiusTimesTheUncertainTime) {
    DrivenBar bar = usual_bar();
    bar.truth = {{"off_x_ccw", 0.010}, {"off_x_cw", 0.020}};
    StreamSamples stream = bar.drive();
    EXPECT_FALSE((*cut_circles(bar.setup, stream, marks_of(bar)))[0].synchronisation);
    stream.times = {{0, std::chrono::microseconds{15}}};
    const auto circles = cut_circles(bar.setup, stream, marks_of(bar));
    ASSERT_TRUE(circles) << circles.error().detail;
    const double turns_rad_per_s = bar.setup.plan.feed_mm_per_s / 100;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& stated = (*circles)[i].synchronisation;
        ASSERT_TRUE(stated);
        const double most_um = (i == 0 ? 10 : 20) * turns_rad_per_s * 15e-6;
        EXPECT_NEAR(stated->error_um, most_um, 1e-3 * most_um);
        EXPECT_EQ(stated->time_uncertainty, std::chrono::microseconds{15});
    }
    stream.times.push_back({stream.at.size() - stream.at.size() / 4, Duration{}});
    const auto partly = cut_circles(bar.setup, stream, marks_of(bar));
    EXPECT_TRUE((*partly)[0].synchronisation);
    EXPECT_FALSE((*partly)[1].synchronisation) << "some of its samples state no time";
}

TEST(CircleCut, ACircleThatWasBegunAgainIsTheLaterOne) {
    const std::vector<EventRecord> events{
        {EventKind::note, monotonic_from_ns(1), 0, "", Fault::none, 1},
        {EventKind::interrupted, monotonic_from_ns(2), 0, "", Fault::none, 0},
        {EventKind::note, monotonic_from_ns(3), 0, "", Fault::none, 1},
        {EventKind::note, monotonic_from_ns(4), 0, "", Fault::none, 2}};
    const auto marks = circle_marks(CircularPlan{}, events);
    ASSERT_EQ(marks.size(), 2U);
    EXPECT_EQ(marks[0].at, monotonic_from_ns(3));
}

TEST(CircleCut, AnArcIsCutWhereItWasPlanned) {
    DrivenBar bar = usual_bar();
    bar.setup.plan.start_deg = -20;
    bar.setup.plan.arc_deg = 220;
    bar.setup.plan.overshoot_deg = 10;
    bar.setup.bar_sign = -1;
    const StreamSamples stream = bar.drive();
    const auto circles = cut_circles(bar.setup, stream, {});
    ASSERT_TRUE(circles) << circles.error().detail;
    for (const auto& circle : *circles) {
        const auto [low, high] = std::ranges::minmax(circle.trace.angle_rad);
        EXPECT_NEAR(low / one_degree, -20, 0.03); // one sample and the form at the ends
        EXPECT_NEAR(high / one_degree, 200, 0.03);
    }
    EXPECT_LT(circles->front().trace.angle_rad.front(), circles->front().trace.angle_rad.back());
    EXPECT_GT(circles->back().trace.angle_rad.front(), circles->back().trace.angle_rad.back());
    expect_truth(bar, *circles);
}

TEST(CircleCut, ABarThatRestsOutsideOfItsRangeIsCutAllTheSame) {
    DrivenBar bar = usual_bar();
    bar.range_mm = 1; // the rest lies at 1.5 mm
    const StreamSamples stream = bar.drive();
    ASSERT_FALSE(stream.gaps.empty());
    const auto circles = cut_circles(bar.setup, stream, {});
    ASSERT_TRUE(circles) << circles.error().detail;
    EXPECT_EQ(circles->front().gaps, 0U);
    expect_truth(bar, *circles);
}

TEST(CircleCut, AStepThatTheBarCannotSeeIsRefused) {
    DrivenBar bar = usual_bar();
    bar.range_mm = 0.5;
    const StreamSamples stream = bar.drive();
    const auto circles = cut_circles(bar.setup, stream, marks_of(bar));
    ASSERT_FALSE(circles);
    EXPECT_NE(circles.error().detail.find("within the gauge's range"), std::string::npos);
}

TEST(CircleCut, ReadingsThatEndWithinACircleAreToldFromOnesThatAreMissing) {
    DrivenBar bar = usual_bar();
    StreamSamples stream = bar.drive();
    while (stream.value.back() > 0.75e-3) { // half of the step: the rest lies at 1.5 mm
        stream.value.pop_back();
        stream.at.pop_back();
    }
    const auto circles = cut_circles(bar.setup, stream, marks_of(bar));
    ASSERT_FALSE(circles);
    EXPECT_TRUE(circles.error().detail.ends_with("(the readings end before it)"))
        << circles.error().detail;
}

TEST(CircleCut, LostSamplesAreCountedWhereTheyLie) {
    DrivenBar bar = usual_bar();
    StreamSamples stream = bar.drive();
    DrivenBar::lose(stream, 0.25, 120); // in the middle of the first of two circles
    const auto circles = cut_circles(bar.setup, stream, marks_of(bar));
    ASSERT_TRUE(circles) << circles.error().detail;
    EXPECT_EQ(circles->front().gaps, 1U);
    EXPECT_EQ(circles->front().missing, 120U);
    EXPECT_EQ(circles->back().gaps, 0U);
    expect_truth(bar, *circles);
}

TEST(CircleCut, AnotherFeedThanTheProgrammedOneIsRefused) {
    DrivenBar bar = usual_bar();
    const StreamSamples stream = bar.drive();
    CircularSetup stated = bar.setup;
    stated.plan.feed_mm_per_s *= 0.95;
    const auto circles = cut_circles(stated, stream, marks_of(bar));
    ASSERT_FALSE(circles);
    EXPECT_NE(circles.error().detail.find("override"), std::string::npos);
}

TEST(CircleCut, AMissingCircleIsToldWithAndWithoutMarks) {
    DrivenBar bar = usual_bar();
    const StreamSamples stream = bar.drive();
    CircularSetup more = bar.setup;
    more.plan.repeats = 2;
    const auto by_order = cut_circles(more, stream, {});
    ASSERT_FALSE(by_order);
    EXPECT_NE(by_order.error().detail.find("2 circles are seen"), std::string::npos);
    const auto by_marks = cut_circles(more, stream, marks_of(bar));
    ASSERT_FALSE(by_marks);
    EXPECT_NE(by_marks.error().detail.find("circle 3 (ccw) was never begun"), std::string::npos);
}

TEST(CircleCut, OneCircleIsToldInTheSingular) {
    DrivenBar bar = usual_bar();
    bar.setup.plan.senses = {Sense::ccw};
    const StreamSamples stream = bar.drive();
    CircularSetup more = bar.setup;
    more.plan.senses = {Sense::ccw, Sense::cw};
    const auto circles = cut_circles(more, stream, {});
    ASSERT_FALSE(circles);
    EXPECT_NE(circles.error().detail.find("1 circle is seen in the readings, 2 are planned"),
              std::string::npos)
        << circles.error().detail;
}

TEST(CircleCut, TheCalibratedLengthTakesTheReadingToTheNominalRadius) {
    CircularSetup setup;
    setup.plan.nominal_radius_mm = 150;
    setup.bar_length_mm = 150.0123;
    EXPECT_NEAR(radial_deviation_mm(setup, 2e-6), 0.0143, 1e-12);
    setup.bar_sign = -1;
    EXPECT_NEAR(radial_deviation_mm(setup, 2e-6), 0.0103, 1e-12);
    setup.bar_length_mm = 0;
    EXPECT_NEAR(radial_deviation_mm(setup, 2e-6), -0.002, 1e-15);
}

} // namespace
} // namespace axiscal::circle_cut_test

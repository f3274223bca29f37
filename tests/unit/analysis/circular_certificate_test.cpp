// What the certificate of a circular test knows beside the figures themselves.

#include "analysis/circular/circular_certificate.hpp"

#include "analysis/circular/cause_advice.hpp"
#include "synthetic_circle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axiscal::circular_certificate_test {
namespace {

const test::CircleTruth some_truth{{"scale_x", 12e-6}, {"square", 22e-6}, {"backlash_x", 0.003}};

CircularMeasurement measured_of(const test::CircleTruth& truth) {
    CircularMeasurement measured;
    measured.test = test::made_test(truth, test::even_angles(0.5, 359.5, 1));
    return measured;
}

/// Repeats of backlash 2, 3 and 4 um: G of each is its backlash.
CircularRun repeated_run() {
    CircularRun run;
    run.complete = true;
    run.plan.nominal_radius_mm = 150;
    run.plan.feed_mm_per_s = 1000.0 / 60;
    run.plan.repeats = 3;
    int repeat = 0;
    for (const double backlash : {0.002, 0.003, 0.004}) {
        ++repeat;
        for (const CircularTrace& trace :
             test::made_test({{"backlash_x", backlash}}, test::even_angles(0.25, 359.75, 0.5))
                 .traces) {
            CircleCapture circle;
            circle.trace = trace;
            circle.repeat = repeat;
            run.circles.push_back(circle);
        }
    }
    return run;
}

CircularUncertaintyStatement of_form() {
    CircularUncertaintyStatement stated;
    stated.device_width_um = 0.6;
    stated.repeatability_um = 0.3;
    stated.eve_um = 0.4;
    return stated;
}

TEST(CircularCertificate, WithoutAStatementEveryTermThatCountsIsMissing) {
    const auto made = evaluate_measurement(measured_of(some_truth), "");
    ASSERT_TRUE(made);
    EXPECT_TRUE(made->preliminary);
    EXPECT_EQ(made->missing.size(), 8u) << "all but the set-up centre: F is about least squares";
    EXPECT_EQ(made->uncertainty_of("G_ccw"), nullptr);
}

TEST(CircularCertificate, GivesUOnlyWhereEveryTermIsStated) {
    CircularMeasurement measured = measured_of(some_truth);
    measured.stated = of_form();
    measured.trials = 0;
    const auto made = evaluate_measurement(measured, "");
    ASSERT_TRUE(made);
    ASSERT_NE(made->uncertainty_of("G_b"), nullptr);
    // sqrt((0.6 / 2 sqrt 3)^2 + 0.3^2 + (0.4 / 2 sqrt 3)^2) um = 0.3651 um
    EXPECT_NEAR(made->uncertainty_of("G_b")->u_mm, 1e-3 * std::sqrt(0.36 / 12 + 0.09 + 0.16 / 12),
                1e-15);
    for (const char* key : {"F_max_ccw", "F_min_cw", "D"})
        EXPECT_EQ(made->uncertainty_of(key), nullptr) << key;
    EXPECT_TRUE(made->preliminary);
    EXPECT_FALSE(made->needs("centre"));
    measured.f_centre = RadialCentre::set_up;
    EXPECT_TRUE(evaluate_measurement(measured, "")->needs("centre"));
}

TEST(CircularCertificate, OfFeedbackSignalsNeedsNoLength) {
    CircularMeasurement measured = measured_of(some_truth);
    measured.test.source = SignalSource::feedback;
    measured.stated = of_form();
    measured.trials = 0;
    const auto made = evaluate_measurement(measured, "");
    ASSERT_TRUE(made);
    EXPECT_FALSE(made->preliminary) << "G alone is evaluated, and its terms are stated";
}

TEST(CircularCertificate, TakesRepeatabilityFromTheRepeatsWhereNobodyStatedIt) {
    CircularRun run = repeated_run();
    run.uncertainty = of_form();
    run.uncertainty.repeatability_um.reset();
    auto measured = measurement_of(run);
    ASSERT_TRUE(measured);
    measured->trials = 0;
    const auto made = evaluate_measurement(*std::move(measured), "");
    ASSERT_TRUE(made);
    ASSERT_EQ(made->of_repeats.at("G_ccw").size(), 3u);
    for (int i = 0; i < 3; ++i) // at 0.25 deg from the step its height is there but for (1 - cos)
        EXPECT_NEAR(made->of_repeats.at("G_ccw")[static_cast<std::size_t>(i)], 0.002 + 0.001 * i,
                    3e-5);
    // 2, 3, 4 um: s = 1 um, in the mean of three 1 / sqrt 3
    const auto repeatability = std::ranges::find(made->budget->contributions, "repeatability",
                                                 &CircularContribution::term);
    ASSERT_NE(repeatability, made->budget->contributions.end());
    EXPECT_NEAR(repeatability->u_mm, 1e-3 / std::sqrt(3), 2e-5);
    EXPECT_NE(made->remarks.back().find("over 3 repeats"), std::string::npos);
    EXPECT_NEAR(made->parameters.ccw->G.minimum_zone_mm, 0.003, 3e-5) << "of the mean circle";
}

TEST(CircularCertificate, OfAnOpenRunIsRefused) {
    CircularRun run = repeated_run();
    run.complete = false;
    run.closing_reason = "the operator stopped it";
    const auto measured = measurement_of(run);
    ASSERT_FALSE(measured);
    EXPECT_EQ(measured.error().fault, Fault::incomplete_run);
    EXPECT_NE(measured.error().detail.find("the operator stopped it"), std::string::npos);
}

TEST(CircularCertificate, OneAndTwoCirclesHaveTheirRingsControlPoints) {
    const auto made = evaluate_measurement(measured_of(some_truth), "");
    ASSERT_TRUE(made);
    const CircularTest& test = made->measured.test;
    for (const auto* G :
         {&made->parameters.ccw->G, &made->parameters.cw->G, &*made->parameters.G_b})
        for (const RingPoint& point : G->ring.control_points) {
            const CircularTrace& trace = *test.find(point.sense);
            const double radius = 150 + trace.radial_deviation_mm.at(point.index);
            const double x = radius * std::cos(trace.angle_rad.at(point.index)) - G->ring.x_mm;
            const double y = radius * std::sin(trace.angle_rad.at(point.index)) - G->ring.y_mm;
            const bool outer = point.side == ZoneSide::outer;
            EXPECT_NEAR(std::hypot(x, y) - 150, outer ? G->ring.outer_mm : G->ring.inner_mm, 1e-10);
        }
    EXPECT_NEAR(made->parameters.G_b->ring.outer_mm - made->parameters.G_b->ring.inner_mm,
                made->parameters.G_b->minimum_zone_mm, 1e-12);
}

TEST(CircularCertificate, CanonicalBytesFeelAFigureAndNotTheLastBitOfASine) {
    const auto made = evaluate_measurement(measured_of(some_truth), "");
    ASSERT_TRUE(made);
    CircularParameters changed = made->parameters;
    const auto bytes = canonical_bytes(made->parameters);
    EXPECT_EQ(bytes.size(), 28u + 11 * 9) << "the name, eleven figures";
    *changed.D_mm += 1e-13;
    EXPECT_EQ(canonical_bytes(changed), bytes);
    *changed.D_mm += 1e-7;
    EXPECT_NE(canonical_bytes(changed), bytes);
    changed.D_mm.reset();
    EXPECT_EQ(canonical_bytes(changed).size(), 28u + 10 * 9 + 1);
}

TEST(CauseAdvice, SpeaksBySignAndAxis) {
    const auto advice = [](const test::CircleTruth& truth, const std::string& cause) {
        const auto test = test::made_test(truth, test::even_angles(0.5, 359.5, 1));
        const auto diagnosis = diagnose_circle(test, {"X", "Z"});
        for (const CauseContribution& found : diagnosis->ranking)
            if (found.cause == cause) return circular::advice_for(found, *diagnosis, {"X", "Z"});
        return std::string{};
    };
    const auto holds = [](const std::string& words, const char* part) {
        return words.find(part) != std::string::npos;
    };
    EXPECT_TRUE(holds(advice({{"backlash_y", 0.003}}, "backlash_y"), "drive of Z"));
    EXPECT_TRUE(holds(advice({{"backlash_y", -0.003}}, "backlash_y"), "lower its backlash"));
    EXPECT_TRUE(holds(advice({{"servo", 1e-4}}, "servo_lag_difference"), "raise that of X"));
    EXPECT_TRUE(holds(advice({{"servo", -1e-4}}, "servo_lag_difference"), "raise that of Z"));
    EXPECT_TRUE(holds(advice({{"lateral_x", 0.002}}, "lateral_play_x"), "guideway of X"));
    EXPECT_EQ(
        circular::with_names("apart squareness_rad, servo_lag_difference_s; together", {"X", "Z"}),
        "apart Squareness, Lag difference; together");
}

} // namespace
} // namespace axiscal::circular_certificate_test

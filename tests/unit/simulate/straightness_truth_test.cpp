// The truth of a straightness run: lines worked out by hand, bounds by their terms.
#include "straightness_truth.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::straightness_truth_test {
namespace {

double value_um(const nlohmann::json& truth, const std::string& key) {
    return truth["parameters"][key]["value"].get<double>() * 1e3;
}
double bound_um(const nlohmann::json& truth, const std::string& key) {
    return truth["parameters"][key]["bound"].get<double>() * 1e3;
}

/// A bow of 4 um over 400 mm, with lost motion of 2 um across.
Scenario bowed() {
    Scenario s;
    s.laser.kind = "umd2-heterodyne";
    s.laser.counts_per_cycle = 1;
    StraightnessScenario& straightness = s.straightness.emplace();
    straightness.across.table = {{0, 0}, {100, 3}, {200, 4}, {300, 3}, {400, 0}};
    straightness.across.reversal_um = -2;
    return s;
}

const TruthPlan plan{{0, 100, 200, 300, 400}, 5, true};

// 0, 0, 3, 0: through the ends 3; least squares has the slope 1.5 / 5 = 0.3 and the residuals
// 0, -0.3, 2.4, -0.9; no line is nearer than the one through the three zeros.
TEST(TrueStraightness, OfFourPointsIsWorkedOutByHand) {
    const TrueStraightness found = straightness_of({0, 1, 2, 3}, {0, 0, 3, 0});
    EXPECT_NEAR(found.end_points_um, 3, 1e-12);
    EXPECT_NEAR(found.least_squares_um, 3.3, 1e-12);
    EXPECT_NEAR(found.minimum_zone_um, 3, 1e-12);
}

// 0, 2, 1, 3: through the ends +-1 is 2 * 1; the zone lies along the slope 1/2: 0, 1.5, 0, 1.5.
TEST(TrueStraightness, TheZoneLiesAlongAPairOfPoints) {
    const TrueStraightness found = straightness_of({0, 1, 2, 3}, {0, 2, 1, 3});
    EXPECT_NEAR(found.end_points_um, 2, 1e-12);
    EXPECT_NEAR(found.minimum_zone_um, 1.5, 1e-12);
}

TEST(TrueStraightness, ASlopeOfTheSetUpChangesNothing) {
    Scenario sloped = bowed();
    sloped.straightness->across.linear_um_per_m = 250;
    for (const char* key : {"straightness_end_points", "straightness_least_squares",
                            "straightness_minimum_zone", "straightness_minimum_zone_backward"})
        EXPECT_NEAR(value_um(truth_of(sloped, plan), key), value_um(truth_of(bowed(), plan), key),
                    1e-9)
            << key;
}

TEST(TrueStraightness, OfTheBowIsItsHeightAndTheLostMotionIsB) {
    const auto truth = truth_of(bowed(), plan);
    EXPECT_NEAR(value_um(truth, "straightness_minimum_zone"), 4, 1e-9);
    EXPECT_NEAR(value_um(truth, "straightness_end_points_forward"), 4, 1e-9);
    EXPECT_NEAR(value_um(truth, "B"), 2, 1e-9);
    EXPECT_NEAR(value_um(truth, "B_mean"), -2, 1e-9);
}

// One count of a homodyne counter, lambda / 8, times the factor: 0.0791239 um * 36.
TEST(TrueStraightness, OneCountIsEnlargedByTheFactor) {
    Scenario coarse = bowed();
    coarse.laser.kind = "umd2-homodyne";
    coarse.laser.counts_per_cycle = 4;
    const auto truth = truth_of(coarse, plan);
    EXPECT_NEAR(truth["terms_um"]["count"].get<double>(), 2.848461, 1e-5);
    EXPECT_GT(bound_um(truth, "straightness_end_points"), 4 * 2.848);
    EXPECT_LT(bound_um(truth_of(bowed(), plan), "straightness_end_points"), 0.01);
}

// -2, 1, 2, 1, -2 is left of the mirror's form about its own line.
TEST(TrueStraightness, TheMirrorsFormStandsInTheBoundOfOneRun) {
    Scenario bent = bowed();
    bent.straightness->mirror.table = {{0, 0}, {100, 3}, {200, 4}, {300, 3}, {400, 0}};
    bent.straightness->mirror.linear_um_per_m = 100;
    const auto truth = truth_of(bent, plan);
    EXPECT_NEAR(truth["terms_um"]["mirror"].get<double>(), 2, 1e-9);
    EXPECT_NEAR(value_um(truth, "straightness_minimum_zone"), 4, 1e-9);
    EXPECT_GT(bound_um(truth, "straightness_minimum_zone"), 4);
    EXPECT_LT(bound_um(truth, "B"), 0.01);
}

TEST(TrueStraightness, OfOneDirectionHasNoReversal) {
    const auto truth = truth_of(bowed(), {{0, 100, 200, 300, 400}, 1, false});
    EXPECT_FALSE(truth["parameters"].contains("B"));
    EXPECT_FALSE(truth["parameters"].contains("straightness_end_points_backward"));
    EXPECT_NEAR(value_um(truth, "straightness_end_points"), 4, 1e-9);
}

} // namespace
} // namespace axiscal::simulate::straightness_truth_test

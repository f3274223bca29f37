// The truth of a squareness run: angles worked out by hand, bounds by their terms.
#include "squareness_truth.hpp"
#include "straightness_optics.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::squareness_truth_test {
namespace {

double value_of(const nlohmann::json& truth, const std::string& key) {
    return truth["parameters"][key]["value"].get<double>();
}
double bound_of(const nlohmann::json& truth, const std::string& key) {
    return truth["parameters"][key]["bound"].get<double>();
}

/// 25 um/m more than a right angle, through a square of 8 um/m; the first line rose by 30 um/m.
Scenario open_by_25() {
    Scenario s;
    s.laser.kind = "umd2-heterodyne";
    s.laser.counts_per_cycle = 1;
    s.straightness.emplace();
    SquarenessScenario& hidden = s.squareness.emplace();
    hidden.axes_um_per_m = 25;
    hidden.square_um_per_m = 8;
    hidden.first_um_per_m = 30;
    return s;
}

const TruthPlan plan{{0, 100, 200, 300, 400}, 5, true};

// 25 = -30 - a2 + 8; turned 25 = -30 - a2 - 8. Third powers of 1e-4 are far below 1e-6 um/m.
TEST(TrueSquareness, TheSecondLineGainsTheSlopeThatIsLeft) {
    Scenario scenario = open_by_25();
    EXPECT_NEAR(scenario_across(scenario).errors.linear_um_per_m, -47, 1e-6);
    scenario.squareness->square_turned = true;
    EXPECT_NEAR(scenario_across(scenario).errors.linear_um_per_m, -63, 1e-6);
    scenario.squareness.reset();
    EXPECT_EQ(scenario_across(scenario).errors.linear_um_per_m, 0);
}

TEST(TrueSquareness, IsTheHiddenAngleHoweverTheSquareStands) {
    Scenario scenario = open_by_25();
    for (const bool turned : {false, true}) {
        scenario.squareness->square_turned = turned;
        const auto truth = truth_of(scenario, plan);
        EXPECT_EQ(truth["unit"], "um/m");
        for (const char* key :
             {"squareness_end_points", "squareness_least_squares", "squareness_minimum_zone"})
            EXPECT_NEAR(value_of(truth, key), 25, 1e-6) << key << turned;
        EXPECT_EQ(value_of(truth, "square_error"), 8);
    }
}

// 0, 2, 1, 3 um at 0 ... 300 mm: the ends rise by 10 um/m; least squares by (-1.5 * 0 - 0.5 * 2 +
// 0.5 * 1 + 1.5 * 3) / 5 = 0.8 um a step, 8 um/m; the zone lies along 0.5 um a step, 5 um/m.
TEST(TrueSquareness, EachReferenceTakesItsOwnSlopeOfTheMotion) {
    Scenario wavy = open_by_25();
    wavy.straightness->across.table = {{0, 0}, {100, 2}, {200, 1}, {300, 3}};
    const auto truth = truth_of(wavy, {{0, 100, 200, 300}, 1, true});
    EXPECT_NEAR(value_of(truth, "squareness_end_points"), 15, 1e-6);
    EXPECT_NEAR(value_of(truth, "squareness_least_squares"), 17, 1e-6);
    EXPECT_NEAR(value_of(truth, "squareness_minimum_zone"), 20, 1e-6);
}

// One count is lambda / 8 times 36, 2.848461 um, at every target: 2 counts over 400 mm, 600 mm of
// distances over 100 000 mm^2, or four counts over 400 mm; twice, for both lines; 1e-4 of 77 um/m.
TEST(TrueSquareness, OneCountTurnsBothLines) {
    Scenario coarse = open_by_25();
    coarse.laser.kind = "umd2-homodyne";
    coarse.laser.counts_per_cycle = 4;
    const auto truth = truth_of(coarse, plan);
    EXPECT_NEAR(bound_of(truth, "squareness_end_points"), 28.48461 + 0.0077, 1e-4);
    EXPECT_NEAR(bound_of(truth, "squareness_least_squares"), 34.181532 + 0.0077, 1e-4);
    EXPECT_NEAR(bound_of(truth, "squareness_minimum_zone"), 56.96922 + 0.0077, 1e-4);
    EXPECT_EQ(bound_of(truth, "square_error"), bound_of(truth, "squareness_least_squares"));
    EXPECT_LT(bound_of(truth_of(open_by_25(), plan), "squareness_minimum_zone"), 0.02);
}

// -20 ... 20 um: 2 * 20 um * 600 mm / 100 000 mm^2.
TEST(TrueSquareness, ASlopeOfTheMirrorStandsInTheBound) {
    Scenario bent = open_by_25();
    bent.straightness->mirror.linear_um_per_m = 100;
    const auto truth = truth_of(bent, plan);
    EXPECT_NEAR(truth["terms_um"]["mirror"].get<double>(), 20, 1e-9);
    EXPECT_NEAR(value_of(truth, "squareness_least_squares"), 25, 1e-6);
    EXPECT_NEAR(bound_of(truth, "squareness_least_squares"), 240, 0.02);
}

// Noise of a stop of 0.1 um, five stops from each side: z = sqrt(2 ln(10 / 0.001)) = 4.291932, and
// 4.291932 * 0.1 / sqrt 10 over sqrt(100 000) mm, twice.
TEST(TrueSquareness, NoiseFallsWithTheReadings) {
    Scenario noisy = open_by_25();
    noisy.straightness->across.approach_noise_um = 0.1;
    const auto truth = truth_of(noisy, plan);
    const double quiet = bound_of(truth_of(open_by_25(), plan), "squareness_least_squares");
    EXPECT_NEAR(bound_of(truth, "squareness_least_squares") - quiet, 0.8583864, 1e-6);
}

} // namespace
} // namespace axiscal::simulate::squareness_truth_test

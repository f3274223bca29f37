// What the interferometer behind a Wollaston prism counts.
#include "straightness_optics.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::straightness_optics_test {
namespace {

/// 36 um across at 100 mm, 3.6 um of the mirror's form, and an axis that is wrong by far more.
Scenario across_by_36_um() {
    Scenario scenario;
    scenario.laser.kind = "umd2-heterodyne";
    scenario.laser.counts_per_cycle = 1;
    scenario.errors.linear_um_per_m = 1000;
    scenario.errors.noise_um = 5;
    scenario.thermal.material.start = 35;
    StraightnessScenario& straightness = scenario.straightness.emplace();
    straightness.across.table = {{0, 0}, {100, 36}};
    straightness.mirror.table = {{0, 0}, {100, 3.6}};
    return scenario;
}

/// Shown at 100 mm since the start at 0. N = fold n D / lambda.
double shown_um(const Scenario& scenario) {
    StraightnessOptics optics{scenario};
    EXPECT_EQ(optics.cycles(0, 0, 0), 0);
    const double n = 1 + refractivity(air_at(scenario.air, 0), nm(scenario.laser.wavelength_nm));
    return optics.cycles(100, 0.1, 1) * 0.632991354 / (2 * n);
}

TEST(StraightnessOptics, ShowWhatMovesAcrossByTheFactorLess) {
    EXPECT_NEAR(shown_um(across_by_36_um()), 1.1, 1e-9);
}

TEST(StraightnessOptics, OfATurnedMirrorTakeItsFormAway) {
    Scenario scenario = across_by_36_um();
    scenario.straightness->mirror_reversed = true;
    EXPECT_NEAR(shown_um(scenario), 0.9, 1e-9);
}

TEST(StraightnessOptics, FollowTheSignOfTheLaser) {
    Scenario scenario = across_by_36_um();
    scenario.laser.sign = -1;
    EXPECT_NEAR(shown_um(scenario), -1.1, 1e-9);
}

TEST(StraightnessOptics, BeginAnewWithTheCounter) {
    StraightnessOptics optics{across_by_36_um()};
    optics.cycles(0, 0, 0);
    optics.zero_counter();
    EXPECT_EQ(optics.cycles(100, 0.1, 1), 0);
}

} // namespace
} // namespace axiscal::simulate::straightness_optics_test

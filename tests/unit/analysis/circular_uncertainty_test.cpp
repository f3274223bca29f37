#include "analysis/circular/circular_uncertainty.hpp"
#include "synthetic_circle.hpp"

#include <gtest/gtest.h>

namespace axiscal::circular_uncertainty_test {
namespace {

using namespace test;

const double root3 = std::sqrt(3.0);

CircularTest plain(double R = 150) {
    return made_test(CircleTruth{{"square", 4e-5}}, even_angles(5, 355, 10), R);
}

CircularBudget budget(const CircularTest& test,
                      const std::optional<BarExpansion>& bar,
                      const CircularUncertaintyStatement& statement,
                      RadialCentre centre = RadialCentre::automatic,
                      int trials = 0) {
    return circular_budget(test, centre, bar, statement, trials).value();
}

TEST(CircularUncertainty, DIsTheRootOfItsTerms) {
    const BarExpansion bar{25, 23, 1.2e-6, 11.5e-6, 150.01};
    CircularUncertaintyStatement s;
    s.calibration_U_um = 1.0;
    s.calibration_k = 2;
    s.machine_temperature_width_K = 1;
    s.bar_temperature_width_K = 2;
    s.machine_alpha_width_per_K = 2e-6;
    s.bar_alpha_width_per_K = 1e-6;
    s.eve_um = 0.6;
    s.runs = 4;
    const CircularBudget found = budget(plain(), bar, s);
    const double terms[] = {0.5e-3,
                            150 * 11.5e-6 * 1 / (2 * root3),
                            150.01 * 1.2e-6 * 2 / (2 * root3),
                            150 * 3 * 2e-6 / (2 * root3),
                            150.01 * 5 * 1e-6 / (2 * root3),
                            0.6e-3 / (2 * root3) / 2};
    double squares = 0;
    for (const double u : terms)
        squares += u * u;
    EXPECT_NEAR(found.find("D")->u_mm, std::sqrt(squares), 1e-15);
    EXPECT_NEAR(found.find("D")->expanded_mm, 2 * std::sqrt(squares), 1e-15);
    EXPECT_NEAR(found.find("G_ccw")->u_mm, 0.6e-3 / (2 * root3) / 2, 1e-15)
        << "temperature and calibration cancel in a form";
    EXPECT_NEAR(found.find("F_max_cw")->u_mm, found.find("D")->u_mm, 1e-15);
    EXPECT_EQ(found.contributions.size(), 6);
    EXPECT_EQ(found.not_stated, (std::vector<std::string>{"device", "repeatability", "centre"}));
}

TEST(CircularUncertainty, GIsTheDeviceAloneWhereNothingElseIsStated) {
    CircularUncertaintyStatement s;
    s.device_width_um = 0.5;
    const CircularBudget found = budget(plain(), {}, s);
    for (const char* key : {"G_ccw", "G_cw", "G_b", "F_max_ccw", "F_min_cw"})
        EXPECT_NEAR(found.find(key)->u_mm, 0.5e-3 / (2 * root3), 1e-18) << key;
    EXPECT_EQ(found.find("D")->u_mm, 0);
}

TEST(CircularUncertainty, TheCentreCountsForFAboutTheSetUpAlone) {
    CircularUncertaintyStatement s;
    s.centre_width_um = 10;
    const CircularBudget fitted = budget(plain(), {}, s);
    const CircularBudget set_up = budget(plain(), {}, s, RadialCentre::set_up);
    EXPECT_EQ(fitted.find("F_max_ccw")->u_mm, 0);
    EXPECT_NEAR(set_up.find("F_max_ccw")->u_mm, 10e-3 / (2 * root3), 1e-15);
    EXPECT_EQ(set_up.find("G_ccw")->u_mm, 0);
}

TEST(CircularUncertainty, TrialsAgreeWithTheFormulaTermByTerm) {
    // 2000 trials: the standard deviation has a relative uncertainty of 1.6 %; four of those
    constexpr double part = 0.07;
    const BarExpansion bar{25, 23, 1.2e-6, 11.5e-6, 150.01};
    const auto agree = [&](auto state, const char* key) {
        CircularUncertaintyStatement s;
        state(s);
        const CircularBudget found = budget(plain(), bar, s, RadialCentre::automatic, 2000);
        const auto& figure = *found.find(key);
        EXPECT_NEAR(*figure.monte_carlo_u_mm, figure.u_mm, part * figure.u_mm) << key;
    };
    agree(
        [](auto& s) {
            s.calibration_U_um = 1;
            s.calibration_k = 2;
        },
        "D");
    agree(
        [](auto& s) {
            s.calibration_U_um = 1;
            s.calibration_k = 2;
        },
        "F_max_ccw");
    agree([](auto& s) { s.machine_temperature_width_K = 1; }, "D");
    agree([](auto& s) { s.bar_temperature_width_K = 2; }, "F_min_cw");
    agree([](auto& s) { s.machine_alpha_width_per_K = 2e-6; }, "D");
    agree([](auto& s) { s.bar_alpha_width_per_K = 1e-6; }, "D");
    agree([](auto& s) { s.device_width_um = 0.5; }, "G_b");
    agree(
        [](auto& s) {
            s.repeatability_um = 0.3;
            s.runs = 3;
        },
        "G_ccw");
}

TEST(CircularUncertainty, TheFormulaIsOnTheSafeSideForDrift) {
    CircularUncertaintyStatement s;
    s.eve_um = 1;
    const CircularBudget found = budget(plain(), {}, s, RadialCentre::automatic, 1000);
    // straight from one draw to another: the mean of a trace has 1/sqrt(2), of both traces 1/2
    EXPECT_NEAR(*found.find("D")->monte_carlo_u_mm, found.find("D")->u_mm / 2,
                0.08 * found.find("D")->u_mm);
    EXPECT_LT(*found.find("F_max_ccw")->monte_carlo_u_mm, found.find("F_max_ccw")->u_mm);
}

TEST(CircularUncertainty, TheSameSeedGivesTheSameTrials) {
    CircularUncertaintyStatement s;
    s.device_width_um = 0.5;
    s.eve_um = 0.5;
    const auto draw = [&](std::uint64_t seed) {
        return *circular_budget(plain(), RadialCentre::automatic, {}, s, 50, seed)
                    .value()
                    .find("G_b")
                    ->monte_carlo_u_mm;
    };
    EXPECT_EQ(draw(1), draw(1));
    EXPECT_NE(draw(1), draw(2));
}

TEST(CircularUncertainty, RefusesByField) {
    const auto field = [&](auto state) {
        CircularUncertaintyStatement s;
        state(s);
        const auto result = circular_budget(plain(), RadialCentre::automatic, {}, s, 0);
        return result ? std::string{} : result.error().field;
    };
    EXPECT_EQ(field([](auto& s) { s.device_width_um = -1; }), "uncertainty.device_width_um");
    EXPECT_EQ(field([](auto& s) { s.eve_um = std::nan(""); }), "uncertainty.eve_um");
    EXPECT_EQ(field([](auto& s) { s.calibration_U_um = 1; }), "uncertainty.calibration_k");
    EXPECT_EQ(field([](auto& s) { s.bar_temperature_width_K = 1; }),
              "uncertainty.bar_temperature_width_K");
    EXPECT_EQ(field([](auto& s) { s.runs = 0; }), "uncertainty.n");
}

} // namespace
} // namespace axiscal::circular_uncertainty_test

#include "truth.hpp"

#include "injected_process.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::simulate::truth_test {
namespace {

double value(const nlohmann::json& truth, const std::string& key) {
    return truth["parameters"][key]["value"].get<double>();
}

Scenario injected() {
    Scenario s;
    s.errors.linear_um_per_m = 10;
    s.errors.reversal_um = -3;
    s.errors.approach_noise_um = 0.2;
    s.truth.draws = 500;
    return s;
}

const TruthPlan plan{{0, 250, 500, 750, 1000}, 5, true};

TEST(Truth, ParametersOfAStraightLineWithLostMotion) {
    const auto truth = truth_of(injected(), plan);
    EXPECT_NEAR(value(truth, "E_forward"), 0.010, 1e-12);
    EXPECT_NEAR(value(truth, "M"), 0.010, 1e-12);
    EXPECT_NEAR(value(truth, "E"), 0.013, 1e-12); // the line and the reversal
    EXPECT_NEAR(value(truth, "B"), 0.003, 1e-12);
    EXPECT_NEAR(value(truth, "B_mean"), -0.003, 1e-12);
}

TEST(Truth, ReversalChangesSignWithItsInjection) {
    Scenario s = injected();
    s.errors.reversal_um = 3;
    EXPECT_NEAR(value(truth_of(s, plan), "B_mean"), 0.003, 1e-12);
    EXPECT_NEAR(value(truth_of(s, plan), "E"), 0.013, 1e-12);
}

TEST(Truth, ScatterGivesAnIntervalAroundTheMedian) {
    const auto truth = truth_of(injected(), plan);
    for (const char* key : {"A", "R", "R_forward"}) {
        const auto p = truth["parameters"][key];
        EXPECT_LE(p["low"], p["value"]) << key;
        EXPECT_LE(p["value"], p["high"]) << key;
    }
    // s of 5 readings: chi with 4 degrees, median 0.916 sigma; the largest of 5 targets is above
    EXPECT_GT(value(truth, "R_forward"), 4 * 0.2e-3 * 0.916);
    EXPECT_GT(value(truth, "A"), value(truth, "E"));
}

TEST(Truth, WithoutNoiseScatterVanishes) {
    Scenario s = injected();
    s.errors.approach_noise_um = 0;
    const auto truth = truth_of(s, plan);
    EXPECT_NEAR(value(truth, "R_forward"), 0, 1e-12);
    EXPECT_NEAR(value(truth, "A"), 0.013, 1e-12);
    EXPECT_NEAR(value(truth, "R"), 0.003, 1e-12);
}

double bound(const nlohmann::json& truth, const std::string& key, const std::string& which) {
    return truth["parameters"][key][which].get<double>();
}

TEST(Truth, DriftIsDrawnIntoTheScatterAndWidensNothing) {
    Scenario s = injected();
    s.errors.approach_noise_um = 0;
    s.errors.drift_um_per_hour = 36; // 1 um in the 100 s
    s.truth.duration_s = 100;
    s.laser.kind = "umd2-heterodyne";
    s.laser.counts_per_cycle = 1;
    // 50 captures, 49 gaps; the five of a target lie 10 gaps apart: s = 10 gaps sqrt(2.5). A run
    // takes all of the 100 s at most, half of them at least.
    const double longest_mm = 4 * std::sqrt(2.5) * 10 / 49.0 * 1e-3;
    const double count_mm = 1e-8; // of a phase of 16 bits, with its factor 1 + 2 sqrt(5/4)
    const auto truth = truth_of(s, plan);
    EXPECT_LE(bound(truth, "R_forward", "high"), longest_mm + 2 * count_mm);
    EXPECT_GE(bound(truth, "R_forward", "low"), longest_mm / 2 - 2 * count_mm);
    EXPECT_NEAR(value(truth, "R_forward"), 0.75 * longest_mm, 0.05 * longest_mm);
}

TEST(Truth, MaterialSensorThatStepsDuringTheRunIsDrawnIntoTheScatter) {
    Scenario s = injected();
    s.errors.approach_noise_um = 0;
    s.thermal.material = {23.045, 0.36, 0, 600}; // shown 23.0 up to 50 s, then 23.1
    s.truth.duration_s = 100;
    s.sensors.push_back({"material", "tm-th8"});
    // 0.1 K at 1 m: 1.17 um between k of five readings and the others: s = 1.17 sqrt(k (5-k) / 20),
    // at most sqrt(6/20). The true 0.01 K between the first and the last adds less than 0.117 um.
    const double largest_mm = 4 * (1.17 * std::sqrt(6.0 / 20.0) + 0.117) * 1e-3;
    const double rounding_mm = 0.0792e-3 * (1 + 2 * std::sqrt(5.0 / 4.0)); // of a quarter fringe
    const auto truth = truth_of(s, plan);
    EXPECT_GT(value(truth, "R_forward"), 4 * 1.0 * std::sqrt(4.0 / 20.0) * 1e-3);
    EXPECT_LE(bound(truth, "R_forward", "high"), largest_mm + rounding_mm);
}

TEST(Truth, IntervalOfTheScatterIsThatOfTheDraws) {
    const auto truth = truth_of(injected(), plan);
    // Beside the draws: half a count of 632.99 nm / 8 each way, c (1 + 2 sqrt(5/4)); A also sees
    // the formulas of air, 6e-8 of 1 m.
    const double rounding_mm = 632.991354e-6 / 8 * (1 + 2 * std::sqrt(5.0 / 4.0));
    for (const char* key : {"R", "R_forward", "R_backward"})
        EXPECT_NEAR(bound(truth, key, "high") - bound(truth, key, "draw_high"), rounding_mm, 1e-12)
            << key;
    EXPECT_NEAR(bound(truth, "A", "high") - bound(truth, "A", "draw_high"), rounding_mm + 6e-5,
                1e-12);
}

/// Probability that s of five normal readings gives R = 4 s or less, at each of m targets: of
/// chi-square with 4 degrees of freedom, x = 4 s^2 / sigma^2, F(x) = 1 - exp(-x/2) (1 + x/2).
double probability_of(double R_um, double sigma_um, int targets) {
    const double half_x = R_um * R_um / (8 * sigma_um * sigma_um);
    const double one = -std::expm1(-half_x) - half_x * std::exp(-half_x);
    return std::pow(one, targets);
}

/// One way, noise of 0.2 um and nothing else, as many draws as a scenario has that states none.
nlohmann::json truth_of_noise(int targets) {
    Scenario s = injected();
    s.truth.draws = Scenario{}.truth.draws;
    TruthPlan one_way{{}, 5, false};
    for (int i = 0; i < targets; ++i)
        one_way.targets_mm.push_back(100.0 * i);
    return truth_of(s, one_way);
}

// The k-th smallest of 10 000 probabilities is Beta(k, 10001 - k), near enough Gamma(k) / 10 000:
// all but 1e-4 of it lies, for k = 5 (share 0.0005), between 3.8e-5 and 1.87e-3, and for the sixth
// largest (share 0.9995 of 9999, cut to a whole number) between 6.2e-5 and 2.05e-3. The median
// scatters by 0.005.
TEST(Truth, IntervalOfFiveNormalReadingsIsThatOfChiSquare) {
    for (const int targets : {1, 5}) {
        const auto truth = truth_of_noise(targets);
        EXPECT_EQ(truth["draws"], 10000);
        const auto at = [&](const char* which) {
            return probability_of(bound(truth, "R_forward", which) * 1e3, 0.2, targets);
        };
        EXPECT_GT(at("draw_low"), 3.8e-5) << targets;
        EXPECT_LT(at("draw_low"), 1.87e-3) << targets;
        EXPECT_GT(1 - at("draw_high"), 6.2e-5) << targets;
        EXPECT_LT(1 - at("draw_high"), 2.05e-3) << targets;
        EXPECT_NEAR(at("value"), 0.5, 4 * 0.005) << targets;
    }
}

// Which of the 10 000 they are, to the last one: five lie at or below the low end, six at or above
// the high one.
TEST(Truth, IntervalLeavesFiveInTenThousandOutOnEachSide) {
    const TruthPlan one_way{{500}, 5, false};
    Scenario s = injected();
    s.truth.draws = Scenario{}.truth.draws;
    const auto truth = truth_of(s, one_way);
    const InjectedProcess process{s, one_way};
    const double low_um = bound(truth, "R_forward", "draw_low") * 1e3;
    const double high_um = bound(truth, "R_forward", "draw_high") * 1e3;
    constexpr double rounding_um = 1e-9; // far below the distance of two draws in the tails
    int up_to_low = 0, from_high = 0;
    for (std::uint64_t k = 0; k < 10'000; ++k) {
        const auto run = process.draw(k);
        double sum = 0, squares = 0;
        for (const double um : run.forward.front())
            sum += um;
        for (const double um : run.forward.front())
            squares += (um - sum / 5) * (um - sum / 5);
        const double R_um = 4 * std::sqrt(squares / 4);
        up_to_low += R_um <= low_um + rounding_um;
        from_high += R_um >= high_um - rounding_um;
    }
    EXPECT_EQ(up_to_low, 5);
    EXPECT_EQ(from_high, 6);
}

TEST(Truth, OneApproachHasNoScatterParameters) {
    const auto truth = truth_of(injected(), TruthPlan{plan.targets_mm, 1, true});
    EXPECT_FALSE(truth["parameters"].contains("R"));
    EXPECT_FALSE(truth["parameters"].contains("A"));
    EXPECT_TRUE(truth["parameters"].contains("E"));
}

TEST(Truth, SameSeedSameBits) {
    EXPECT_EQ(truth_of(injected(), plan).dump(), truth_of(injected(), plan).dump());
}

TEST(Truth, CoarseMaterialSensorWidensTheBound) {
    Scenario s = injected();
    s.thermal.material.start = 23.04; // shown as 23.0: 0.04 K * 11.7 um/m/K * 1 m = 0.468 um
    const double without = truth_of(s, plan)["parameters"]["E"]["bound"];
    s.sensors.push_back({"material", "tm-th8"});
    const auto truth = truth_of(s, plan);
    EXPECT_NEAR(truth["terms_um"]["material_scale"], 0.468, 1e-9);
    EXPECT_NEAR(truth["parameters"]["E"]["bound"].get<double>() - without, 0.468e-3, 1e-9);
}

TEST(Evaluation, TakesTheLargestOfTheThreeForms) {
    // One target: forward {1,-1} s = sqrt 2, backward {0,0}: 2s + |B| = 2 sqrt 2 < 4s = 4 sqrt 2
    const auto p = evaluate_truth({{1, -1}}, {{0, 0}});
    EXPECT_NEAR(p.at("R"), 4 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(p.at("A"), 4 * std::sqrt(2.0), 1e-12);
}

TEST(TruthPlan, ComesFromTheProgramsRequests) {
    std::string text = "G21 G90\nF1000\nG1 X-5\nM68 E0 Q0\nM66 P0 L3 Q9\n";
    int sequence = 0;
    for (int run = 0; run < 2; ++run)
        for (const auto& pass :
             {std::vector<double>{10, 20, 30}, std::vector<double>{30, 20, 10}}) {
            text += pass[0] < 20 ? "G1 X5\n" : "G1 X35\n";
            for (const double target : pass)
                text += "G1 X" + std::to_string(target) + "\nG4 P1\nM68 E0 Q" +
                        std::to_string(++sequence) + "\nM66 P0 L3 Q9\n";
        }
    const auto found = plan_of_program(text, false, Scenario{});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->targets_mm, (std::vector<double>{10, 20, 30}));
    EXPECT_EQ(found->approaches, 2);
    EXPECT_TRUE(found->bidirectional);
}

TEST(TruthPlan, ComesFromTheDwellsWhereNothingIsRequested) {
    const std::string text = "G1 X0 F100\nG4 P9\nG1 X10\nG4 P500\nG1 X20\nG4 P500\nG1 X25\n"
                             "G1 X20\nG4 P500\nG1 X10\nG4 P500\n";
    const auto found = plan_of_program(text, true, Scenario{});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->targets_mm, (std::vector<double>{10, 20}));
    EXPECT_EQ(found->approaches, 1);
}

TEST(TruthPlan, NeedsACapture) {
    EXPECT_FALSE(plan_of_program("G0 X1\n", false, Scenario{}));
}

} // namespace
} // namespace axiscal::simulate::truth_test

#include "analysis/straightness/straightness_figures.hpp"

#include "analysis/straightness/run_straightness.hpp"
#include "analysis/straightness/sensitivity.hpp"
#include "analysis/straightness/straightness_budget.hpp"
#include "analysis/straightness/straightness_trials.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace axiscal::straightness_figures_test {
namespace {

constexpr std::array references{LineReference::end_points, LineReference::least_squares,
                                LineReference::minimum_zone};

/// y = 4 h x (L - x) / L^2 at m equal steps, um over mm.
std::vector<double> parabola(double h, int m) {
    std::vector<double> y;
    for (int i = 0; i < m; ++i) {
        const double share = static_cast<double>(i) / (m - 1);
        y.push_back(4 * h * share * (1 - share));
    }
    return y;
}

std::vector<double> places(double length_mm, int m) {
    std::vector<double> x;
    for (int i = 0; i < m; ++i)
        x.push_back(length_mm * i / (m - 1));
    return x;
}

StraightnessLine line_of(const std::vector<double>& x_mm, const std::vector<double>& y_um) {
    MeasuredLine line{{}, y_um};
    for (const double x : x_mm)
        line.positions.push_back(x * 1000);
    return {line, *straightness_of(line)};
}

// Parabola of 8 um; B = -2 um; readings lie 0.5 um to either side of each mean: s = 1/sqrt 2.
TEST(StraightnessFigures, OfAParabolaBothWays) {
    StraightnessReadings readings{places(400, 5), {}, {}};
    for (const double y : parabola(8, 5)) {
        readings.forward_um.push_back({y - 1 - 0.5, y - 1 + 0.5});
        readings.backward_um.push_back({y + 1 - 0.5, y + 1 + 0.5});
    }
    const auto found = evaluate_straightness(readings);
    ASSERT_TRUE(found);
    for (const LineReference reference : references) {
        EXPECT_NEAR(found->mean.straightness_um(reference), 8, 1e-12);
        EXPECT_NEAR(found->forward.straightness_um(reference), 8, 1e-12);
        EXPECT_NEAR(found->backward->straightness_um(reference), 8, 1e-12);
    }
    EXPECT_NEAR(std::fabs(*found->reversal_um), 2, 1e-12);
    EXPECT_NEAR(*found->mean_reversal_um, -2, 1e-12);
    EXPECT_NEAR(*found->pooled_s_um, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(*found->repeatability_um, 4 * std::sqrt(0.5) + 2, 1e-12); // 2 s + 2 s + |B|
    EXPECT_EQ(found->readings_a_mean(), 4);
}

TEST(StraightnessFigures, OneWayWithOneReadingHasNoScatter) {
    StraightnessReadings readings{places(400, 5), {}, {}};
    for (const double y : parabola(8, 5))
        readings.forward_um.push_back({y});
    const auto found = evaluate_straightness(readings);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->backward);
    EXPECT_FALSE(found->reversal_um);
    EXPECT_FALSE(found->repeatability_um);
    EXPECT_FALSE(found->pooled_s_um);
    EXPECT_EQ(found->readings_a_mean(), 1);
}

TEST(StraightnessFigures, RefusesWhatIsNoLine) {
    EXPECT_EQ(evaluate_straightness({{0}, {{1}}, {}}).error().field, "targets");
    EXPECT_EQ(evaluate_straightness({{1, 0}, {{1}, {1}}, {}}).error().field, "targets[1]");
    EXPECT_EQ(evaluate_straightness({{0, 1}, {{1}, {std::nan("")}}, {}}).error().field,
              "forward[1][0]");
}

// A shift and a slope change nothing; the figure is homogeneous of degree one (Euler).
TEST(StraightnessLaws, SensitivityOfEveryReference) {
    std::mt19937_64 random{11};
    std::normal_distribution<double> deviation{0, 2};
    for (int trial = 0; trial < 300; ++trial) {
        const auto x = places(500, 9);
        std::vector<double> y;
        for (std::size_t i = 0; i < x.size(); ++i)
            y.push_back(deviation(random));
        const StraightnessLine line = line_of(x, y);
        for (const LineReference reference : references) {
            const auto w = sensitivity_of(line.line, line.against, reference);
            double sum = 0, moment = 0, product = 0;
            for (std::size_t i = 0; i < w.size(); ++i)
                sum += w[i], moment += w[i] * x[i], product += w[i] * y[i];
            EXPECT_NEAR(sum, 0, 1e-12);
            EXPECT_NEAR(moment, 0, 1e-9);
            EXPECT_NEAR(product, line.straightness_um(reference), 1e-7);
        }
    }
}

// Of a parabola with m odd: end points and zone rest on both ends and the middle (-1/2, 1, -1/2).
// Least squares: 2 - (L/2)^2 / Sxx with Sxx = d^2 m (m^2 - 1) / 12, so 2 - 3 (m - 1) / (m (m + 1)).
TEST(StraightnessSensitivity, OfAParabola) {
    const StraightnessLine line = line_of(places(1000, 11), parabola(5, 11));
    const auto squares = [&](LineReference reference) {
        return sum_of_squares(sensitivity_of(line.line, line.against, reference));
    };
    EXPECT_NEAR(squares(LineReference::end_points), 1.5, 1e-12);
    EXPECT_NEAR(squares(LineReference::minimum_zone), 1.5, 1e-8);
    EXPECT_NEAR(squares(LineReference::least_squares), 2 - 30.0 / 132, 1e-12);
    // Ten angles, each by itself: a random walk between tied ends has b^2 u^2 N / 4 at its middle.
    const auto g =
        sensitivity_to_steps(sensitivity_of(line.line, line.against, LineReference::end_points));
    ASSERT_EQ(g.size(), 10u);
    EXPECT_NEAR(sum_of_squares(g), 10.0 / 4, 1e-12);
}

StraightnessInputs wollaston() {
    StraightnessInputs in;
    in.factor_u = 0.01;
    in.mirror_limit_um_per_m2 = 0.15;
    in.resolution = 0.012;
    in.eve = 0.6;
    in.readings_a_mean = 10;
    return in;
}

TEST(StraightnessBudget, TermByTermOfAParabola) {
    const StraightnessLine line = line_of(places(2000, 11), parabola(5, 11));
    const auto budget = make_straightness_budget(line, wollaston());
    ASSERT_TRUE(budget);
    const auto& by_ends = budget->by_reference[0];
    ASSERT_EQ(by_ends.contributions.size(), 4u);
    const double root_3 = std::sqrt(3.0), spread = std::sqrt(1.5);
    EXPECT_NEAR(by_ends.contributions[0].u_um, 0.05, 1e-12);
    EXPECT_NEAR(by_ends.contributions[1].u_um, 0.15 * 4 / root_3, 1e-12);
    EXPECT_NEAR(by_ends.contributions[2].u_um, 0.012 / (2 * root_3) * spread, 1e-12);
    EXPECT_NEAR(by_ends.contributions[3].u_um, 0.6 / (2 * root_3) / std::sqrt(10.0) * spread,
                1e-12);
    const double squares = 0.0025 + 0.12 + 1.8e-5 + 0.0045;
    EXPECT_NEAR(*by_ends.expanded_um, 2 * std::sqrt(squares), 1e-12);
    EXPECT_FALSE(budget->by_scatter);
}

TEST(StraightnessBudget, ReversalLeavesNoMirrorAndAMissingTermNoU) {
    const StraightnessLine line = line_of(places(2000, 11), parabola(5, 11));
    StraightnessInputs in = wollaston();
    in.mirror_reversed = true;
    in.mirror_limit_um_per_m2.reset();
    EXPECT_TRUE(make_straightness_budget(line, in)->by_reference[1].expanded_um);
    in.mirror_reversed = false;
    const auto lacking = make_straightness_budget(line, in);
    EXPECT_FALSE(lacking->by_reference[1].expanded_um);
    EXPECT_EQ(lacking->not_stated, std::vector<std::string>{"mirror"});
    in.scatter = 1;
    EXPECT_TRUE(make_straightness_budget(line, in)->by_scatter);
    in.eve = -1;
    EXPECT_EQ(make_straightness_budget(line, in).error().field, "eve");
}

// Three points on a line: P = |N(0, 3/2 s^2)|, of mean s sqrt(1.5) sqrt(2/pi) and variance
// 1.5 s^2 (1 - 2/pi). High above the noise: s sqrt(1.5) and no bias.
TEST(StraightnessTrials, ALineAsStraightAsItsNoiseIsBiased) {
    constexpr int trials = 100'000;
    const double sigma = std::sqrt(1.5), share = 2 / std::numbers::pi;
    const auto flat = try_straightness(line_of(places(100, 3), {0, 0, 0}).line, {1, 0}, trials, 1);
    ASSERT_TRUE(flat);
    EXPECT_NEAR(flat->by_reference[0].mean_um, sigma * std::sqrt(share), 0.01);
    EXPECT_NEAR(flat->by_reference[0].u_um, sigma * std::sqrt(1 - share), 0.01);
    const auto high = try_straightness(line_of(places(100, 3), {0, 50, 0}).line, {1, 0}, trials, 1);
    EXPECT_NEAR(high->by_reference[0].mean_um, 50, 0.02);
    EXPECT_NEAR(high->by_reference[0].u_um, sigma, 0.015);
    // Two steps of 1 um each: the middle against the chord has (s1 - s2) / 2.
    const auto walk = try_straightness(line_of(places(100, 3), {0, 50, 0}).line, {0, 1}, trials, 2);
    EXPECT_NEAR(walk->by_reference[0].u_um, std::sqrt(0.5), 0.01);
}

// 1 / (2 sin(angle / 2)) = 36 where sin(angle / 2) = 1 / 72.
TEST(StraightnessOptics, FactorOfThePrism) {
    EXPECT_NEAR(*wollaston_factor(2 * std::asin(1.0 / 72)), 36, 1e-12);
    EXPECT_NEAR(*wollaston_factor(2 * std::asin(1.0 / 720)), 360, 1e-9);
    EXPECT_EQ(wollaston_factor(1).error().field, "angle");
    StraightnessSetup setup;
    setup.sign = -1;
    EXPECT_NEAR(deviation_um_of(setup, um(1), 0), -36, 1e-12);
}

// The chord of a parabola over each step gives its nodes back; a constant angle is a slope.
TEST(AngleSteps, IntegrateEachRunByItself) {
    const auto y = parabola(6, 11); // um at 0, 100 ... 1000 mm
    AngleReadings angles;
    for (std::size_t i = 0; i + 1 < y.size(); ++i) {
        const double angle = (y[i + 1] - y[i]) * 1e-3 / 100;
        angles.targets_mm.push_back(100.0 * static_cast<double>(i));
        angles.forward_rad.push_back({angle, angle + 1e-5});
    }
    const auto line = integrated(angles, 100);
    ASSERT_TRUE(line);
    ASSERT_EQ(line->targets_mm.size(), 11u);
    EXPECT_NEAR(line->forward_um[5][0], 6, 1e-9);
    EXPECT_NEAR(line->forward_um[10][1], 1e-5 * 1e6, 1e-9); // 10 um over 1 m
    const auto found = evaluate_straightness(*line);
    EXPECT_NEAR(found->mean.straightness_um(LineReference::end_points), 6, 1e-9);
    angles.targets_mm[3] += 2;
    EXPECT_EQ(integrated(angles, 100).error().field, "targets[3]");
    EXPECT_EQ(integrated(angles, 0).error().field, "base");
}

} // namespace
} // namespace axiscal::straightness_figures_test

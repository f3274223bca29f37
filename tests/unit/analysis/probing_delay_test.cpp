// Probes whose latch is known: the truth is the simulated saw-tooth.

#include "analysis/probing/probing_delay.hpp"

#include "analysis/probing/tooth_period.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace axiscal::probing_delay_test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Probe {
    double feed_mm_per_ms = 0.008; ///< 480 mm/min
    double tick_ms = 8, phase_ms = 1.7, constant_ms = 2, surface_mm = 25;
    double noise_mm = 0;
    int sign = -1; ///< X = X_s - F (t0 + mod(phi - a / F, T)), or + along the direction
};

ProbingSeries
touched(const Probe& probe, const std::vector<double>& approach_mm, std::uint64_t seed = 1) {
    std::mt19937_64 random{seed};
    std::normal_distribution<double> noise{0, 1};
    ProbingSeries series;
    series.direction = {1, 0, 0};
    for (const double a : approach_mm) {
        const double since = probe.phase_ms - a / probe.feed_mm_per_ms;
        const double wait = since - probe.tick_ms * std::floor(since / probe.tick_ms);
        series.approach_mm.push_back(a);
        series.trigger_mm.push_back(probe.surface_mm +
                                    probe.sign * probe.feed_mm_per_ms * (probe.constant_ms + wait) +
                                    probe.noise_mm * noise(random));
    }
    return series;
}

std::vector<double> steps(double first, double step, int count) {
    std::vector<double> list;
    for (int i = 0; i < count; ++i)
        list.push_back(first + step * i);
    return list;
}

ProbingDelay evaluate(const ProbingSeries& series, double feed_mm_per_min = 480) {
    return evaluate_probing_delay({feed_mm_per_min, 1, {series}}).value().front();
}

TEST(ProbingDelay, FiveMillisecondsAt480AreFortyMicrometres) { // the source's example, slip mended
    ProbingSeries series;
    series.direction = {0, 0, -1};
    series.approach_mm = {5, 5};
    series.trigger_mm = {10, 10.040};
    const auto result = evaluate(series);
    EXPECT_NEAR(result.variation_mm, 0.040, 1e-14);
    EXPECT_NEAR(result.variation_ms, 5, 1e-11);
    series.trigger_mm = {10, 10.008};
    EXPECT_NEAR(evaluate(series).variation_ms, 1, 1e-11);
}

TEST(ProbingDelay, ClosedFormOfASmallSeries) { // 1, 2, 3 um about 2: s = 1 um
    ProbingSeries series;
    series.direction = {0, 2, 0};
    series.approach_mm = {1, 2, 3};
    series.trigger_mm = {0.001, 0.003, 0.002};
    const auto result = evaluate(series);
    EXPECT_NEAR(result.variation_mm, 0.002, 1e-18);
    EXPECT_NEAR(*result.standard_deviation_mm, 0.001, 1e-18);
    EXPECT_EQ(result.symbol, "E_TD,Y");
    EXPECT_EQ(result.unit_direction, (std::array<double, 3>{0, 1, 0}));
    EXPECT_FALSE(result.period_ms);
    EXPECT_FALSE(result.no_period.empty());
}

TEST(ProbingDelay, SeriesOfTheTextFindsItsCycle) { // F = 8 mm/s, T = 8 ms, delta = 6.4 um, K = 11
    for (const int sign : {-1, 1}) {
        Probe probe;
        probe.sign = sign;
        const auto result = evaluate(touched(probe, steps(5, 0.0064, 11)));
        ASSERT_TRUE(result.period_ms) << result.no_period;
        EXPECT_NEAR(*result.period_ms, 8, 1e-9);
        EXPECT_EQ(*result.tooth_slope, -sign);
        EXPECT_LE(result.variation_ms, 8);
        EXPECT_GE(result.variation_ms, 8 - 0.8); // one step short of a tooth at most
    }
}

TEST(ProbingDelay, VariationGrowsToTheTickWithTheNumberOfTouches) {
    const Probe probe;
    const double step = 0.064 * (std::sqrt(5.0) - 1) / 2; // never commensurate
    double before = 0;
    for (const int count : {5, 20, 100, 1000}) {
        const double now = evaluate(touched(probe, steps(3, step, count))).variation_ms;
        EXPECT_GE(now, before);
        EXPECT_LE(now, 8 + 1e-9);
        before = now;
    }
    EXPECT_GT(before, 8 - 0.03); // gaps of a golden sequence: below 3 T / count
}

TEST(ProbingDelayLaws, PeriodOfEveryPlannedSeriesIsFound) {
    std::mt19937_64 random{2};
    std::uniform_real_distribution<double> any{0, 1};
    for (int trial = 0; trial < 300; ++trial) {
        Probe probe;
        const double feed_mm_per_min = 30 + 3000 * any(random);
        probe.feed_mm_per_ms = feed_mm_per_min / 60000;
        probe.tick_ms = 0.5 + 12 * any(random);
        probe.phase_ms = 20 * any(random);
        probe.sign = trial % 2 == 0 ? 1 : -1;
        const double tooth = probe.feed_mm_per_ms * probe.tick_ms;
        // as the test is planned: steps of 0.1 to 0.3 of a tooth over two teeth or more
        const double step = tooth * (0.1 + 0.2 * any(random));
        const auto series = touched(probe, steps(2, step, 21 + trial % 20));
        const auto result = evaluate(series, feed_mm_per_min);
        ASSERT_TRUE(result.period_ms) << trial << " " << result.no_period;
        EXPECT_NEAR(*result.period_ms / probe.tick_ms, 1, 1e-9);
    }
}

TEST(ProbingDelayLaws, StatedUncertaintyOfThePeriodIsItsScatter) {
    double squares = 0;
    int found = 0;
    constexpr int trials = 400;
    for (int trial = 0; trial < trials; ++trial) {
        Probe probe;
        probe.noise_mm = 0.001; // 1 um on a tooth of 64 um
        probe.phase_ms = 0.02 * trial;
        const auto result =
            evaluate(touched(probe, steps(4, 0.0113, 25), 100u + static_cast<unsigned>(trial)));
        if (!result.period_ms) continue;
        ++found;
        const double z = (*result.period_ms - 8) / *result.period_standard_uncertainty_ms;
        squares += z * z;
    }
    EXPECT_GE(found, trials * 98 / 100);
    EXPECT_NEAR(squares / found, 23.0 / 21, 0.25); // t with 23 degrees; 400 draws scatter by 0.08
}

TEST(ProbingDelayLaws, NoiseAloneIsNoTooth) {
    int found = 0;
    std::mt19937_64 random{3};
    std::normal_distribution<double> noise{0, 0.002};
    for (int trial = 0; trial < 500; ++trial) {
        ProbingSeries series;
        series.direction = {1, 0, 0};
        series.approach_mm = steps(5, 0.0064, 6 + trial % 30);
        for (std::size_t i = 0; i < series.approach_mm.size(); ++i)
            series.trigger_mm.push_back(noise(random));
        found += evaluate(series).period_ms ? 1 : 0;
    }
    EXPECT_LE(found, 2); // the chance is bounded by 1e-3 a series
}

// The binary digits of pi, times the resolution of a latch: they know nothing of the distance.
TEST(ProbingDelay, TwoLevelsOfALatchAreNoTooth) {
    ProbingSeries series;
    series.direction = {1, 0, 0};
    series.approach_mm = steps(2, 0.0016, 11);
    for (const int digit : {1, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0})
        series.trigger_mm.push_back(1e-4 * digit);
    const auto result = evaluate(series);
    EXPECT_FALSE(result.period_ms);
    EXPECT_EQ(result.no_period,
              "the readings lie on 2 levels of their resolution: no saw-tooth stands out of so few");
    EXPECT_NEAR(result.variation_mm, 1e-4, 1e-18);
}

// Any latch rounds: noise of 0.4 of its step to a hundred, as #5061 of a Fanuc has 1 um and Klipper
// prints steps of 12.5 um.
TEST(ProbingDelayLaws, NoiseThatALatchRoundsIsNoTooth) {
    int found = 0;
    std::mt19937_64 random{4};
    std::normal_distribution<double> noise{0, 1};
    for (const double resolution_mm : {0.0001, 0.001, 0.0125})
        for (const double share : {0.4, 0.6, 1.0, 4.0, 100.0})
            for (int trial = 0; trial < 100; ++trial) {
                ProbingSeries series;
                series.direction = {1, 0, 0};
                series.approach_mm = steps(2, 0.0016, 11 + trial % 20);
                for (std::size_t i = 0; i < series.approach_mm.size(); ++i)
                    series.trigger_mm.push_back(resolution_mm * std::round(share * noise(random)));
                found += evaluate(series).period_ms ? 1 : 0;
            }
    EXPECT_LE(found, 5); // 1500 series of a chance below 1e-3
}

TEST(ProbingDelayLaws, ToothThatALatchRoundsIsFound) {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> any{0, 1};
    for (const double tick_ms : {1.0, 2.0, 4.0, 8.0})
        for (const double resolution_mm : {0.0001, 0.001})
            for (int trial = 0; trial < 50; ++trial) {
                Probe probe;
                probe.tick_ms = tick_ms;
                probe.phase_ms = 20 * any(random);
                const double tooth_mm = probe.feed_mm_per_ms * tick_ms;
                auto series = touched(probe, steps(2, tooth_mm / 10, 21));
                for (double& reading : series.trigger_mm)
                    reading = resolution_mm * std::round(reading / resolution_mm);
                const auto result = evaluate(series);
                ASSERT_TRUE(result.period_ms) << tick_ms << " " << result.no_period;
                EXPECT_NEAR(*result.period_ms, tick_ms, 0.02 * tick_ms);
            }
}

TEST(ProbingDelayLaws, ShiftOfTheFaceOrTheStartChangesNothing) {
    Probe probe;
    const auto approach = steps(5, 0.0071, 20);
    const auto before = evaluate(touched(probe, approach));
    probe.surface_mm += 100;
    probe.constant_ms += 3;
    const auto after = evaluate(touched(probe, approach));
    EXPECT_NEAR(before.variation_mm, after.variation_mm, 1e-13);
    EXPECT_NEAR(*before.period_ms, *after.period_ms, 1e-9);
}

TEST(ProbingDelay, SaysWhyAPeriodIsNotFound) {
    const Probe probe;
    const auto reason = [&](const std::vector<double>& approach) {
        const auto result = evaluate(touched(probe, approach));
        EXPECT_FALSE(result.period_ms);
        return result.no_period;
    };
    EXPECT_EQ(reason({1, 2, 3}), "fewer than 5 readings");
    EXPECT_EQ(reason(std::vector<double>(8, 3.0)), "the readings do not vary");
    EXPECT_NE(reason(steps(5.01, 0.001, 8)).find("one flank"), std::string::npos);
    // a step of exactly one tooth always meets the same place
    EXPECT_EQ(reason(steps(5.003, 0.064, 12)), "the readings do not vary");
}

TEST(ProbingDelay, ReferenceSeriesGivesTheNetVariation) { // 3-4-5
    ProbingSeries moved, still;
    moved.direction = {3, 0, 4};
    still.direction = {0.6, 0, 0.8};
    moved.approach_mm = {1, 2};
    still.approach_mm = {2, 2};
    moved.trigger_mm = {0, 0.005};
    still.trigger_mm = {0, 0.003};
    still.reference = true;
    const auto results = evaluate_probing_delay({480, 1, {moved, still}}).value();
    EXPECT_EQ(results[0].symbol, "E_TD,XZ");
    EXPECT_EQ(results[1].symbol, "E_0,XZ");
    EXPECT_EQ(*results[0].reference_repeatability_mm, 0.003);
    EXPECT_NEAR(*results[0].net_variation_mm, 0.004, 1e-17);
    EXPECT_FALSE(results[1].net_variation_mm);
}

TEST(ProbingDelay, ReferenceOfAnotherDirectionIsNotUsed) {
    ProbingSeries moved, still;
    moved.direction = {1, 0, 0};
    still.direction = {-1, 0, 0};
    moved.approach_mm = {1, 2};
    still.approach_mm = {2, 2};
    moved.trigger_mm = still.trigger_mm = {0, 0.003};
    still.reference = true;
    const auto results = evaluate_probing_delay({480, 1, {moved, still}}).value();
    EXPECT_FALSE(results[0].reference_repeatability_mm);
}

TEST(ProbingDelayRefuses, WhatIsNoTest) {
    const ProbingSeries good = touched(Probe{}, steps(5, 0.0064, 11));
    const auto refused = [&](auto change) {
        ProbingDelayCase stated{480, 10, {good}};
        change(stated);
        const auto results = evaluate_probing_delay(stated);
        return results ? std::string{} : results.error().field;
    };
    EXPECT_EQ(refused([](auto&) {}), "");
    EXPECT_EQ(refused([](auto& c) { c.feed_mm_per_min = 0; }), "feed_mm_per_min");
    EXPECT_EQ(refused([](auto& c) { c.feed_mm_per_min = not_a_number; }), "feed_mm_per_min");
    EXPECT_EQ(refused([](auto& c) { c.series.clear(); }), "series");
    EXPECT_EQ(refused([](auto& c) { c.required_touches = 12; }), "series[0].trigger_mm");
    EXPECT_EQ(refused([](auto& c) { c.series[0].trigger_mm.clear(); }), "series[0].trigger_mm");
    EXPECT_EQ(refused([](auto& c) { c.series[0].approach_mm.pop_back(); }),
              "series[0].approach_mm");
    EXPECT_EQ(refused([](auto& c) { c.series[0].trigger_mm[2] = not_a_number; }),
              "series[0].trigger_mm[2]");
    EXPECT_EQ(refused([](auto& c) { c.series[0].direction = {0, 0, 0}; }), "series[0].direction");
    EXPECT_EQ(refused([](auto& c) { c.series[0].reference = true; }), "series[0].approach_mm");
}

TEST(ToothPeriod, CoarseStepsOverManyTeethAreFoundOrRefusedNeverWrong) {
    std::mt19937_64 random{4};
    std::uniform_real_distribution<double> any{0, 1};
    int found = 0;
    for (int trial = 0; trial < 300; ++trial) {
        Probe probe;
        probe.phase_ms = 8 * any(random);
        std::vector<double> approach;
        for (int i = 0; i < 25; ++i)
            approach.push_back(5 + 1.5 * any(random)); // 23 teeth wide, at random
        const ProbingSeries series = touched(probe, approach);
        const auto tooth = find_tooth(series.approach_mm, series.trigger_mm);
        if (!tooth) continue;
        ++found;
        EXPECT_NEAR(tooth->period, 0.064, 1e-12);
    }
    EXPECT_GT(found, 270);
}

} // namespace
} // namespace axiscal::probing_delay_test

// Laws that hold for every table, over seeded random ones.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "reference_data.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace axiscal::positioning_laws_test {
namespace {

using test::Rows;

struct Table {
    std::vector<double> targets;
    Rows forward, backward;
};

/// m targets 100 apart, n approaches: a slope, a reversal and noise, all of order 0.01.
Table random_table(std::mt19937_64& random) {
    const auto m = std::uniform_int_distribution<std::size_t>{1, 20}(random);
    const auto n = std::uniform_int_distribution<std::size_t>{2, 8}(random);
    std::normal_distribution<double> noise{0, 0.01};
    Table table;
    for (std::size_t i = 0; i < m; ++i) {
        table.targets.push_back(100.0 * static_cast<double>(i));
        const double mean = noise(random), reversal = noise(random);
        auto& up = table.forward.emplace_back(n);
        auto& down = table.backward.emplace_back(n);
        for (double& x : up)
            x = mean + noise(random) / 3;
        for (double& x : down)
            x = mean - reversal + noise(random) / 3;
    }
    return table;
}

/// Largest minus smallest of the means of the rows.
double range_of_means(const Rows& rows) {
    std::vector<double> means;
    for (const auto& row : rows)
        means.push_back(std::accumulate(row.begin(), row.end(), 0.0) /
                        static_cast<double>(row.size()));
    const auto [low, high] = std::ranges::minmax(means);
    return high - low;
}

PositioningResult evaluate(const Table& table) {
    return evaluate_positioning(test::at_20C(table.targets, table.forward, table.backward));
}

std::vector<double> figures_of(const PositioningParameters& p) {
    return {*p.A, *p.A_forward, *p.A_backward, *p.E,          *p.E_forward, *p.E_backward,
            *p.M, *p.R,         *p.R_forward,  *p.R_backward, *p.B,         *p.B_mean};
}

template <class Change> Table changed(Table table, Change change) {
    for (Rows* rows : {&table.forward, &table.backward})
        for (auto& row : *rows)
            for (double& x : row)
                change(x);
    return table;
}

class PositioningLaws : public testing::Test {
protected:
    std::mt19937_64 random{20260101};
    static constexpr int trials = 300;
    /// Deviations of order 0.01 with about 20 roundings of 1e-18 each.
    static constexpr double rounding = 1e-15;
};

TEST_F(PositioningLaws, InequalitiesBetweenTheFigures) {
    for (int trial = 0; trial < trials; ++trial) {
        const Table table = random_table(random);
        const auto p = evaluate(table).parameters;
        EXPECT_GE(*p.E + rounding, std::max(*p.E_forward, *p.E_backward));
        EXPECT_NEAR(*p.E_forward, range_of_means(table.forward), rounding);
        EXPECT_NEAR(*p.E_backward, range_of_means(table.backward), rounding);
        EXPECT_LE(*p.M, *p.E + rounding);
        EXPECT_GE(*p.A + rounding, *p.E);
        EXPECT_GE(*p.A, std::max(*p.A_forward, *p.A_backward));
        EXPECT_GE(*p.R, std::max(*p.R_forward, *p.R_backward));
        EXPECT_GE(*p.R, *p.B);
        EXPECT_GE(*p.B + rounding, std::fabs(*p.B_mean));
    }
}

TEST_F(PositioningLaws, ConstantAddedToEveryReadingChangesNothing) {
    for (int trial = 0; trial < trials; ++trial) {
        const Table table = random_table(random);
        const auto before = figures_of(evaluate(table).parameters);
        const auto after =
            figures_of(evaluate(changed(table, [](double& x) { x += 8; })).parameters);
        // adding 8 rounds each reading to 1e-15; s at n = 2 amplifies that by 4 k
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_NEAR(before[i], after[i], 3e-14);
    }
}

TEST_F(PositioningLaws, PowerOfTwoScalesEveryFigureExactly) {
    for (int trial = 0; trial < trials; ++trial) {
        const Table table = random_table(random);
        const auto before = figures_of(evaluate(table).parameters);
        const auto after =
            figures_of(evaluate(changed(table, [](double& x) { x *= 1024; })).parameters);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_EQ(before[i] * 1024, after[i]);
    }
}

TEST_F(PositioningLaws, SwappedDirectionsFlipOnlyTheSignOfTheMeanReversal) {
    for (int trial = 0; trial < trials; ++trial) {
        const Table table = random_table(random);
        const auto p = evaluate(table).parameters;
        const auto q = evaluate({table.targets, table.backward, table.forward}).parameters;
        EXPECT_EQ(*p.A, *q.A);
        EXPECT_EQ(*p.E, *q.E);
        EXPECT_EQ(*p.M, *q.M);
        EXPECT_EQ(*p.R, *q.R);
        EXPECT_EQ(*p.B, *q.B);
        EXPECT_EQ(*p.B_mean, -*q.B_mean);
        EXPECT_EQ(*p.A_forward, *q.A_backward);
        EXPECT_EQ(*p.R_backward, *q.R_forward);
    }
}

TEST_F(PositioningLaws, OrderOfTheApproachesDoesNotMatter) {
    for (int trial = 0; trial < trials; ++trial) {
        Table table = random_table(random);
        const auto before = figures_of(evaluate(table).parameters);
        for (auto& row : table.forward)
            std::ranges::shuffle(row, random);
        for (auto& row : table.backward)
            std::ranges::shuffle(row, random);
        const auto after = figures_of(evaluate(table).parameters);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_NEAR(before[i], after[i], rounding);
    }
}

TEST_F(PositioningLaws, OrderOfTheTargetsDoesNotMatter) {
    for (int trial = 0; trial < trials; ++trial) {
        Table table = random_table(random);
        const auto before = figures_of(evaluate(table).parameters);
        std::ranges::reverse(table.targets);
        std::ranges::reverse(table.forward);
        std::ranges::reverse(table.backward);
        const auto after = figures_of(evaluate(table).parameters);
        for (std::size_t i = 0; i + 1 < before.size(); ++i)
            EXPECT_EQ(before[i], after[i]);
        EXPECT_NEAR(before.back(), after.back(), rounding);
    }
}

TEST_F(PositioningLaws, EqualReadingsHaveNoSpreadAndTheirOwnMean) {
    std::uniform_real_distribution<double> any{-1000, 1000};
    for (int trial = 0; trial < trials; ++trial) {
        const double up = any(random), down = any(random);
        const auto result =
            evaluate({{0}, {std::vector<double>(7, up)}, {std::vector<double>(7, down)}});
        EXPECT_EQ(result.positions[0].mean_forward, up);
        EXPECT_EQ(*result.parameters.R_forward, 0);
        EXPECT_EQ(*result.parameters.R, *result.parameters.B);
        EXPECT_EQ(*result.parameters.A, *result.parameters.E);
    }
}

TEST_F(PositioningLaws, LongCoordinateCostsNoDigitsOfTheSpread) {
    // 1, 2, 3 nm steps on a coordinate of 2^20 um: exact in doubles, s must be exact too
    const double base = 1048576;
    const auto result = evaluate({{0}, {{base + 0.25, base + 0.5, base + 0.75}}, {{0, 0, 0}}});
    EXPECT_EQ(*result.positions[0].s_forward, 0.25);
}

} // namespace
} // namespace axiscal::positioning_laws_test

// Limits by travel band, and what is said of a figure.

#include "analysis/positioning/tolerances.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::tolerances_test {
namespace {

const std::vector<ToleranceLimit> bands{{"A", 500, 22}, {"A", 800, 25}, {"A", 1250, 32},
                                        {"B", {}, 10},  {"M", {}, 9},   {"M", 500, 5}};

TEST(LimitFor, TakesTheSmallestBandThatHoldsTheTravel) {
    EXPECT_EQ(limit_for(bands, "A", 1)->limit, 22);
    EXPECT_EQ(limit_for(bands, "A", 500)->limit, 22);
    EXPECT_EQ(limit_for(bands, "A", 500.1)->limit, 25);
    EXPECT_EQ(limit_for(bands, "A", 1250)->limit, 32);
    EXPECT_EQ(limit_for(bands, "A", 1251), nullptr);
    EXPECT_EQ(limit_for(bands, "B", 1e6)->limit, 10);
    EXPECT_EQ(limit_for(bands, "M", 400)->limit, 5);
    EXPECT_EQ(limit_for(bands, "M", 600)->limit, 9);
    EXPECT_EQ(limit_for(bands, "Q", 1), nullptr);
}

TEST(LimitFor, OrderOfTheBandsDoesNotMatter) {
    std::mt19937_64 random{5};
    auto shuffled = bands;
    for (int trial = 0; trial < 100; ++trial) {
        std::ranges::shuffle(shuffled, random);
        for (const double travel : {100.0, 500.0, 700.0, 1250.0, 2000.0})
            for (const char* parameter : {"A", "B", "M"}) {
                const auto* one = limit_for(bands, parameter, travel);
                const auto* other = limit_for(shuffled, parameter, travel);
                ASSERT_EQ(one == nullptr, other == nullptr);
                if (one) {
                    EXPECT_EQ(one->limit, other->limit);
                }
            }
    }
}

JudgedFigure judged(const FigureToJudge& figure, double travel = 400) {
    const auto all = judge_figures(bands, {figure}, travel);
    return *std::ranges::find(all, figure.parameter, &JudgedFigure::parameter);
}

TEST(JudgeFigures, WithUncertaintyTheVerdictIsThatOfIso14253) {
    EXPECT_EQ(judged({"A", 20, 2}).verdict, "pass"); // 20 = 22 - 2 still passes
    EXPECT_EQ(judged({"A", 20.1, 2}).verdict, "not_provable");
    EXPECT_EQ(judged({"A", 24, 2}).verdict, "not_provable");
    EXPECT_EQ(judged({"A", 24.1, 2}).verdict, "fail");
    EXPECT_EQ(judged({"A", 24.1, 2}).comparison, "beyond_limit");
    EXPECT_TRUE(judged({"A", 24.1, 2}).reason.empty());
}

TEST(JudgeFigures, WithoutUncertaintyOnlyTheNumbersAreCompared) {
    const auto within = judged({"A", 22, {}});
    EXPECT_EQ(within.verdict, "not_evaluated");
    EXPECT_EQ(within.comparison, "within_limit");
    EXPECT_EQ(within.reason, "U not evaluated");
    EXPECT_EQ(judged({"A", 22.1, {}}).comparison, "beyond_limit");
}

TEST(JudgeFigures, SignedFigureIsJudgedByItsMagnitude) {
    EXPECT_EQ(judged({"B", -11, 0.5}).verdict, "fail");
    EXPECT_EQ(judged({"B", -9, 0.5}).verdict, "pass");
    EXPECT_EQ(judged({"B", -9, 0.5}).value, -9);
}

TEST(JudgeFigures, SaysWhyThereIsNoVerdict) {
    EXPECT_EQ(judged({"A", {}, {}}).reason, "the figure was not evaluated");
    EXPECT_EQ(judged({"A", 5, 1}, 5000).reason, "the travel is longer than every band");
    EXPECT_TRUE(judged({"A", 5, 1}, 5000).comparison.empty());
    // a parameter that the result does not have at all
    EXPECT_EQ(judge_figures(bands, {}, 400)[1].reason, "the figure was not evaluated");
}

TEST(JudgeFigures, GivesOneVerdictAParameterInTheOrderOfTheSet) {
    const auto all = judge_figures(bands, {{"M", 1, {}}, {"A", 1, {}}, {"E", 1, {}}}, 400);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].parameter, "A");
    EXPECT_EQ(all[1].parameter, "B");
    EXPECT_EQ(all[2].parameter, "M");
}

} // namespace
} // namespace axiscal::tolerances_test

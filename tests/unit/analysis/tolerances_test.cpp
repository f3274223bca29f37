// Limits by travel band, and what is said of a figure.

#include "analysis/conformity/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

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

JudgedFigure judged(const FigureToJudge& figure,
                    double travel = 400,
                    DecisionRule rule = DecisionRule::guard_U) {
    const auto all = judge_figures(bands, {figure}, travel, rule);
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

TEST(JudgeFigures, WithoutARuleNothingIsDecided) {
    const auto undecided = judged({"A", 1, 0.1}, 400, DecisionRule::none);
    EXPECT_EQ(undecided.verdict, "not_evaluated");
    EXPECT_EQ(undecided.comparison, "within_limit");
    EXPECT_EQ(undecided.reason, "no decision rule is stated");
    EXPECT_FALSE(undecided.guard_band);
}

TEST(JudgeFigures, TheSimpleRuleTakesTheBareNumbers) {
    for (const std::optional<double> U : {std::optional<double>{}, std::optional{3.0}}) {
        const auto at_limit = judged({"A", 22, U}, 400, DecisionRule::simple);
        EXPECT_EQ(at_limit.verdict, "pass");
        EXPECT_EQ(at_limit.guard_band, 0);
        EXPECT_EQ(judged({"A", 22.001, U}, 400, DecisionRule::simple).verdict, "fail");
    }
}

/// Probability that a normal figure lies below the limit, by the error function.
double probability_of_conformity(double value, double limit, double u) {
    return 0.5 * std::erfc((value - limit) / (u * std::sqrt(2.0)));
}

TEST(JudgeFigures, TheRuleOf2017ProvesWithAProbabilityOf95Percent) {
    const double limit = 22;
    for (const double coverage : {2.0, 3.0}) {
        for (int i = 0; i <= 200; ++i) {
            const FigureToJudge figure{"A", 18 + 0.04 * i, 2.0, coverage};
            const double probability =
                probability_of_conformity(*figure.value, limit, 2.0 / coverage);
            const std::string_view wanted = probability >= 0.95   ? "pass"
                                            : probability <= 0.05 ? "fail"
                                                                  : "not_provable";
            EXPECT_EQ(judged(figure, 400, DecisionRule::iso_14253_1_2017).verdict, wanted)
                << *figure.value << " k " << coverage;
        }
    }
}

TEST(OverallVerdict, IsThatOfTheWorstFigure) {
    const auto of = [](const std::vector<FigureToJudge>& figures) {
        return overall_verdict(
            judge_figures({{"A", {}, 22}, {"B", {}, 10}}, figures, 400, DecisionRule::guard_U));
    };
    EXPECT_EQ(of({{"A", 1, 1}, {"B", 1, 1}}), "pass");
    EXPECT_EQ(of({{"A", 1, 1}, {"B", 1, {}}}), "not_evaluated");
    EXPECT_EQ(of({{"A", 22, 1}, {"B", 1, {}}}), "not_provable");
    EXPECT_EQ(of({{"A", 22, 1}, {"B", 12, 1}}), "fail");
    EXPECT_EQ(overall_verdict({}), "");
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
    EXPECT_EQ(judge_figures(bands, {}, 400, DecisionRule::guard_U)[1].reason,
              "the figure was not evaluated");
}

TEST(JudgeFigures, GivesOneVerdictAParameterInTheOrderOfTheSet) {
    const auto all = judge_figures(bands, {{"M", 1, {}}, {"A", 1, {}}, {"E", 1, {}}}, 400,
                                   DecisionRule::guard_U);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].parameter, "A");
    EXPECT_EQ(all[1].parameter, "B");
    EXPECT_EQ(all[2].parameter, "M");
}

} // namespace
} // namespace axiscal::tolerances_test

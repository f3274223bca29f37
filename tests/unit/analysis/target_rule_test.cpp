// ISO 230-2:2014, 4.3: counts, intervals, the random part.

#include "analysis/positioning/target_rule.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::target_rule_test {
namespace {

TargetQuestion linear(std::vector<double> targets, int approaches = 5) {
    return {AxisKind::linear, std::move(targets), {}, {}, approaches};
}

TargetQuestion rotary(std::vector<double> targets, int approaches = 5) {
    return {AxisKind::rotary, std::move(targets), {}, {}, approaches};
}

bool mentions(const std::vector<std::string>& sentences, const std::string& words) {
    return std::ranges::any_of(sentences, [&](const std::string& sentence) {
        return sentence.find(words) != std::string::npos;
    });
}

std::vector<double> even(double interval, int count, double first = 0) {
    std::vector<double> targets;
    for (int i = 0; i < count; ++i)
        targets.push_back(first + interval * i);
    return targets;
}

TEST(TargetRule, CountsFollowTheTravel) {
    const auto least = [](AxisKind kind, double travel) {
        return target_rule_for(kind, travel).least_targets;
    };
    EXPECT_EQ(least(AxisKind::linear, 5), 5);
    EXPECT_EQ(least(AxisKind::linear, 1000), 5);
    EXPECT_EQ(least(AxisKind::linear, 1000.1), 6);
    EXPECT_EQ(least(AxisKind::linear, 1200), 6);
    EXPECT_EQ(least(AxisKind::linear, 2000), 10);
    EXPECT_EQ(least(AxisKind::rotary, 90), 3);
    EXPECT_EQ(least(AxisKind::rotary, 90.1), 5);
    EXPECT_EQ(least(AxisKind::rotary, 180), 5);
    EXPECT_EQ(least(AxisKind::rotary, 180.1), 8);
    EXPECT_EQ(least(AxisKind::rotary, 360), 8);
}

TEST(TargetRule, LongAxesAreRuledByTheirMeanIntervalAndOneApproach) {
    const TargetRule linear_rule = target_rule_for(AxisKind::linear, 2000.1);
    EXPECT_TRUE(linear_rule.long_axis);
    EXPECT_EQ(linear_rule.largest_mean_interval, 250);
    EXPECT_EQ(linear_rule.approaches, 1);
    const TargetRule turns = target_rule_for(AxisKind::rotary, 1800);
    EXPECT_EQ(turns.largest_mean_interval, 45);
    EXPECT_EQ(turns.approaches, 1);
    EXPECT_FALSE(target_rule_for(AxisKind::linear, 2000).largest_mean_interval);
    EXPECT_EQ(target_rule_for(AxisKind::rotary, 360).largest_mean_interval, 45);
}

TEST(TargetRule, TooFewTargetsBreakIt) {
    EXPECT_TRUE(judge_targets(linear(even(100, 5)))->kept());
    const auto four = judge_targets(linear(even(100, 4))).value();
    EXPECT_TRUE(mentions(four.breaches, "at least 5"));
    auto stated = linear(even(200, 6));
    stated.travel = 1201;
    EXPECT_TRUE(mentions(judge_targets(stated)->breaches, "at least 7"));
}

TEST(TargetRule, FewerApproachesBreakItAndMoreOnALongAxisAreTold) {
    EXPECT_TRUE(mentions(judge_targets(linear(even(100, 5), 3))->breaches, "3 approaches"));
    EXPECT_TRUE(judge_targets(linear(even(250, 11), 1))->kept());
    const auto five = judge_targets(linear(even(250, 11), 5)).value();
    EXPECT_TRUE(five.kept());
    EXPECT_TRUE(mentions(five.remarks, "one approach"));
}

TEST(TargetRule, WideMeanIntervalBreaksIt) {
    EXPECT_TRUE(mentions(judge_targets(linear(even(251, 11), 1))->breaches, "exceeds 250 mm"));
    EXPECT_TRUE(judge_targets(rotary(even(45, 9)))->kept());
    EXPECT_TRUE(mentions(judge_targets(rotary(even(51, 8)))->breaches, "exceeds 45 degrees"));
}

TEST(TargetRule, RandomPartOfTheEvenestGridIsFound) {
    // r = +-25, +-10 about 0, 100, ..., 400: any other grid leaves more (checked by scanning below)
    const auto finding = judge_targets(linear({25, 75, 225, 275, 425})).value();
    ASSERT_TRUE(finding.grid);
    EXPECT_NEAR(finding.grid->random_share, 0.25, 1e-9);
    EXPECT_NEAR(finding.grid->interval, 100, 1e-6);
    EXPECT_TRUE(finding.kept());
}

TEST(TargetRule, TargetsThatStrayTooFarBreakIt) {
    const auto finding = judge_targets(linear({40, 60, 240, 260, 440})).value();
    EXPECT_NEAR(finding.grid->random_share, 0.4, 1e-9);
    EXPECT_TRUE(mentions(finding.breaches, "at most 30 %"));
    auto stated = linear(even(100, 5));
    stated.interval = 110;
    // P_i - 110 i is 0, -10, ..., -40: half of that a begin leaves, 20 of 110
    EXPECT_NEAR(judge_targets(stated)->grid->random_share, 20.0 / 110, 1e-15);
}

TEST(TargetRule, EvenTargetsAreToldOnALinearAxis) {
    EXPECT_TRUE(mentions(judge_targets(linear(even(100, 5)))->remarks, "stand evenly"));
    EXPECT_FALSE(mentions(judge_targets(rotary(even(45, 9)))->remarks, "stand evenly"));
    EXPECT_TRUE(judge_targets(linear({3, 96, 207, 291, 402}))->remarks.empty());
}

TEST(TargetRule, PrincipalPositionsThatAreMissingAreTold) {
    const auto finding = judge_targets(rotary({0, 40, 85, 130, 180, 225, 270, 315, 359})).value();
    EXPECT_TRUE(mentions(finding.remarks, "positions 90 degrees"));
    EXPECT_FALSE(mentions(judge_targets(rotary(even(45, 9)))->remarks, "principal"));
}

TEST(TargetRule, RefusesTravelsThatTheTargetsLeave) {
    auto question = linear(even(100, 5));
    question.travel = 399;
    EXPECT_EQ(judge_targets(question).error().field, "travel");
    question.travel = 400;
    EXPECT_TRUE(judge_targets(question));
    question.interval = 0;
    EXPECT_EQ(judge_targets(question).error().field, "interval");
}

// ---- laws -----------------------------------------------------------------------------------

TEST(TargetRuleLaws, DrawnTargetsAlwaysKeepTheRuleAndNoGridIsEvener) {
    std::mt19937_64 random{4303};
    std::uniform_real_distribution<double> part{-0.3, 0.3}, other{0.6, 1.6};
    for (int trial = 0; trial < 300; ++trial) {
        const int count = std::uniform_int_distribution<int>{5, 40}(random);
        auto targets = even(100, count, 17);
        for (double& target : targets)
            target += 100 * part(random);
        std::ranges::shuffle(targets, random);
        const auto finding = judge_targets(linear(targets)).value();
        EXPECT_LE(finding.grid->random_share, 0.3 + 1e-9);
        EXPECT_FALSE(mentions(finding.breaches, "stray"));
        std::ranges::sort(targets);
        for (int k = 0; k < 50; ++k)
            EXPECT_GE(grid_of(targets, finding.grid->interval * other(random)).random_share,
                      finding.grid->random_share - 1e-9);
    }
}

TEST(TargetRuleLaws, ShiftAndDirectionOfTheAxisDoNotMatter) {
    std::mt19937_64 random{4304};
    std::uniform_real_distribution<double> place{0, 900};
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<double> targets, moved, turned;
        for (int i = 0; i < 7; ++i) {
            targets.push_back(place(random));
            moved.push_back(targets.back() + 512);
            turned.push_back(-targets.back());
        }
        const auto finding = judge_targets(linear(targets)).value();
        for (const auto& others : {moved, turned}) {
            const auto same = judge_targets(linear(others)).value();
            EXPECT_EQ(same.breaches.size(), finding.breaches.size());
            EXPECT_NEAR(same.grid->random_share, finding.grid->random_share, 1e-8);
        }
    }
}

} // namespace
} // namespace axiscal::target_rule_test

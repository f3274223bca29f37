// Targets of a rotary axis by ISO 230-2:2014, 4.3.4, and what can be measured beside an artefact.
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/principal_positions.hpp"
#include "acquisition/run/rotary_plan.hpp"
#include "analysis/positioning/target_rule.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::rotary_plan_test {
namespace {

CycleConfig full_turn_axis() {
    CycleConfig config;
    config.axis_kind = AxisKind::rotary;
    config.travel_low = -1.0_mm; // degrees
    config.travel_high = 361.0_mm;
    config.overrun = 1.0_mm;
    config.interval = 30.0_mm;
    return config;
}

RunPlan the_plan(const CycleConfig& config, std::uint64_t seed = 1) {
    const auto plans = plan_passes(config, seed);
    if (!plans) {
        ADD_FAILURE() << describe(plans.error());
        return {};
    }
    EXPECT_EQ(plans->size(), 1U);
    return plans->front();
}

bool holds(const RunPlan& plan, double degrees) {
    return std::ranges::any_of(plan.targets,
                               [&](Length target) { return abs(target - mm(degrees)) < 1.0_nm; });
}

TEST(RotaryTargets, HoldThePrincipalPositionsAndStayRandomBetweenThem) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const RunPlan plan = the_plan(full_turn_axis(), seed);
        for (const double principal : {0.0, 90.0, 180.0, 270.0})
            EXPECT_TRUE(holds(plan, principal)) << seed << " " << principal;
        EXPECT_EQ(plan.remark, "");
        std::vector<double> degrees;
        int random = 0;
        for (const Length target : plan.targets) {
            degrees.push_back(target.in(mm));
            if (std::abs(std::remainder(target.in(mm), 30)) > 1e-6) ++random;
        }
        EXPECT_GE(random, 6) << seed;
        const auto finding =
            judge_targets({AxisKind::rotary, degrees, 360.0, 30.0, plan.approaches});
        ASSERT_TRUE(finding) << describe(finding.error());
        EXPECT_TRUE(finding->kept()) << seed << " " << finding->breaches.front();
    }
}

TEST(RotaryTargets, OfOneTurnBetweenTheOverrunsAreApproachedFiveTimes) {
    EXPECT_EQ(the_plan(full_turn_axis()).approaches, 5);
    CycleConfig wider = full_turn_axis();
    wider.travel_high = 363.0_mm;
    EXPECT_EQ(the_plan(wider).approaches, 1);
}

TEST(RotaryTargets, OfAPartOfATurnHoldWhatTheyReachOver) {
    CycleConfig config = full_turn_axis();
    config.travel_low = -4.0_mm;
    config.travel_high = 100.0_mm;
    config.interval = 22.0_mm;
    const RunPlan plan = the_plan(config);
    EXPECT_TRUE(holds(plan, 0));
    EXPECT_TRUE(holds(plan, 90));
    EXPECT_GE(plan.targets.size(), 5U); // more than 90 degrees: five
}

TEST(RotaryTargets, PrincipalPositionsThatAreLeftOutAreNamed) {
    CycleConfig config = full_turn_axis();
    config.interval.reset();
    config.targets = std::vector<Length>{};
    for (const double degrees : {0.0, 40.0, 90.0, 130.0, 175.0, 220.0, 270.0, 310.0, 350.0})
        config.targets->push_back(mm(degrees));
    EXPECT_EQ(the_plan(config).remark, "No target stands at the principal positions 180 degrees.");
}

TEST(RotaryTargets, AMeanIntervalAbove45DegreesIsRefused) {
    CycleConfig config = full_turn_axis();
    config.interval.reset();
    config.targets = std::vector<Length>{};
    for (int i = 0; i < 8; ++i)
        config.targets->push_back(mm(51.0 * i));
    const auto plans = plan_passes(config, 1);
    ASSERT_FALSE(plans);
    EXPECT_EQ(plans.error().field, "interval");
    EXPECT_NE(plans.error().detail.find("exceeds 45 degree"), std::string::npos);
}

TEST(PrincipalPositions, AreMultiplesOfAQuarterTurn) {
    for (const double degrees : {0.0, 90.0, -90.0, 360.0, 450.0})
        EXPECT_TRUE(is_principal_position(mm(degrees))) << degrees;
    EXPECT_FALSE(is_principal_position(mm(90.001)));
}

// 90 degrees are 10 beside the grid 0, 20, 40 ... and 0.3 p are 6: there none is taken.
TEST(PrincipalPositions, AreTakenByTheNearestPlaceWithinItsRandomPart) {
    std::vector<Length> targets;
    for (int i = 0; i < 10; ++i)
        targets.push_back(mm(20 * i + 3));
    take_principal_positions(targets, mm(0), mm(20), mm(0), mm(190));
    EXPECT_EQ(targets[0], mm(0));
    EXPECT_EQ(targets[4], mm(83));
    EXPECT_EQ(targets[9], mm(180));
    EXPECT_EQ(missing_principal_positions(targets, mm(0), mm(190)), "90");
}

RotarySetup table_of(double step_deg, double range_deg = 10) {
    RotarySetup setup;
    setup.step_deg = step_deg;
    setup.arm = mm(32.61);
    setup.range_deg = range_deg;
    return setup;
}

RunPlan plan_with(double overrun_deg, double tolerance_deg) {
    RunPlan plan;
    plan.axis_kind = AxisKind::rotary;
    plan.targets = {mm(0), mm(45), mm(90)};
    plan.overrun = mm(overrun_deg);
    plan.near_tolerance = mm(tolerance_deg);
    return plan;
}

TEST(RotaryPlan, TheWholeApproachLiesInTheRangeOfTheInterferometer) {
    // half a step of 5 and an overrun of 7 are 9.5, 95 % of the range
    EXPECT_TRUE(check_rotary_plan(plan_with(7, 0.5), table_of(5)));
    const auto beyond = check_rotary_plan(plan_with(7.1, 0.5), table_of(5));
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().field, "cycle.overrun");
    EXPECT_NE(beyond.error().detail.find("9.6 deg"), std::string::npos) << beyond.error().detail;
}

TEST(RotaryPlan, ATableOneStepOffMustNotPassTheNearCheck) {
    EXPECT_TRUE(check_rotary_plan(plan_with(1, 0.5), table_of(1)));
    const auto wide = check_rotary_plan(plan_with(1, 0.51), table_of(1));
    ASSERT_FALSE(wide);
    EXPECT_EQ(wide.error().field, "cycle.near_tolerance");
}

TEST(RotaryPlan, TargetsOfAPolygonStandAtItsFaces) {
    RotarySetup polygon = table_of(45);
    polygon.method = AngleMethod::polygon;
    RunPlan plan = plan_with(2, 0.05);
    EXPECT_TRUE(check_rotary_plan(plan, polygon));
    plan.targets.push_back(mm(100));
    const auto between = check_rotary_plan(plan, polygon);
    ASSERT_FALSE(between);
    EXPECT_NE(between.error().detail.find("100 deg lies between two faces"), std::string::npos);
}

} // namespace
} // namespace axiscal::rotary_plan_test

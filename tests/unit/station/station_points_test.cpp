// The durable points that the station shows, and what a restart leaves of them.
#include "tests/unit/station/station_bench.hpp"
#include "tests/unit/station/straightness_bench.hpp"

namespace axiscal::testing::station_points_test {
namespace {

class StationPoints : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static RevisionRequest of_first(const PlannedPoint& point) {
        RevisionRequest request;
        request.selection = {point.target_index, point.direction, point.approach};
        request.reason = "somebody leaned on the table";
        return request;
    }
    Shop shop;
};

TEST_F(StationPoints, AreNoneBeforeTheFirstRun) {
    Life life{shop};
    EXPECT_EQ(life.station->points(0).run_id, "");
    EXPECT_EQ(life.station->points(0).count, 0U);
}

TEST_F(StationPoints, GrowWithTheRunAndStayAfterARestart) {
    PointsView before;
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        life.run(10s); // older than what a restart counts again
        for (int step = 0; step < 6; ++step) {
            ASSERT_TRUE(life.take(step));
            EXPECT_EQ(life.station->points(0).count, static_cast<std::size_t>(step + 1));
        }
        before = life.station->points(0);
        EXPECT_EQ(life.station->points(4).points.size(), 2U);
        EXPECT_EQ(life.station->points(4).points.front().step, 4);
        EXPECT_TRUE(life.station->points(7).points.empty());
    }
    shop.now += 20s;
    Life life{shop};
    const PointsView after = life.station->points(0);
    EXPECT_EQ(after.run_id, before.run_id);
    ASSERT_EQ(after.count, 6U);
    for (std::size_t nth = 0; nth < after.count; ++nth) {
        EXPECT_EQ(after.points.at(nth).step, before.points.at(nth).step);
        EXPECT_EQ(after.points.at(nth).sequence, before.points.at(nth).sequence);
        EXPECT_EQ(after.points.at(nth).deviation, before.points.at(nth).deviation);
    }
}

TEST_F(StationPoints, BearTheNominalPositionAndTheTargetsComeWithAllOfThem) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const RunPlan plan = shop.plan();
    EXPECT_EQ(life.station->points(0).targets, plan.targets) << "before the first point";
    ASSERT_TRUE(life.take(0));
    const PlannedPoint first = plan.points.front();
    EXPECT_EQ(life.station->points(0).points.at(0).nominal,
              plan.targets.at(static_cast<std::size_t>(first.target_index)));
    EXPECT_TRUE(life.station->points(1).targets.empty());
}

TEST_F(StationPoints, AnExcludedOneSaysSoAndIsInNoFigureAfterARestartToo) {
    shop.config.cycle.approaches = 4;
    const PlannedPoint first = shop.plan().points.front();
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        life.run(10s);
        for (int step = 0; step < 6; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        EXPECT_EQ(life.station->points(0).excluded, 0U);
        const auto told = life.exclude(of_first(first));
        ASSERT_TRUE(told) << describe(told.error());
        EXPECT_EQ(life.station->points(0).excluded, 1U);
    }
    shop.now += 20s;
    Life life{shop};
    const PointsView shown = life.station->points(0);
    EXPECT_EQ(shown.excluded, 1U);
    ASSERT_EQ(shown.count, 6U);
    EXPECT_TRUE(shown.points.at(0).excluded);
    EXPECT_FALSE(shown.points.at(1).excluded);
    ASSERT_TRUE(shown.so_far);
    const TargetSoFar& target =
        shown.so_far->targets.at(static_cast<std::size_t>(first.target_index));
    EXPECT_EQ((first.direction == Direction::positive ? target.positive : target.negative).points,
              0);
}

TEST_F(StationPoints, TheFiguresSoFarBeginWithTheFirstPointAndAreComputedOnceForEach) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    EXPECT_FALSE(life.status().run->so_far);
    ASSERT_TRUE(life.take(0));
    const auto one = life.status().run->so_far;
    ASSERT_TRUE(one);
    EXPECT_EQ(life.status().run->so_far, one) << "the same object";
    EXPECT_EQ(life.station->points(0).so_far, one);
    const ShownPoint point = life.station->points(0).points.at(0);
    const auto& target = one->targets.at(static_cast<std::size_t>(point.planned.target_index));
    EXPECT_NEAR(target.positive.mean_um.value_or(target.negative.mean_um.value_or(1e9)),
                point.deviation.in(um), 1e-6);
    ASSERT_TRUE(life.take(1));
    EXPECT_NE(life.status().run->so_far, one);
}

TEST_F(StationPoints, TheFiguresStandBesideTheLimitsOfTheStationFile) {
    shop.config.tolerances.emplace();
    shop.config.tolerances->unit = "um";
    shop.config.tolerances->limits = {{"E", {}, 1e6}};
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    EXPECT_EQ(life.status().run->so_far->standing, Standing::not_judged);
    for (int step = 1; step < 10; ++step)
        ASSERT_TRUE(life.take(step));
    life.run(2s);
    const auto whole = life.status().run->so_far;
    ASSERT_TRUE(whole);
    ASSERT_EQ(whole->limits.size(), 1U);
    EXPECT_EQ(whole->standing, Standing::inside) << whole->sentence;
    EXPECT_EQ(whole->points_per_target, 1);
}

TEST(StationPointsOfStraightness, NothingIsClaimedOfTheFiguresBeforeItIsComplete) {
    StraightnessShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm(order_of_straightness()));
    ASSERT_TRUE(life.take(0));
    EXPECT_EQ(life.station->points(0).count, 1U);
    EXPECT_FALSE(life.status().run->so_far);
    EXPECT_FALSE(life.station->points(0).so_far);
}

TEST_F(StationPoints, AxisAndChannelsSayFromWhatAgeOnNothingIsShown) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const auto age_s = [&life] { return life.status().axis.age_s.value(); };
    EXPECT_EQ(life.status().axis.stale_after_s, 2.0);
    for (const ChannelView& channel : life.status().channels)
        EXPECT_EQ(channel.stale_after_s, channel.role == "axis" ? 2.0 : 60.0) << channel.name;
    life.laser->silent = true;
    life.run(1900ms);
    EXPECT_LT(age_s(), 2.0);
    EXPECT_TRUE(life.status().axis.displacement_mm);
    life.run(200ms);
    EXPECT_GT(age_s(), 2.0);
    EXPECT_FALSE(life.status().axis.displacement_mm);
}

} // namespace
} // namespace axiscal::testing::station_points_test

// The durable points that the station shows, and what a restart leaves of them.
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_points_test {
namespace {

class StationPoints : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
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

} // namespace
} // namespace axiscal::testing::station_points_test

#include "analysis/circle/circle_fit.hpp"
#include "tests/unit/analysis/circle_points.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace axiscal::minimum_zone_circle_test {
namespace {

using test::arc;
using test::listed;
using test::Points;
using test::points_of;

MinimumZoneCircle zone(const Points& points) {
    const auto circle = fit_minimum_zone_circle(points.x, points.y);
    EXPECT_TRUE(circle.has_value()) << circle.error().detail;
    return circle.value_or(MinimumZoneCircle{});
}

double largest_magnitude(const Points& points) {
    double largest = 0;
    for (const auto* values : {&points.x, &points.y})
        for (const double value : *values)
            largest = std::max(largest, std::fabs(value));
    return largest;
}

double width_about(const Points& points, double x, double y) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const double d = std::hypot(points.x[i] - x, points.y[i] - y);
        low = std::min(low, d);
        high = std::max(high, d);
    }
    return high - low;
}

/// About no centre near by is the ring narrower than by the gap.
void expect_gap_holds(const Points& points, const MinimumZoneCircle& c, double scale) {
    constexpr int directions = 8;
    for (const double way : {1e-9 * scale, 1e-6 * scale})
        for (int i = 0; i < directions; ++i) {
            const double angle = 2 * std::numbers::pi * i / directions;
            const double x = c.x + way * std::cos(angle), y = c.y + way * std::sin(angle);
            EXPECT_LE(c.width - c.gap, width_about(points, x, y) + 8e-15 * scale);
        }
}

void expect_certified(const Points& points, const MinimumZoneCircle& c) {
    const double scale = std::max(c.outer_radius, largest_magnitude(points));
    EXPECT_LE(c.gap, 1e-12 * scale);
    expect_gap_holds(points, c, scale);
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const double d = std::hypot(points.x[i] - c.x, points.y[i] - c.y);
        low = std::min(low, d);
        high = std::max(high, d);
    }
    EXPECT_NEAR(c.outer_radius, high, 2e-15 * scale);
    EXPECT_NEAR(c.inner_radius, low, 2e-15 * scale);
    EXPECT_NEAR(c.width, high - low, 4e-15 * scale);
    for (const ControlPoint& p : c.control_points)
        EXPECT_NEAR(std::hypot(points.x[p.index] - c.x, points.y[p.index] - c.y),
                    p.side == ZoneSide::outer ? high : low, 1e-12 * scale);
}

TEST(MinimumZoneCircle, IsNeverWiderThanTheThirdPartyProgramOnNistsSets) {
    const auto sets = test::reference_json("nist_circle2d.json").at("sets");
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const Points points = points_of(set.at("points"));
        const auto circle = zone(points);
        const double theirs = set.at("alglib_3_19").at("mzc_width").get<double>();
        EXPECT_LE(circle.width, theirs + 1e-13);
        EXPECT_GE(circle.width, theirs - 5e-9); // it stops at a tolerance of its own
        const auto& exhaustive = set.at("recomputed");
        if (exhaustive.contains("mzc_width_exhaustive")) {
            EXPECT_NEAR(circle.width, exhaustive.at("mzc_width_exhaustive").get<double>(), 1e-13);
        }
        expect_certified(points, circle);
        EXPECT_FALSE(circle.wide);
        EXPECT_FALSE(circle.strip);
    }
}

TEST(MinimumZoneCircle, HasTheWidthOfLobedCirclesInClosedForm) {
    const auto sets = test::reference_json("circles.json").at("sets");
    for (const auto& set : sets) {
        if (!set.contains("exact")) continue;
        SCOPED_TRACE(set.at("id"));
        const Points points = points_of(set.at("points"));
        const auto circle = zone(points);
        EXPECT_NEAR(circle.width, set.at("exact").at("mzc_width").get<double>(), 1e-13);
        EXPECT_NEAR(circle.x, set.at("exact").at("mzc")[0].get<double>(), 1e-13);
        EXPECT_NEAR(circle.y, set.at("exact").at("mzc")[1].get<double>(), 1e-13);
        expect_certified(points, circle);
    }
}

TEST(MinimumZoneCircle, FindsTheNarrowestZoneOfGandersPointsAndSaysThatItIsWide) {
    const Points points = listed({{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}});
    const auto circle = zone(points);
    EXPECT_NEAR(circle.width, 1.3536150616046267, 1e-13); // a local search stops at 1.3879
    EXPECT_TRUE(circle.wide);
    EXPECT_EQ(circle.search, ZoneSearch::exhaustive);
    expect_certified(points, circle);
}

TEST(MinimumZoneCircle, OfThreePointsHasNoWidth) {
    const Points points = listed({{0, 0}, {4, 0}, {0, 3}, {4, 0}});
    const auto circle = zone(points);
    EXPECT_EQ(circle.width, 0);
    EXPECT_EQ(circle.gap, 0);
    EXPECT_EQ(circle.outer_radius, circle.inner_radius);
    EXPECT_NEAR(circle.x, 2, 1e-14);
    EXPECT_NEAR(circle.y, 1.5, 1e-14);
    expect_certified(points, circle);
}

// The centre from the same doubles in exact rational arithmetic.
TEST(MinimumZoneCircle, MeetsAClosePairFarFromTheThirdPoint) {
    const std::vector<double> x{1000000001.0, 1000000000.8253356, 1000000000.3623577};
    const std::vector<double> y{-87251264.0, -999999999.4353576, -999999999.0679609};
    const auto zone = fit_minimum_zone_circle(x, y);
    const auto mean = fit_least_squares_circle(x, y);
    ASSERT_TRUE(zone && mean);
    for (const double center_x : {zone->x, mean->x})
        EXPECT_NEAR(center_x, 1362156481.894001, 1.0); // the last digit of the pair moves it by 100
    EXPECT_NEAR(zone->outer_radius, 582610401.7493112, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(std::hypot(x[i] - zone->x, y[i] - zone->y), zone->outer_radius, 1e-6);
        EXPECT_NEAR(std::hypot(x[i] - mean->x, y[i] - mean->y), mean->radius, 1e-6);
    }
}

TEST(MinimumZoneCircleRefuses, LinesAndFewerThanThreeDistinctPoints) {
    for (const Points& points :
         {listed({{0, 0}, {1, 1}, {5, 5}}), listed({{1, 2}, {3, 4}, {1, 2}}), Points{}}) {
        const auto circle = fit_minimum_zone_circle(points.x, points.y);
        ASSERT_FALSE(circle.has_value());
        EXPECT_EQ(circle.error().field, "points");
    }
}

TEST(BoundingCircles, AgreeWithTheThirdPartyProgramOnNistsSets) {
    const auto sets = test::reference_json("nist_circle2d.json").at("sets");
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const Points points = points_of(set.at("points"));
        const auto around = fit_minimum_circumscribed_circle(points.x, points.y);
        ASSERT_TRUE(around.has_value());
        const auto& theirs = set.at("alglib_3_19");
        EXPECT_NEAR(around->radius, theirs.at("mcc")[2].get<double>(), 5e-12);
        const auto inside = fit_maximum_inscribed_circle(points.x, points.y);
        EXPECT_EQ(inside.has_value(), set.at("arc_deg").get<double>() > 181);
        if (inside) {
            EXPECT_GE(inside->radius, theirs.at("mic")[2].get<double>() - 1e-12);
        }
    }
}

} // namespace
} // namespace axiscal::minimum_zone_circle_test

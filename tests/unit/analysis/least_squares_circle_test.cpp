#include "analysis/circle/circle_fit.hpp"
#include "tests/unit/analysis/circle_points.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace axiscal::least_squares_circle_test {
namespace {

using test::arc;
using test::listed;
using test::Points;
using test::points_of;

LeastSquaresCircle fit(const Points& points) {
    const auto circle = fit_least_squares_circle(points.x, points.y);
    EXPECT_TRUE(circle.has_value()) << circle.error().detail;
    return circle.value_or(LeastSquaresCircle{});
}

std::string refusal(const Points& points) {
    const auto circle = fit_least_squares_circle(points.x, points.y);
    EXPECT_FALSE(circle.has_value());
    return circle ? "" : circle.error().field + ": " + circle.error().detail;
}

TEST(LeastSquaresCircle, AgreesWithEveryReferencePairOfNist) {
    const auto sets = test::reference_json("nist_circle2d.json").at("sets");
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const auto circle = fit(points_of(set.at("points")));
        const auto& published = set.at("published_nist_lsc");
        EXPECT_NEAR(circle.x, published.at("c1").get<double>(), 1e-10);
        EXPECT_NEAR(circle.y, published.at("c2").get<double>(), 1e-10);
        EXPECT_NEAR(2 * circle.radius, published.at("diameter").get<double>(), 1e-10);
    }
}

TEST(LeastSquaresCircle, IsTheOrthogonalOneOnGandersPointsAndNotAnAlgebraicOne) {
    const auto circle = fit(listed({{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}}));
    EXPECT_NEAR(circle.x, 4.7398, 5e-5);
    EXPECT_NEAR(circle.y, 2.9835, 5e-5);
    EXPECT_NEAR(circle.radius, 4.7142, 5e-5);
}

TEST(LeastSquaresCircle, MeetsAPerfectCircleOnArcsOfAnyLength) {
    for (const double degrees : {360.0, 220.0, 90.0, 40.0, 10.0, 1.0, 0.1}) {
        SCOPED_TRACE(degrees);
        const auto circle = fit(arc(50, degrees, 17, 3, -4, 100));
        // what rounding of the coordinates does grows with (180 / arc)^2
        const double rounding = 1e-13 * std::max(1.0, std::pow(180 / degrees, 2));
        EXPECT_NEAR(circle.x, 3, 100 * rounding);
        EXPECT_NEAR(circle.y, -4, 100 * rounding);
        EXPECT_NEAR(circle.radius, 100, 100 * rounding);
    }
}

TEST(LeastSquaresCircle, ConditionIsTwoOnAFullCircleAndGrowsWithTheFourthPowerOfShortArcs) {
    EXPECT_NEAR(fit(arc(360, 360 - 1, 0, 1, 2, 5)).condition, 2, 1e-12);
    const double at_20 = fit(arc(401, 20, 0, 0, 0, 5)).condition;
    const double at_10 = fit(arc(401, 10, 0, 0, 0, 5)).condition;
    EXPECT_NEAR(at_10 / at_20, 16, 0.3);
    EXPECT_GT(at_20, 1e4);
}

/// The gradient of the sum of squares, which the definition asks to be zero.
double steepness_at(const Points& points, const LeastSquaresCircle& c) {
    double gx = 0, gy = 0, gr = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const double dx = points.x[i] - c.x, dy = points.y[i] - c.y, d = std::hypot(dx, dy);
        gx += (d - c.radius) * dx / d;
        gy += (d - c.radius) * dy / d;
        gr += d - c.radius;
    }
    const auto n = static_cast<double>(points.x.size());
    return std::max({std::fabs(gx), std::fabs(gy), std::fabs(gr)}) / n;
}

TEST(LeastSquaresCircle, IsStationaryOverRandomArcs) {
    std::mt19937_64 random{20};
    std::uniform_real_distribution<double> length{30, 360}, log_radius{-1, 3}, unit{0, 1};
    for (int trial = 0; trial < 2000; ++trial) {
        const double radius = std::pow(10, log_radius(random));
        const double x = radius * 5 * unit(random), y = -radius * 3 * unit(random);
        Points points = arc(5 + static_cast<std::size_t>(200 * unit(random)), length(random),
                            360 * unit(random), x, y, radius);
        test::add_noise(points, 1e-2 * radius * std::pow(unit(random), 4), random);
        EXPECT_LT(steepness_at(points, fit(points)), 1e-14 * (radius + std::hypot(x, y))) << trial;
    }
}

TEST(LeastSquaresCircle, FollowsShiftScaleAndPermutation) {
    std::mt19937_64 random{21};
    for (int trial = 0; trial < 200; ++trial) {
        Points points = arc(60, 300, 11.0 * trial, 1, 2, 10);
        test::add_noise(points, 0.05, random);
        const auto circle = fit(points);
        const auto shifted = fit(test::shuffled(test::mapped(points, 4, 1024, -512), random));
        EXPECT_NEAR(shifted.x, 4 * circle.x + 1024, 1e-11);
        EXPECT_NEAR(shifted.y, 4 * circle.y - 512, 1e-11);
        EXPECT_NEAR(shifted.radius, 4 * circle.radius, 1e-11);
        EXPECT_NEAR(shifted.condition, circle.condition, 1e-9);
    }
}

TEST(LeastSquaresCircle, ThreePointsAreMetExactly) {
    const auto circle = fit(listed({{0, 0}, {4, 0}, {0, 3}}));
    EXPECT_NEAR(circle.x, 2, 1e-15);
    EXPECT_NEAR(circle.y, 1.5, 1e-15);
    EXPECT_NEAR(circle.radius, 2.5, 1e-15);
    const auto twice = fit(listed({{0, 0}, {4, 0}, {0, 3}, {4, 0}, {4, 0}}));
    EXPECT_NEAR(twice.radius, 2.5, 1e-15);
}

TEST(LeastSquaresCircleRefuses, FewerThanThreeDistinctPointsAndLines) {
    EXPECT_EQ(refusal({}), "points: are missing; a circle needs three");
    EXPECT_EQ(refusal(listed({{1, 2}, {3, 4}, {1, 2}, {3, 4}})),
              "points: hold 2 distinct point(s); a circle needs three");
    for (const Points& line :
         {listed({{0, 0}, {1, 1}, {5, 5}}), listed({{0.1, 0.3}, {0.2, 0.6}, {0.7, 2.1}}),
          listed({{1e6, 1}, {1e6, 2}, {1e6, 7}, {1e6, 9}})})
        EXPECT_NE(refusal(line).find("line"), std::string::npos);
}

TEST(CircleFitsRefuse, PointsSoCloseThatTheirSquaresVanish) {
    const std::vector<double> x{1e-200, 0, -1e-200, 0}, y{0, 1e-200, 0, -2e-200};
    EXPECT_EQ(fit_least_squares_circle(x, y).error().field, "points");
    EXPECT_EQ(fit_minimum_zone_circle(x, y).error().field, "points");
    EXPECT_EQ(fit_minimum_circumscribed_circle(x, y).error().field, "points");
    EXPECT_EQ(fit_maximum_inscribed_circle(x, y).error().field, "points");
}

TEST(LeastSquaresCircleRefuses, WhatIsNotFiniteByItsPlace) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), -1e13}) {
        Points points = arc(20, 360, 0, 0, 0, 1);
        points.y[7] = bad;
        EXPECT_TRUE(refusal(points).starts_with("points[7]: ")) << bad;
    }
    Points uneven = arc(20, 360, 0, 0, 0, 1);
    uneven.x.pop_back();
    EXPECT_TRUE(refusal(uneven).starts_with("points: "));
}

TEST(ArcOfPoints, IsTheCircleWithoutTheLargestGap) {
    const auto sets = test::reference_json("nist_circle2d.json").at("sets");
    for (const auto& set : sets) {
        const Points points = points_of(set.at("points"));
        const auto circle = fit(points);
        EXPECT_NEAR(arc_of_points_deg(points.x, points.y, circle.x, circle.y),
                    set.at("arc_deg").get<double>(), 5e-4);
    }
    const Points turned = arc(51, 200, 170, 0, 0, 1); // across the seam of atan2
    EXPECT_NEAR(arc_of_points_deg(turned.x, turned.y, 0, 0), 200, 1e-12);
}

} // namespace
} // namespace axiscal::least_squares_circle_test

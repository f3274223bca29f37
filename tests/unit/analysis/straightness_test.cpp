#include "analysis/geometry/straightness.hpp"

#include "analysis/geometry/squareness.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::straightness_test {
namespace {

/// y = 4 h x (L - x) / L^2 at m equal steps.
MeasuredLine parabola(double h, double L, int m) {
    MeasuredLine line;
    for (int i = 0; i < m; ++i) {
        const double x = L * i / (m - 1);
        line.positions.push_back(x);
        line.deviations.push_back(4 * h * x * (L - x) / (L * L));
    }
    return line;
}

TEST(Straightness, ParabolaHasItsHeightByEveryReference) {
    for (const int m : {3, 5, 11, 101, 1001}) {
        const auto found = straightness_of(parabola(8, 400, m));
        EXPECT_NEAR(found->end_points.straightness, 8, 1e-14);
        EXPECT_NEAR(found->least_squares.straightness, 8, 1e-13);
        EXPECT_NEAR(found->minimum_zone.line.straightness, 8, 1e-14);
        EXPECT_NEAR(found->least_squares.slope, 0, 1e-15);
        // mean of the samples: 2 h / 3 times (m - 2) / (m - 1)
        EXPECT_NEAR(found->least_squares.offset, 16.0 / 3 * (m - 2) / (m - 1), 1e-12);
        EXPECT_NEAR(found->minimum_zone.line.offset, 4, 1e-14);
        EXPECT_LE(std::fabs(found->minimum_zone.gap), 1e-14);
    }
}

MeasuredLine random_line(std::mt19937_64& random, int fewest = 3) {
    const auto count = std::uniform_int_distribution<int>{fewest, 30}(random);
    std::exponential_distribution<double> step{0.05};
    std::normal_distribution<double> deviation{0, 1};
    MeasuredLine line;
    double x = deviation(random) * 100;
    for (int i = 0; i < count; ++i) {
        line.positions.push_back(x += 0.5 + step(random));
        line.deviations.push_back(deviation(random));
    }
    return line;
}

/// Width between two lines parallel to the one through points i and j, perpendicular to it.
double width_along(const MeasuredLine& line, std::size_t i, std::size_t j) {
    const double dx = line.positions[j] - line.positions[i];
    const double dy = line.deviations[j] - line.deviations[i];
    double low = 0, high = 0;
    for (std::size_t k = 0; k < line.positions.size(); ++k) {
        const double beside = (dx * (line.deviations[k] - line.deviations[i]) -
                               dy * (line.positions[k] - line.positions[i])) /
                              std::hypot(dx, dy);
        low = std::min(low, beside);
        high = std::max(high, beside);
    }
    return high - low;
}

TEST(StraightnessLaws, MinimumZoneIsTheLeastOverAllPairsOfPoints) {
    std::mt19937_64 random{1};
    for (int trial = 0; trial < 1000; ++trial) {
        const MeasuredLine line = random_line(random);
        double least = 1e300;
        for (std::size_t i = 0; i < line.positions.size(); ++i)
            for (std::size_t j = i + 1; j < line.positions.size(); ++j)
                least = std::min(least, width_along(line, i, j));
        const auto zone = straightness_of(line)->minimum_zone;
        EXPECT_NEAR(zone.line.straightness, least, 1e-13);
        EXPECT_LE(std::fabs(zone.gap), 1e-13);
    }
}

TEST(StraightnessLaws, NoLineIsNarrowerThanTheMinimumZone) {
    std::mt19937_64 random{2};
    std::normal_distribution<double> turn{0, 0.05};
    for (int trial = 0; trial < 500; ++trial) {
        const MeasuredLine line = random_line(random);
        const auto found = straightness_of(line);
        const double least = found->minimum_zone.line.straightness;
        EXPECT_LE(least, found->end_points.straightness + 1e-13);
        EXPECT_LE(least, found->least_squares.straightness + 1e-13);
        for (int i = 0; i < 20; ++i) {
            const double slope = found->minimum_zone.line.slope + turn(random);
            double low = 1e300, high = -1e300;
            for (std::size_t k = 0; k < line.positions.size(); ++k) {
                const double beside =
                    (line.deviations[k] - slope * line.positions[k]) / std::sqrt(1 + slope * slope);
                low = std::min(low, beside);
                high = std::max(high, beside);
            }
            EXPECT_GE(high - low, least - 1e-12);
        }
    }
}

TEST(StraightnessLaws, ControlPointsAlternateAndLieOnTheTwoLines) {
    std::mt19937_64 random{3};
    for (int trial = 0; trial < 500; ++trial) {
        const auto zone = straightness_of(random_line(random))->minimum_zone;
        const auto& points = zone.control_points;
        ASSERT_EQ(points.size(), 3u);
        EXPECT_EQ(points[0].upper, points[2].upper);
        EXPECT_NE(points[0].upper, points[1].upper);
        EXPECT_LT(points[0].index, points[1].index);
        EXPECT_LT(points[1].index, points[2].index);
        for (const ZonePoint& point : points)
            EXPECT_NEAR(zone.line.residuals[point.index],
                        (point.upper ? 0.5 : -0.5) * zone.line.straightness, 1e-12);
    }
}

std::vector<double> figures_of(const MeasuredLine& line) {
    const auto found = straightness_of(line);
    return {found->end_points.straightness, found->least_squares.straightness,
            found->minimum_zone.line.straightness};
}

TEST(StraightnessLaws, ShiftMirrorAndScale) {
    std::mt19937_64 random{4};
    for (int trial = 0; trial < 300; ++trial) {
        const MeasuredLine line = random_line(random);
        MeasuredLine shifted = line, mirrored = line, scaled = line;
        for (double& x : shifted.positions)
            x += 1234;
        for (double& y : shifted.deviations)
            y -= 77;
        std::ranges::reverse(mirrored.positions);
        std::ranges::reverse(mirrored.deviations);
        for (double& x : mirrored.positions)
            x = -x;
        for (std::size_t i = 0; i < line.positions.size(); ++i)
            scaled.positions[i] *= -8, scaled.deviations[i] *= -8;
        std::ranges::reverse(scaled.positions);
        std::ranges::reverse(scaled.deviations);
        const auto expected = figures_of(line);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            EXPECT_NEAR(figures_of(shifted)[k], expected[k], 1e-11);
            EXPECT_NEAR(figures_of(mirrored)[k], expected[k], 1e-12);
            EXPECT_NEAR(figures_of(scaled)[k], 8 * expected[k], 1e-11);
        }
    }
}

TEST(StraightnessLaws, ATiltTurnsTheLineAndLeavesTheStraightness) {
    std::mt19937_64 random{5};
    for (int trial = 0; trial < 300; ++trial) {
        const MeasuredLine line = random_line(random);
        MeasuredLine sheared = line, turned = line;
        const double angle = 0.01, c = std::cos(angle), s = std::sin(angle);
        for (std::size_t i = 0; i < line.positions.size(); ++i) {
            const double x = line.positions[i], y = line.deviations[i];
            sheared.deviations[i] = y + 0.25 * x;
            turned.positions[i] = c * x - s * y;
            turned.deviations[i] = s * x + c * y;
        }
        const auto before = straightness_of(line);
        const auto after = straightness_of(sheared);
        EXPECT_NEAR(after->least_squares.straightness, before->least_squares.straightness, 1e-11);
        EXPECT_NEAR(after->least_squares.slope, before->least_squares.slope + 0.25, 1e-12);
        EXPECT_NEAR(after->end_points.straightness, before->end_points.straightness, 1e-11);
        if (!std::ranges::is_sorted(turned.positions)) continue;
        const auto rotated = straightness_of(turned);
        // a true rotation: the perpendicular width stays, the angle grows by it
        EXPECT_NEAR(rotated->minimum_zone.line.straightness, before->minimum_zone.line.straightness,
                    1e-11);
        EXPECT_NEAR(std::atan(rotated->minimum_zone.line.slope),
                    std::atan(before->minimum_zone.line.slope) + angle, 1e-11);
    }
}

TEST(Straightness, PointsOnALineAreStraight) {
    const MeasuredLine line{{0, 1, 2, 5}, {3, 5, 7, 13}};
    const auto found = straightness_of(line);
    for (const double width : figures_of(line))
        EXPECT_NEAR(width, 0, 1e-15);
    EXPECT_NEAR(found->minimum_zone.line.slope, 2, 1e-15);
    EXPECT_NEAR(found->minimum_zone.line.offset, 3, 1e-15);
    EXPECT_EQ(straightness_of({{0, 1}, {3, 5}})->minimum_zone.control_points.size(), 2u);
}

/// theta = d/dx of the parabola at the middle of each step: integration gives the parabola.
TEST(Straightness, AnglesIntegrateToTheLineThatMadeThem) {
    const double h = 5, L = 1000, base = 100;
    std::vector<double> angles;
    for (int i = 0; i < 10; ++i) {
        const double middle = base * (i + 0.5);
        angles.push_back(4 * h * (L - 2 * middle) / (L * L) + 3e-4); // and a constant angle
    }
    const auto line = line_of_angles(angles, base, 50);
    ASSERT_EQ(line->positions.size(), 11u);
    EXPECT_EQ(line->positions.front(), 50);
    EXPECT_EQ(line->positions.back(), 1050);
    const auto found = straightness_of(*line);
    EXPECT_NEAR(found->end_points.straightness, h, 1e-12);
    EXPECT_NEAR(found->end_points.slope, 3e-4, 1e-15);
    EXPECT_NEAR(found->minimum_zone.line.straightness, h, 1e-6); // h (1 - slope^2 / 2)
}

TEST(StraightnessRefuses, WhatIsNoLine) {
    const auto field = [](const MeasuredLine& line) { return straightness_of(line).error().field; };
    EXPECT_EQ(field({{}, {}}), "targets");
    EXPECT_EQ(field({{1}, {1}}), "targets");
    EXPECT_EQ(field({{1, 1}, {1, 1}}), "targets[1]");
    EXPECT_EQ(field({{1, 2}, {1}}), "deviations");
    EXPECT_EQ(field({{1, 2}, {1, std::nan("")}}), "deviations[1]");
    EXPECT_EQ(line_of_angles({}, 1, 0).error().field, "angles");
    EXPECT_EQ(line_of_angles({1}, 0, 0).error().field, "base");
}

// ---- squareness -----------------------------------------------------------------------------

/// A line along a direction that turns by `angle` towards the other axis.
SquarenessLine turned(double angle, double waviness, int sign = 1) {
    MeasuredLine line;
    for (int i = 0; i <= 20; ++i) {
        line.positions.push_back(25.0 * i);
        line.deviations.push_back(sign * (25.0 * i * std::tan(angle) + waviness * (i % 2)));
    }
    return {*straightness_of(line), sign};
}

TEST(Squareness, IsWhatTheTwoAxesCloseOrOpen) {
    const auto found = squareness_of(turned(30e-6, 0), turned(-70e-6, 0));
    EXPECT_NEAR(found.least_squares, 40e-6, 1e-16);
    EXPECT_NEAR(found.end_points, 40e-6, 1e-16);
    EXPECT_NEAR(found.minimum_zone, 40e-6, 1e-16);
    EXPECT_LE(found.method_spread, 1e-16);
    EXPECT_NEAR(squareness_of(turned(30e-6, 0), turned(-70e-6, 0), 5e-6).least_squares, 45e-6,
                1e-16);
    EXPECT_NEAR(squareness_of(turned(30e-6, 0, -1), turned(-70e-6, 0, -1)).least_squares, 40e-6,
                1e-16);
}

TEST(SquarenessLaws, OrderOfTheAxesAndSignOfBothSidesDoNotMatter) {
    std::mt19937_64 random{6};
    for (int trial = 0; trial < 200; ++trial) {
        const SquarenessLine a{*straightness_of(random_line(random)), 1};
        SquarenessLine b{*straightness_of(random_line(random)), 1};
        const Squareness one_way = squareness_of(a, b), other_way = squareness_of(b, a);
        EXPECT_NEAR(one_way.least_squares, other_way.least_squares, 1e-15);
        b.sign = -1;
        SquarenessLine c = a;
        c.sign = -1;
        EXPECT_NEAR(squareness_of(c, b).least_squares, -one_way.least_squares, 1e-15);
    }
}

TEST(SquarenessLaws, MethodsDifferByLessThanStraightnessOverLength) {
    std::mt19937_64 random{7};
    for (int trial = 0; trial < 300; ++trial) {
        const MeasuredLine first = random_line(random), second = random_line(random);
        double bound = 0;
        for (const auto& line : {first, second})
            bound += 3 * straightness_of(line)->end_points.straightness /
                     (line.positions.back() - line.positions.front());
        const auto found =
            squareness_of({*straightness_of(first), 1}, {*straightness_of(second), 1});
        EXPECT_LE(found.method_spread, bound);
    }
}

} // namespace
} // namespace axiscal::straightness_test

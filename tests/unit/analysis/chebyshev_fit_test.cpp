#include "analysis/separation/chebyshev_fit.hpp"
#include "analysis/separation/chebyshev_moments.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace axiscal::chebyshev_fit_test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// T_k(t) = cos(k arccos t): the definition, not the recurrence.
double first_kind_at(std::size_t k, double t) {
    return std::cos(static_cast<double>(k) * std::acos(t));
}
/// U_k(t) = sin((k + 1) w) / sin w, cos w = t.
double second_kind_at(std::size_t k, double t) {
    const double w = std::acos(t);
    return std::sin(static_cast<double>(k + 1) * w) / std::sin(w);
}

struct Points {
    std::vector<double> x, y;
};

Points random_points(std::size_t count, double from, double to, double noise = 0.3) {
    std::mt19937_64 random{count};
    std::uniform_real_distribution<double> any{from, to};
    std::normal_distribution<double> normal; // of no width it would be refused: noise may be 0
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        points.x.push_back(any(random));
        points.y.push_back(std::sin(points.x.back() / 7) + noise * normal(random));
    }
    return points;
}

double largest_of(const std::vector<double>& values) {
    double largest = 0;
    for (const double value : values)
        largest = std::max(largest, std::fabs(value));
    return largest;
}

TEST(ChebyshevBasis, SecondKindIsTheQuotientOfSines) {
    std::vector<double> values(21);
    for (const double t : {-0.99, -0.5, 0.0, 0.123, 0.7, 0.999}) {
        second_kind(t, values);
        for (std::size_t k = 0; k < values.size(); ++k)
            EXPECT_NEAR(values[k], second_kind_at(k, t), 1e-11); // arccos near 1 loses digits
    }
    second_kind(1, values);
    for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_EQ(values[k], static_cast<double>(k + 1)); // U_k(1) = k + 1
}

TEST(ChebyshevBasis, ConversionKeepsThePolynomial) {
    std::mt19937_64 random{3};
    std::normal_distribution<double> normal;
    for (std::size_t degree = 0; degree <= 12; ++degree) {
        std::vector<double> first(degree + 1);
        for (double& value : first)
            value = normal(random);
        const auto second = second_from_first_kind(first);
        for (const double t : {-0.9, -0.3, 0.2, 0.8}) {
            double a = 0, b = 0;
            for (std::size_t k = 0; k <= degree; ++k) {
                a += first[k] * first_kind_at(k, t);
                b += second[k] * second_kind_at(k, t);
            }
            EXPECT_NEAR(a, b, 1e-13);
        }
    }
}

TEST(ChebyshevMoments, AreTheSumsOfTheDefinition) {
    const Points points = random_points(1003, -3, 5); // not a multiple of eight
    const auto moments = chebyshev_moments(points.x, points.y, 12, -3, 5);
    ASSERT_EQ(moments.basis.size(), 25u);
    for (std::size_t k = 0; k < 25; ++k) {
        double basis = 0, right = 0;
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            const double value = first_kind_at(k, (points.x[i] - 1) / 4);
            basis += value;
            right += value * points.y[i];
        }
        EXPECT_NEAR(moments.basis[k], basis, 1e-10) << k; // 1003 cosines of angles up to 24 pi
        if (k <= 12) {
            EXPECT_NEAR(moments.right[k], right, 1e-10) << k;
        }
    }
}

TEST(ChebyshevFit, EqualsQrToTwelveDigits) {
    for (const std::size_t count : {20u, 1000u, 100001u})
        for (const std::size_t degree : {1u, 5u, 12u}) {
            const Points points = random_points(count, 0, 80);
            const auto fast = fit_chebyshev(points.x, points.y, degree, {0, 80}).value();
            const auto qr =
                fit_chebyshev(points.x, points.y, degree, {0, 80}, ChebyshevMethod::qr).value();
            EXPECT_TRUE(fast.by_moments || count == 20u);
            for (std::size_t k = 0; k <= degree; ++k)
                EXPECT_NEAR(fast.second_kind[k], qr.second_kind[k],
                            1e-12 * largest_of(qr.second_kind));
        }
}

TEST(ChebyshevFit, FindsTheCoefficientsOfAPolynomial) {
    std::mt19937_64 random{5};
    std::normal_distribution<double> normal;
    for (std::size_t degree = 1; degree <= 32; ++degree) {
        std::vector<double> truth(degree + 1);
        for (double& value : truth)
            value = normal(random);
        Points points = random_points(4000, -1, 1);
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            points.y[i] = 0;
            for (std::size_t k = 0; k <= degree; ++k)
                points.y[i] += truth[k] * first_kind_at(k, points.x[i]);
        }
        const auto fit = fit_chebyshev(points.x, points.y, degree, {-1, 1}).value();
        for (std::size_t k = 0; k <= degree; ++k)
            EXPECT_NEAR(fit.first_kind[k], truth[k], 1e-12) << degree;
        EXPECT_LT(residual_rms(fit, points.x, points.y), 1e-12);
    }
}

TEST(ChebyshevFit, GramOfChebyshevNodesHasConditionTwo) {
    // over n > 2 degree nodes the T_k are orthogonal, squares n for k = 0 and n / 2 for the others
    std::vector<double> x;
    for (int i = 0; i < 64; ++i)
        x.push_back(std::cos(std::numbers::pi * (i + 0.5) / 64));
    const auto fit = fit_chebyshev(x, std::vector<double>(64, 1.0), 12, {-1, 1}).value();
    EXPECT_NEAR(*fit.gram_condition, 2, 1e-12);
    EXPECT_NEAR(fit.first_kind[0], 1, 1e-14);
}

TEST(ChebyshevFit, FallsBackToQrByTheConditionNumber) {
    Points points = random_points(5000, 0, 10, 0);
    for (double& value : points.x)
        value /= 4; // a quarter of the range: degree 12 is nearly open there
    const auto fit = fit_chebyshev(points.x, points.y, 12, {0, 10}).value();
    EXPECT_FALSE(fit.by_moments);
    ASSERT_TRUE(fit.gram_condition);
    EXPECT_GT(*fit.gram_condition, 1e6);
}

TEST(ChebyshevFit, BetweenTheLimitsRefinementKeepsTheDigits) {
    Points points = random_points(5000, 1.6, 10, 1e-6);
    const auto fast = fit_chebyshev(points.x, points.y, 6, {0, 10}).value();
    const auto qr = fit_chebyshev(points.x, points.y, 6, {0, 10}, ChebyshevMethod::qr).value();
    EXPECT_TRUE(fast.by_moments);
    EXPECT_GT(*fast.gram_condition, 100);
    for (std::size_t k = 0; k <= 6; ++k)
        EXPECT_NEAR(fast.second_kind[k], qr.second_kind[k], 1e-12 * largest_of(qr.second_kind));
}

TEST(ChebyshevFit, TooFewPointsLeaveTheDegreeOpenAndAreMet) {
    const std::vector<double> x{-1, 0, 1}, y{2, -1, 4};
    const auto fit = fit_chebyshev(x, y, 5, {-1, 1}).value();
    EXPECT_FALSE(fit.by_moments);
    EXPECT_EQ(fit.rank, 3u);
    EXPECT_LT(residual_rms(fit, x, y), 1e-14);
}

TEST(ChebyshevFitLaws, OrderOfThePointsDoesNotMatter) {
    Points points = random_points(5000, 0, 10);
    const auto before = fit_chebyshev(points.x, points.y, 12, {0, 10}).value();
    std::ranges::reverse(points.x);
    std::ranges::reverse(points.y);
    const auto after = fit_chebyshev(points.x, points.y, 12, {0, 10}).value();
    for (std::size_t k = 0; k <= 12; ++k)
        EXPECT_NEAR(before.first_kind[k], after.first_kind[k], 1e-14);
}

TEST(ChebyshevFitRefuses, WhatIsNoFit) {
    const Points good = random_points(100, 0, 10);
    const auto refused = [&](auto change, std::size_t degree = 3, AxisRange range = {0, 10}) {
        Points points = good;
        change(points);
        const auto fit = fit_chebyshev(points.x, points.y, degree, range);
        return fit ? std::string{} : fit.error().field;
    };
    const auto nothing = [](Points&) {};
    EXPECT_EQ(refused(nothing), "");
    EXPECT_EQ(refused(nothing, 0), "degree");
    EXPECT_EQ(refused(nothing, 33), "degree");
    EXPECT_EQ(refused(nothing, 3, {10, 0}), "range");
    EXPECT_EQ(refused([](Points& p) { p.y.pop_back(); }), "y");
    EXPECT_EQ(refused([](Points& p) { p.x.clear(), p.y.clear(); }), "x");
    for (const std::size_t i : {7u, 98u}) { // in a lane, and in the rest
        const std::string index = "[" + std::to_string(i) + "]";
        EXPECT_EQ(refused([&](Points& p) { p.x[i] = 10.1; }), "x" + index);
        EXPECT_EQ(refused([&](Points& p) { p.x[i] = not_a_number; }), "x" + index);
        EXPECT_EQ(refused([&](Points& p) { p.x[i] = -infinity; }), "x" + index);
        EXPECT_EQ(refused([&](Points& p) { p.y[i] = not_a_number; }), "y" + index);
        EXPECT_EQ(refused([&](Points& p) { p.y[i] = 1e300; }), "y" + index);
        EXPECT_EQ(refused([&](Points& p) { p.y[i] = infinity; }), "y" + index);
    }
}

} // namespace
} // namespace axiscal::chebyshev_fit_test

// Least squares of any rank against what defines it, over seeded random matrices.

#include "analysis/separation/minimum_norm.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::minimum_norm_test {
namespace {

using Rows = std::vector<std::vector<double>>;

Rows random_rows(std::mt19937_64& random, std::size_t m, std::size_t n) {
    std::normal_distribution<double> normal;
    Rows rows(m, std::vector<double>(n));
    for (auto& row : rows)
        for (double& value : row)
            value = normal(random);
    return rows;
}

Triangle triangle_of(const Rows& rows, const std::vector<double>& values) {
    TriangleOfRows triangle{rows.front().size()};
    for (std::size_t i = 0; i < rows.size(); ++i)
        triangle.add(rows[i], values[i]);
    return triangle.finish();
}

std::vector<double> column_of(std::mt19937_64& random, std::size_t m) {
    return [&] {
        std::vector<double> values;
        for (const auto& row : random_rows(random, m, 1))
            values.push_back(row[0]);
        return values;
    }();
}

TEST(MinimumNorm, ResidualStandsPerpendicularToEveryColumn) {
    std::mt19937_64 random{1};
    for (int trial = 0; trial < 50; ++trial) {
        const std::size_t m = 12 + static_cast<std::size_t>(trial) * 7, n = 1 + m % 11;
        const Rows rows = random_rows(random, m, n);
        const auto values = column_of(random, m);
        const Triangle triangle = triangle_of(rows, values);
        const auto solution = solve_minimum_norm(triangle);
        EXPECT_EQ(solution.rank, n);
        std::vector<double> gradient(n);
        double squares = 0;
        for (std::size_t i = 0; i < m; ++i) {
            const double residual = values[i] - dot(rows[i], solution.coefficients);
            squares += residual * residual;
            for (std::size_t j = 0; j < n; ++j)
                gradient[j] += residual * rows[i][j];
        }
        for (const double g : gradient)
            EXPECT_NEAR(g, 0, 1e-11); // 400 products of order 1 with residuals good to 1e-14
        EXPECT_NEAR(triangle.remainder, squares, 1e-11 * (1 + squares));
    }
}

TEST(MinimumNorm, LeveragesAddUpToTheRank) { // trace of the hat matrix
    std::mt19937_64 random{2};
    Rows rows = random_rows(random, 40, 9);
    for (auto& row : rows)
        row[8] = row[0] - 2 * row[3]; // rank 8
    const auto solution = solve_minimum_norm(triangle_of(rows, column_of(random, 40)));
    EXPECT_EQ(solution.rank, 8u);
    double sum = 0;
    for (const auto& row : rows)
        sum += solution.leverage(row);
    EXPECT_NEAR(sum, 8, 1e-12);
}

TEST(MinimumNorm, RepeatedColumnGetsAnEvenSplit) { // the least norm of a + b = 2 is a = b = 1
    Rows rows;
    std::vector<double> values;
    for (int i = 1; i <= 5; ++i) {
        rows.push_back({1.0 * i, 1.0 * i});
        values.push_back(2.0 * i);
    }
    const auto solution = solve_minimum_norm(triangle_of(rows, values));
    EXPECT_EQ(solution.rank, 1u);
    EXPECT_NEAR(solution.coefficients[0], 1, 1e-15);
    EXPECT_NEAR(solution.coefficients[1], 1, 1e-15);
    EXPECT_EQ(*solution.condition, 1);
    // the dropped direction is (1, -1) / sqrt 2
    EXPECT_NEAR(std::fabs(solution.directions(0, 1)), std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(solution.directions(0, 1) + solution.directions(1, 1), 0, 1e-15);
}

TEST(MinimumNorm, FewerRowsThanColumnsAreMetExactlyByTheShortestVector) {
    std::mt19937_64 random{3};
    const Rows rows = random_rows(random, 4, 9);
    const auto values = column_of(random, 4);
    const auto solution = solve_minimum_norm(triangle_of(rows, values));
    EXPECT_EQ(solution.rank, 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(dot(rows[i], solution.coefficients), values[i], 1e-13);
    for (std::size_t j = 4; j < 9; ++j) // shortest: nothing along the dropped directions
        EXPECT_NEAR(dot(solution.directions.column(j), solution.coefficients), 0, 1e-13);
}

TEST(MinimumNorm, SingularValuesOfAKnownProductKeepTheirDigits) {
    // diag(1, 1e-7, 1e-14) between rotations by one angle: one-sided Jacobi keeps the small ones
    const double c = 0.6, s = 0.8;
    const std::vector<double> expected{1, 1e-7, 1e-14};
    Matrix matrix{3, 3}; // D times a rotation of its columns
    matrix(0, 0) = expected[0] * c, matrix(0, 1) = expected[0] * s;
    matrix(1, 0) = -expected[1] * s, matrix(1, 1) = expected[1] * c;
    matrix(2, 2) = expected[2];
    const auto parts = singular_values(matrix);
    for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(parts.values[j] / expected[j], 1, 1e-15 * 10) << j;
}

TEST(MinimumNorm, ZeroMatrixHasRankZeroAndNoCondition) {
    const auto solution = solve_minimum_norm(triangle_of({{0, 0}, {0, 0}}, {1, 2}));
    EXPECT_EQ(solution.rank, 0u);
    EXPECT_FALSE(solution.condition);
    EXPECT_EQ(solution.coefficients, (std::vector<double>{0, 0}));
}

TEST(MinimumNorm, ChosenColumnsAreTheProblemWithoutTheOthers) {
    std::mt19937_64 random{4};
    const Rows rows = random_rows(random, 150, 7);
    const auto values = column_of(random, 150);
    Rows fewer;
    for (const auto& row : rows)
        fewer.push_back({row[1], row[4], row[6]});
    const Triangle direct = triangle_of(fewer, values);
    const Triangle chosen =
        choose_columns(triangle_of(rows, values), std::vector<std::size_t>{1, 4, 6});
    EXPECT_NEAR(direct.remainder, chosen.remainder, 1e-12 * direct.remainder);
    const auto a = solve_minimum_norm(direct), b = solve_minimum_norm(chosen);
    for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(a.coefficients[j], b.coefficients[j], 1e-14);
}

} // namespace
} // namespace axiscal::minimum_norm_test

#include "analysis/circular/row_fit.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::circular::row_fit_test {
namespace {

using Rows = std::vector<std::vector<double>>;

LinearSolution fit(const Rows& rows, const std::vector<double>& right) {
    RowFit fit{rows.front().size()};
    for (std::size_t i = 0; i < rows.size(); ++i)
        fit.add(rows[i], right[i]);
    return fit.solve();
}

double product(const std::vector<double>& row, const std::vector<double>& x) {
    double sum = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
        sum += row[i] * x[i];
    return sum;
}

Rows random_rows(std::mt19937_64& random, std::size_t count, std::size_t width) {
    std::normal_distribution<double> normal;
    Rows rows(count, std::vector<double>(width));
    for (auto& row : rows)
        for (double& x : row)
            x = normal(random);
    return rows;
}

TEST(RowFit, FitsALineThroughThreePointsByItsClosedForm) {
    // y = 1, 2, 2 at 0, 1, 2: mean 5/3, slope 1/2, residuals -1/6, 1/3, -1/6
    const LinearSolution line = fit({{1, 0}, {1, 1}, {1, 2}}, {1, 2, 2});
    EXPECT_NEAR(line.value[0], 7.0 / 6, 1e-15);
    EXPECT_NEAR(line.value[1], 0.5, 1e-15);
    EXPECT_NEAR(line.residual_sum_of_squares, 1.0 / 6, 1e-15);
    // variance 1/6 of one degree of freedom times the inverse of {{3, 3}, {3, 5}}
    EXPECT_NEAR(line.covariance[0][0], 5.0 / 36, 1e-15);
    EXPECT_NEAR(line.covariance[1][1], 3.0 / 36, 1e-15);
    EXPECT_NEAR(line.covariance[0][1], -3.0 / 36, 1e-15);
    EXPECT_EQ(line.rank, 2);
    EXPECT_TRUE(line.tied.empty());
}

TEST(RowFit, ResidualsOfRandomRowsStandAtRightAnglesToEveryColumn) {
    std::mt19937_64 random{1};
    for (const std::size_t count : {20u, 256u, 257u, 1000u}) {
        const Rows rows = random_rows(random, count, 14);
        const std::vector<double> right = random_rows(random, 1, count).front();
        const LinearSolution found = fit(rows, right);
        double squares = 0;
        std::vector<double> projected(14, 0);
        for (std::size_t i = 0; i < count; ++i) {
            const double residual = right[i] - product(rows[i], found.value);
            squares += residual * residual;
            for (std::size_t k = 0; k < 14; ++k)
                projected[k] += residual * rows[i][k];
        }
        for (const double value : projected)
            EXPECT_NEAR(value, 0, 1e-11);
        EXPECT_NEAR(found.residual_sum_of_squares, squares, 1e-11 * squares);
    }
}

TEST(RowFit, KeepsItsDigitsWhereTheNormalEquationsLoseThem) {
    // columns 1 and 1 + 1e-7 t: condition 1e7, whose square leaves nothing of 16 digits
    std::mt19937_64 random{2};
    Rows rows = random_rows(random, 500, 2);
    std::vector<double> right;
    for (auto& row : rows) {
        row[0] = 1;
        row[1] = 1 + 1e-7 * row[1];
        right.push_back(3 * row[0] - 2 * row[1]);
    }
    const LinearSolution found = fit(rows, right);
    EXPECT_NEAR(found.value[0], 3, 1e-7);
    EXPECT_NEAR(found.value[1], -2, 1e-7);
    EXPECT_NEAR(found.condition, 2e7, 0.5e7);
}

TEST(RowFit, NamesTheColumnsThatReplaceEachOther) {
    std::mt19937_64 random{3};
    Rows rows = random_rows(random, 50, 6);
    std::vector<double> right;
    for (auto& row : rows) {
        row[2] = 3 * row[0];      // 0 and 2
        row[4] = 0;               // 4 alone
        row[5] = row[1] - row[3]; // 1, 3 and 5
        right.push_back(row[0] + row[1]);
    }
    const LinearSolution found = fit(rows, right);
    EXPECT_EQ(found.rank, 3);
    EXPECT_EQ(found.tied, (std::vector<std::vector<std::size_t>>{{0, 2}, {1, 3, 5}, {4}}));
    EXPECT_EQ(found.estimable, std::vector<bool>(6, false));
    EXPECT_NEAR(found.residual_sum_of_squares, 0, 1e-25);
    // what the tied ones make together is known
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_NEAR(product(rows[i], found.value), right[i], 1e-12);
}

TEST(RowFit, AColumnBesideTiedOnesKeepsItsValue) {
    std::mt19937_64 random{4};
    Rows rows = random_rows(random, 50, 3);
    std::vector<double> right;
    for (auto& row : rows) {
        row[1] = -row[0];
        right.push_back(row[0] + 5 * row[2]);
    }
    const LinearSolution found = fit(rows, right);
    EXPECT_EQ(found.estimable, (std::vector<bool>{false, false, true}));
    EXPECT_NEAR(found.value[2], 5, 1e-13);
}

TEST(RowFit, TwoFitsAddedAreOneFitOfAllRows) {
    std::mt19937_64 random{5};
    const Rows rows = random_rows(random, 600, 5);
    const std::vector<double> right = random_rows(random, 1, 600).front();
    RowFit first{5}, second{5};
    for (std::size_t i = 0; i < rows.size(); ++i)
        (i < 77 ? first : second).add(rows[i], right[i]);
    first.add_all_of(second);
    const LinearSolution sum = first.solve(), whole = fit(rows, right);
    EXPECT_EQ(sum.rows, 600);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(sum.value[k], whole.value[k], 1e-13);
        EXPECT_NEAR(sum.covariance[k][k], whole.covariance[k][k], 1e-14);
    }
}

TEST(RowFit, AWeightCountsAsRepeatedRows) {
    RowFit weighted{1}, repeated{1};
    const std::vector<double> row{1};
    weighted.add(row, 3, std::sqrt(4.0));
    weighted.add(row, 8);
    for (int i = 0; i < 4; ++i)
        repeated.add(row, 3);
    repeated.add(row, 8);
    EXPECT_NEAR(weighted.solve().value[0], 4, 1e-15);
    EXPECT_NEAR(repeated.solve().value[0], 4, 1e-15);
}

} // namespace
} // namespace axiscal::circular::row_fit_test

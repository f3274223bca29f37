#include "analysis/linear/dense_fit.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::dense_fit_test {
namespace {

TEST(ColumnFit, FitsALineThroughThreePointsByItsClosedForm) {
    // y = 1, 2, 2 at 0, 1, 2: mean 5/3, slope 1/2, residuals -1/6, 1/3, -1/6
    const ColumnFit line = fit_columns({{1, 1, 1}, {0, 1, 2}}, {1, 2, 2});
    EXPECT_NEAR(line.coefficients[0], 7.0 / 6, 1e-15);
    EXPECT_NEAR(line.coefficients[1], 0.5, 1e-15);
    EXPECT_NEAR(line.residuals[0], -1.0 / 6, 1e-15);
    EXPECT_NEAR(line.residuals[1], 1.0 / 3, 1e-15);
    EXPECT_NEAR(line.residuals[2], -1.0 / 6, 1e-15);
    // R of these columns: sqrt 3 and sqrt 2
    EXPECT_NEAR(line.condition, std::sqrt(1.5), 1e-15);
}

TEST(ColumnFit, SaysThatAColumnOfZerosCannotBeFitted) {
    const ColumnFit fit = fit_columns({{1, 1, 1}, {0, 0, 0}}, {1, 2, 4});
    EXPECT_TRUE(std::isinf(fit.condition));
    EXPECT_EQ(fit.coefficients, (std::vector<double>{0, 0}));
    EXPECT_EQ(fit.residuals, (std::vector<double>{1, 2, 4})) << "nothing is taken off";
}

TEST(ColumnFit, ResidualsOfRandomColumnsStandAtRightAnglesToEach) {
    std::mt19937_64 random{1};
    std::normal_distribution<double> normal;
    for (const std::size_t rows : {9u, 40u, 1000u}) {
        std::vector<std::vector<double>> columns(9, std::vector<double>(rows));
        std::vector<double> right(rows);
        for (auto& column : columns)
            for (double& value : column)
                value = normal(random);
        for (double& value : right)
            value = normal(random);
        const ColumnFit fit = fit_columns(columns, right);
        for (const auto& column : columns)
            EXPECT_NEAR(dot(column, fit.residuals), 0, 1e-11) << rows;
    }
}

TEST(LowerFactor, OfAMatrixThatWasMadeFromIt) {
    Matrix made{2, 2}; // L = {{2, 0}, {1, 3}}
    made(0, 0) = 4, made(1, 0) = 2, made(0, 1) = 2, made(1, 1) = 10;
    const auto lower = lower_factor(made);
    ASSERT_TRUE(lower);
    EXPECT_EQ(lower->values, (std::vector<double>{2, 1, 0, 3}));
    // x = (1, -1): right side (2, -8)
    EXPECT_EQ(solve_by_factor(*lower, {2, -8}), (std::vector<double>{1, -1}));
}

TEST(LowerFactor, ThereIsNoneOfAMatrixThatIsNotPositive) {
    Matrix flat{2, 2};
    flat(0, 0) = 1, flat(1, 0) = 2, flat(0, 1) = 2, flat(1, 1) = 1;
    EXPECT_FALSE(lower_factor(flat));
}

} // namespace
} // namespace axiscal::dense_fit_test

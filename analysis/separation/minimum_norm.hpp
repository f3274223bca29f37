#pragma once
// Least squares of any rank: rows come one by one, the coefficients of least norm go out. Pure.
//
// Householder QR over blocks of rows (only the triangle is kept, so a million rows cost no memory),
// then one-sided Jacobi on the triangle. Both use + - * / and sqrt in a fixed order: equal input
// gives equal bits on every compiler and CPU.

#include "analysis/separation/matrix.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

/// A = Q R with one right side: what least squares needs of A and b.
struct Triangle {
    Matrix upper;                  ///< R, n by n
    std::vector<double> projected; ///< the first n elements of Q^T b
    double remainder = 0;          ///< sum of squares of the others
    std::size_t rows = 0;          ///< rows that were added
};

class TriangleOfRows {
public:
    explicit TriangleOfRows(std::size_t columns);
    /// row: `columns` finite numbers; value: the right side.
    void add(std::span<const double> row, double value);
    [[nodiscard]] Triangle finish();

private:
    void fold();

    std::size_t columns_, filled_ = 0;
    Triangle triangle_;
    Matrix block_; ///< right side in the last column
};

/// The problem with only the stated columns; exact up to rounding.
Triangle choose_columns(const Triangle& whole, std::span<const std::size_t> columns);

/// A = U S V^T, singular values falling; columns of `left` are A v / s (zero where s is zero).
struct SingularValues {
    std::vector<double> values;
    Matrix left, right;
};
/// One-sided Jacobi (Hestenes); small singular values keep their digits.
SingularValues singular_values(const Matrix& matrix);

struct MinimumNormSolution {
    std::vector<double> coefficients;
    std::vector<double> singular_values; ///< n, falling
    Matrix directions;                   ///< V; columns from `rank` on are the dropped subspace
    std::size_t rank = 0;
    std::optional<double> condition; ///< largest over smallest kept; absent at rank 0

    /// h of a row: how much the fit at that row follows its own reading, 0 to 1.
    [[nodiscard]] double leverage(std::span<const double> row) const;
    /// Row and column of (A^T A)^+ : times the variance of a reading, the covariance of two
    /// coefficients. Says nothing about the dropped subspace.
    [[nodiscard]] double inverse_normal(std::size_t i, std::size_t j) const;
};

/// Singular values up to max(m, n) * 2^-52 * largest count as zero (the default of common pinv).
/// Accuracy: a few condition * 1e-16 of the norm of the coefficients.
MinimumNormSolution solve_minimum_norm(const Triangle& triangle);

} // namespace axiscal

#pragma once
// Least squares of any rank: the coefficients of least norm, by the singular values of the rows'
// triangle. Pure.

#include "analysis/linear/singular_values.hpp"
#include "analysis/linear/triangle.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

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

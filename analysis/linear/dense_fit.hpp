#pragma once
// Small dense systems, solved by Eigen: up to some 40 columns. Pure. Programs are compiled for the
// baseline of their architecture, and products so large that Eigen divides them by the size of the
// processor's caches do not occur: equal input gives equal bits on all of its processors.

#include "analysis/linear/matrix.hpp"

#include <optional>
#include <vector>

namespace axiscal {

struct ColumnFit {
    std::vector<double> coefficients; ///< one a column
    std::vector<double> residuals;    ///< right side - fit
    /// Largest over smallest diagonal of R: a lower bound of the condition number, within a factor
    /// of the column count for few columns. The columns count as they are: the caller brings them
    /// to like magnitudes. Infinite where a column depends on the others; the coefficients are
    /// then 0.
    double condition = 1;
};

/// Linear least squares by Householder's QR. At least one column, all of equal length, at least as
/// long as there are columns; the relative error of the coefficients is about 1e-16 times the
/// condition number.
ColumnFit fit_columns(const std::vector<std::vector<double>>& columns,
                      const std::vector<double>& right_side);

/// L of a symmetric matrix L L^T, of which the lower triangle is read (Cholesky); nothing where it
/// is not positive definite.
std::optional<Matrix> lower_factor(const Matrix& symmetric);
/// x of L L^T x = right.
std::vector<double> solve_by_factor(const Matrix& lower, const std::vector<double>& right);

} // namespace axiscal

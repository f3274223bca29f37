#pragma once
// Linear least squares over few columns by Householder reflections. Baseline arithmetic in a fixed
// order. Pure.

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

/// Columns of equal length, at least as long as there are columns; the relative error of the
/// coefficients is about 1e-16 times the condition number.
ColumnFit fit_columns(const std::vector<std::vector<double>>& columns,
                      const std::vector<double>& right_side);

} // namespace axiscal

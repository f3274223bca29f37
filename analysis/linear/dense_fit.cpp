#include "analysis/linear/dense_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace axiscal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Eigen::Map<const VectorXd> seen(const std::vector<double>& values) {
    return {values.data(), static_cast<Index>(values.size())};
}
Eigen::Map<const MatrixXd> seen(const Matrix& matrix) {
    return {matrix.values.data(), static_cast<Index>(matrix.rows),
            static_cast<Index>(matrix.columns)};
}

double spread_of(const VectorXd& diagonal) {
    const double low = diagonal.cwiseAbs().minCoeff(), high = diagonal.cwiseAbs().maxCoeff();
    return low > 0 ? high / low : std::numeric_limits<double>::infinity();
}

} // namespace

ColumnFit fit_columns(const std::vector<std::vector<double>>& columns,
                      const std::vector<double>& right_side) {
    const auto count = static_cast<Index>(columns.size());
    MatrixXd matrix{static_cast<Index>(right_side.size()), count};
    for (std::size_t k = 0; k < columns.size(); ++k)
        matrix.col(static_cast<Index>(k)) = seen(columns[k]);
    const Eigen::HouseholderQR<MatrixXd> qr{matrix};
    ColumnFit fit;
    fit.condition = spread_of(qr.matrixQR().diagonal());
    fit.coefficients.assign(columns.size(), 0.0);
    fit.residuals = right_side;
    if (!std::isfinite(fit.condition)) return fit;
    const VectorXd solution = qr.solve(seen(right_side));
    const VectorXd rest = seen(right_side) - matrix * solution;
    std::ranges::copy(solution, fit.coefficients.begin());
    std::ranges::copy(rest, fit.residuals.begin());
    return fit;
}

std::optional<Matrix> lower_factor(const Matrix& symmetric) {
    const Eigen::LLT<MatrixXd> factored{seen(symmetric)};
    if (factored.info() != Eigen::Success) return std::nullopt;
    Matrix lower{symmetric.rows, symmetric.columns};
    const MatrixXd factor = factored.matrixL();
    std::ranges::copy(factor.reshaped(), lower.values.begin());
    return lower;
}

std::vector<double> solve_by_factor(const Matrix& lower, const std::vector<double>& right) {
    const auto factor = seen(lower).triangularView<Eigen::Lower>();
    const VectorXd solution = factor.transpose().solve(factor.solve(seen(right)));
    return {solution.begin(), solution.end()};
}

} // namespace axiscal

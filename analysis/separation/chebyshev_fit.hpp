#pragma once
// Least-squares polynomial through very many points. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/separation/chebyshev_basis.hpp"

#include <optional>
#include <span>
#include <vector>

namespace axiscal {

enum class ChebyshevMethod {
    automatic, ///< moments, and QR where the Gram matrix is worse than 1e6
    qr,        ///< blocked Householder QR; of least norm where the points leave the degree open
};

struct ChebyshevFit {
    AxisRange range;
    std::vector<double> first_kind, second_kind; ///< of T_0.. and of U_0..: the same polynomial
    /// Of the Gram matrix of T_0.. over the points, in the 2-norm; absent where it is singular.
    std::optional<double> gram_condition;
    bool by_moments = false;
    std::size_t rank = 0; ///< less than degree + 1 where the points leave the degree open
};

/// Fit by moments: T_i T_j = (T_{i+j} + T_{|i-j|}) / 2, so the Gram matrix needs 2 degree + 1 sums
/// and one pass over the points; solved by Cholesky, with one step of refinement above condition
/// 100. Coefficients agree with those of QR to 1e-12 of the largest. Fitted in the first kind,
/// converted to the second with one rounding a coefficient.
/// @errors Fault::bad_case: "x" and "y" of different length or empty, "degree" not 1 to 32,
/// "range" not rising, "x[i]" outside the range or not finite, "y[i]" not finite or above 1e12.
Result<ChebyshevFit> fit_chebyshev(std::span<const double> x,
                                   std::span<const double> y,
                                   std::size_t degree,
                                   AxisRange range,
                                   ChebyshevMethod method = ChebyshevMethod::automatic);

/// sqrt(sum of squared residuals / n).
double residual_rms(const ChebyshevFit& fit, std::span<const double> x, std::span<const double> y);

} // namespace axiscal

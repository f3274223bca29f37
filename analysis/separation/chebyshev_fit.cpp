#include "analysis/separation/chebyshev_fit.hpp"

#include "analysis/linear/dense_fit.hpp"
#include "analysis/separation/chebyshev_moments.hpp"
#include "analysis/separation/minimum_norm.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace axiscal {
namespace {

constexpr double worst_gram = 1e6;   // beyond, the moments lose more than six digits
constexpr double refined_gram = 100; // below, Cholesky alone is good to 1e-13
constexpr double largest = 1e12;

Result<void> check_shape(std::size_t x, std::size_t y, std::size_t degree, const AxisRange& range) {
    if (x == 0) return refuse(Fault::bad_case, "x", "is empty");
    if (y != x) return refuse(Fault::bad_case, "y", "must have as many numbers as x");
    if (degree < 1 || degree > highest_moment_degree)
        return refuse(Fault::bad_case, "degree", "must be a whole number from 1 to 32");
    const double size = std::max(std::fabs(range.from), std::fabs(range.to));
    if (!(size <= largest) || !(range.to - range.from > 1e-9 * size))
        return refuse(Fault::bad_case, "range", "must rise from its first number to its second");
    return {};
}

/// The first number that may not stand there.
Result<void>
check_numbers(std::span<const double> x, std::span<const double> y, const AxisRange& range) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!range.holds(x[i])) // false for NaN
            return refuse(Fault::bad_case, "x[" + std::to_string(i) + "]",
                          "lies outside the range");
        if (!(std::fabs(y[i]) <= largest))
            return refuse(Fault::bad_case, "y[" + std::to_string(i) + "]",
                          "is not finite or larger than 1e12");
    }
    return {};
}

Matrix gram_of(const ChebyshevMoments& moments) {
    const std::size_t n = moments.right.size();
    Matrix gram{n, n};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            gram(i, j) = (moments.basis[i + j] + moments.basis[i > j ? i - j : j - i]) / 2;
    return gram;
}

/// Sum of a_k T_k(t) by Clenshaw.
double value_at(std::span<const double> first_kind, double t) {
    double next = 0, after = 0;
    for (std::size_t k = first_kind.size(); k-- > 1;) {
        const double here = first_kind[k] + 2 * t * next - after;
        after = next;
        next = here;
    }
    return first_kind[0] + t * next - after;
}

std::vector<double>
residuals_of(const ChebyshevFit& fit, std::span<const double> x, std::span<const double> y) {
    std::vector<double> residuals(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        residuals[i] = y[i] - value_at(fit.first_kind, fit.range.normalised(x[i]));
    return residuals;
}

void fit_by_qr(std::span<const double> x, std::span<const double> y, ChebyshevFit& fit) {
    const std::size_t n = fit.first_kind.size();
    TriangleOfRows rows{n};
    std::vector<double> row(n, 1);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double t = fit.range.normalised(x[i]);
        row[1] = t;
        for (std::size_t k = 2; k < n; ++k)
            row[k] = 2 * t * row[k - 1] - row[k - 2];
        rows.add(row, y[i]);
    }
    const MinimumNormSolution solution = solve_minimum_norm(rows.finish());
    fit.first_kind = solution.coefficients;
    fit.rank = solution.rank;
}

std::optional<double> condition_of(const Matrix& gram) {
    const auto values = singular_values(gram).values;
    if (!(values.back() > 0)) return std::nullopt;
    const double condition = values.front() / values.back();
    return std::isfinite(condition) ? std::optional{condition} : std::nullopt;
}

/// False where the Gram matrix is too bad for it.
bool fit_by_moments(const ChebyshevMoments& moments,
                    std::span<const double> x,
                    std::span<const double> y,
                    ChebyshevFit& fit) {
    const Matrix gram = gram_of(moments);
    fit.gram_condition = condition_of(gram);
    if (!fit.gram_condition || *fit.gram_condition > worst_gram) return false;
    const auto factor = lower_factor(gram);
    if (!factor) return false;
    fit.first_kind = solve_by_factor(*factor, moments.right);
    fit.rank = fit.first_kind.size();
    if (*fit.gram_condition <= refined_gram) return true;
    const auto residuals = residuals_of(fit, x, y);
    const auto left = chebyshev_moments(x, residuals, fit.rank - 1, fit.range.from, fit.range.to);
    const auto step = solve_by_factor(*factor, left.right);
    for (std::size_t k = 0; k < fit.rank; ++k)
        fit.first_kind[k] += step[k];
    return true;
}

} // namespace

Result<ChebyshevFit> fit_chebyshev(std::span<const double> x,
                                   std::span<const double> y,
                                   std::size_t degree,
                                   AxisRange range,
                                   ChebyshevMethod method) {
    AXISCAL_CHECK(check_shape(x.size(), y.size(), degree, range));
    const auto moments = chebyshev_moments(x, y, degree, range.from, range.to);
    // |t| up to 1 + 2e-9 is within the slack of a range
    const bool within = moments.largest_square <= 1 + 3e-9 &&
                        moments.largest_right_square <= largest * largest &&
                        std::isfinite(moments.basis[1]) && std::isfinite(moments.right[0]);
    if (!within) AXISCAL_CHECK(check_numbers(x, y, range));
    ChebyshevFit fit;
    fit.range = range;
    fit.first_kind.assign(degree + 1, 0);
    fit.by_moments = method == ChebyshevMethod::automatic && fit_by_moments(moments, x, y, fit);
    if (method == ChebyshevMethod::qr) fit.gram_condition = condition_of(gram_of(moments));
    if (!fit.by_moments) fit_by_qr(x, y, fit);
    fit.second_kind = second_from_first_kind(fit.first_kind);
    return fit;
}

double residual_rms(const ChebyshevFit& fit, std::span<const double> x, std::span<const double> y) {
    const auto residuals = residuals_of(fit, x, y);
    return std::sqrt(dot(residuals, residuals) / static_cast<double>(x.size()));
}

} // namespace axiscal

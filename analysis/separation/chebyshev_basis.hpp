#pragma once
// Chebyshev polynomials over the travel of an axis. Pure.

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal {

/// Travel [from, to] of an axis, from < to; any one unit.
struct AxisRange {
    double from = -1, to = 1;

    /// t = (2 q - from - to) / (to - from): -1 to 1 over the travel (reconstructed: the printed
    /// formula is lost, a linear normalisation is stated).
    [[nodiscard]] double normalised(double q) const {
        return ((q - from) + (q - to)) / (to - from);
    }
    /// Within the travel, or outside by no more than its rounding (1e-9 of the width).
    [[nodiscard]] bool holds(double q) const;
};

/// values[k] = U_k(t): U_0 = 1, U_1 = 2 t, U_{k+1} = 2 t U_k - U_{k-1}.
void second_kind(double t, std::span<double> values);

/// Coefficients of U_0.. from those of T_0.. of the same polynomial: T_0 = U_0, T_1 = U_1 / 2,
/// T_k = (U_k - U_{k-2}) / 2. One rounding a coefficient.
std::vector<double> second_from_first_kind(std::span<const double> first);

/// A curve that is zero at its reference: sum over k >= 1 of a_k (U_k(t) - U_k(t_ref)).
/// coefficients[k - 1] belongs to U_k.
double
curve_at(std::span<const double> coefficients, const AxisRange& range, double reference, double q);

} // namespace axiscal

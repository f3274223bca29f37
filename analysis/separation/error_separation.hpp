#pragma once
// The nine position-dependent errors d_ab of three linear axes (a: direction of the error, b: the
// moving axis) from deviations at points where all three axes took part. Pure.
//
//   D_a = s_ax d_ax(x) + s_ay d_ay(y) + s_az d_az(z)          for a = x, y, z
//
// with the sign matrix s, by default (1, 1, -1) in every row because the z slide carries the work
// (row x stated by the source, rows y and z reconstructed from the chain: the signs are an input).
// Angular errors and squareness are not modelled; squareness shows as a linear part.

#include "analysis/quantity/result.hpp"
#include "analysis/separation/chebyshev_basis.hpp"
#include "analysis/separation/minimum_norm.hpp"

#include <array>
#include <optional>
#include <vector>

namespace axiscal {

inline constexpr std::size_t highest_separation_order = 20; // U_20 has zeros every 3 % of travel
inline constexpr std::size_t highest_chosen_order = 6;      // 343 candidates a row

template <class T> using PerAxis = std::array<T, 3>; ///< x, y, z
/// [direction][axis]
template <class T> using PerCurve = PerAxis<PerAxis<T>>;

/// How the columns of a row are made and what becomes of the constant.
enum class ConstantRule {
    reference, ///< U_k - U_k(ref), k >= 1: the deviation at the reference is taken as exactly zero
    paper,     ///< U_0 to U_n of each axis, least norm: the constants are split evenly
    free_row,  ///< as `reference`, with one free constant a row: asks nothing of the reference
};

/// Axes, signs and basis that curves are written in.
struct SeparationModel {
    PerCurve<std::size_t> orders{{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}};
    PerCurve<double> signs{{{1, 1, -1}, {1, 1, -1}, {1, 1, -1}}};
    PerAxis<AxisRange> ranges_mm{};
    PerAxis<double> reference_mm{};
};

struct SeparationCase {
    SeparationModel model;
    ConstantRule constant = ConstantRule::reference;
    std::vector<PerAxis<double>> points_mm, deviation_um;
};

struct SeparatedCurve {
    std::vector<double> coefficients_um; ///< [k - 1] of U_k
    double constant_um = 0;              ///< of U_0; rule `paper` only
    std::vector<double> uncertainty_um;  ///< standard, from the residuals; empty without freedom
    Matrix covariance_um2;               ///< of the coefficients; empty without freedom
    /// Largest part of a unit vector of the dropped subspace that lies in this curve, U_0 aside.
    double touched = 0;
    /// The same where the deviation at the reference is not taken as known; rule `reference` only.
    double touched_without_reference = 0;
    /// Touched by more than a tenth: must not be shown as a curve of its own.
    [[nodiscard]] bool separable() const { return touched <= 0.1; }
    [[nodiscard]] bool rests_on_reference() const {
        return separable() && touched_without_reference > 0.1;
    }
};

/// A combination of coefficients that the points leave open.
struct DroppedDirection {
    double singular_value = 0;
    PerAxis<std::vector<double>> coefficients; ///< unit vector: of U_1.., rule `paper` of U_0..
    double free_constant = 0;                  ///< rule `free_row`
};

struct SeparatedRow {
    PerAxis<SeparatedCurve> curves;
    double free_constant_um = 0; ///< rule `free_row`
    std::size_t rank = 0, columns = 0;
    std::optional<double> condition; ///< largest over smallest kept singular value
    double residual_rms_um = 0;
    /// Root mean square of r_i / (1 - h_i): each point predicted from all the others. Absent where
    /// a point stands alone for a part of the fit.
    std::optional<double> leave_one_out_rms_um;
    std::vector<DroppedDirection> dropped;
};

/// Least squares of least norm by row (SVD, singular values up to max(m, n) 2^-52 of the largest
/// dropped). Accuracy: a few condition * 1e-16 of the largest coefficient.
/// @errors Fault::bad_case with the field: ranges not rising, numbers not finite or above 1e12,
/// points or reference outside the ranges, no points, lists of different length, an order above 20,
/// a row without any order, a sign other than 1 and -1.
Result<PerAxis<SeparatedRow>> separate_errors(const SeparationCase& stated);

/// What separate_errors checks, as a whole and in parts.
Result<void> check_separation(const SeparationCase& stated);
Result<void> check_model(const SeparationModel& model);
Result<void> check_point(const SeparationModel& model,
                         const PerAxis<double>& point_mm,
                         const std::string& field);
/// Finite and no larger than 1e12.
Result<void> check_number(double value, const std::string& field);

/// Orders by the corrected information criterion of Akaike, least
///   AICc = m ln(RSS / m) + 2 p + 2 p (p + 1) / (m - p - 1),   p = rank + 1 (the variance)
/// over every combination of 0 to `highest` for the three axes of a row; of equals the one with the
/// fewest columns. A residual below 1e-13 of the largest deviation counts as that, so that exact
/// data choose the smallest model that is exact.
Result<PerCurve<std::size_t>> choose_orders(const SeparationCase& stated, std::size_t highest);

/// Deviations that curves cause at a point, all nine with their signs.
PerAxis<double> deviation_from(const PerCurve<std::vector<double>>& coefficients_um,
                               const SeparationModel& model,
                               const PerAxis<double>& point_mm);

} // namespace axiscal

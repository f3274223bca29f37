#include "analysis/separation/error_separation.hpp"

#include "analysis/separation/design_row.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace axiscal {
namespace {

/// The first n columns of a triangle are a problem of their own.
Triangle leading_columns(const Triangle& whole, std::size_t n) {
    Triangle part{Matrix{n, n}, {}, whole.remainder, whole.rows};
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i <= j; ++i)
            part.upper(i, j) = whole.upper(i, j);
    part.projected.assign(whole.projected.begin(),
                          whole.projected.begin() + static_cast<std::ptrdiff_t>(n));
    for (std::size_t i = n; i < whole.projected.size(); ++i)
        part.remainder += whole.projected[i] * whole.projected[i];
    return part;
}

/// Largest part of a unit vector of the dropped subspace that lies in the stated columns: the
/// largest singular value of those rows of its basis.
double touched_part(const MinimumNormSolution& solution, std::size_t first, std::size_t count) {
    const std::size_t n = solution.directions.columns;
    if (solution.rank == n || count == 0) return 0;
    Matrix rows{count, n - solution.rank};
    for (std::size_t j = 0; j < rows.columns; ++j)
        for (std::size_t i = 0; i < count; ++i)
            rows(i, j) = solution.directions(first + i, solution.rank + j);
    return singular_values(rows).values.front();
}

struct RowFit {
    const SeparationCase& stated;
    std::size_t direction = 0;
    DesignRow design;
    MinimumNormSolution solution;
    std::size_t columns = 0;

    /// Coefficients of U_1.. of an axis stand here.
    [[nodiscard]] std::size_t first_term(std::size_t axis) const {
        return design.first_column(axis) + (stated.constant == ConstantRule::paper ? 1 : 0);
    }
    [[nodiscard]] std::size_t order(std::size_t axis) const {
        return stated.model.orders[direction][axis];
    }
};

/// Residuals by a second pass over the points, not from the triangle: their digits matter.
double add_residuals(RowFit& fit, SeparatedRow& row) {
    double squares = 0, left_out = 0;
    bool each_predicted = true;
    for (std::size_t i = 0; i < fit.stated.points_mm.size(); ++i) {
        const auto columns = fit.design.at(fit.stated.points_mm[i]).first(fit.columns);
        const double residual =
            fit.stated.deviation_um[i][fit.direction] - dot(columns, fit.solution.coefficients);
        const double freedom = 1 - fit.solution.leverage(columns);
        squares += residual * residual;
        // below 1e-9 nothing but rounding is left of the point's own freedom
        each_predicted = each_predicted && freedom > 1e-9;
        if (each_predicted) left_out += (residual / freedom) * (residual / freedom);
    }
    const auto count = static_cast<double>(fit.stated.points_mm.size());
    row.residual_rms_um = std::sqrt(squares / count);
    if (each_predicted) row.leave_one_out_rms_um = std::sqrt(left_out / count);
    return squares;
}

void add_covariance(const RowFit& fit, std::size_t axis, double variance, SeparatedCurve& curve) {
    const std::size_t first = fit.first_term(axis), n = fit.order(axis);
    curve.covariance_um2 = Matrix{n, n};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            curve.covariance_um2(i, j) =
                variance * fit.solution.inverse_normal(first + i, first + j);
        curve.uncertainty_um.push_back(std::sqrt(curve.covariance_um2(i, i)));
    }
}

SeparatedCurve curve_of(const RowFit& fit, std::size_t axis) {
    SeparatedCurve curve;
    const auto begin =
        fit.solution.coefficients.begin() + static_cast<std::ptrdiff_t>(fit.first_term(axis));
    curve.coefficients_um.assign(begin, begin + static_cast<std::ptrdiff_t>(fit.order(axis)));
    if (fit.stated.constant == ConstantRule::paper)
        curve.constant_um = fit.solution.coefficients[fit.design.first_column(axis)];
    curve.touched = touched_part(fit.solution, fit.first_term(axis), fit.order(axis));
    return curve;
}

/// A direction has no sign: the one whose largest coefficient is positive.
std::vector<double> upright(std::span<const double> direction) {
    std::vector<double> vector{direction.begin(), direction.end()};
    const auto smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
    if (*std::ranges::max_element(vector, smaller) < 0)
        for (double& value : vector)
            value = -value;
    return vector;
}

std::vector<DroppedDirection> dropped_of(const RowFit& fit) {
    std::vector<DroppedDirection> dropped;
    for (std::size_t j = fit.solution.rank; j < fit.columns; ++j) {
        DroppedDirection direction;
        direction.singular_value = fit.solution.singular_values[j];
        const std::vector<double> vector = upright(fit.solution.directions.column(j));
        const std::span all{vector};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto part =
                all.subspan(fit.design.first_column(axis), fit.design.columns_of(axis));
            direction.coefficients[axis].assign(part.begin(), part.end());
        }
        if (fit.stated.constant == ConstantRule::free_row) direction.free_constant = vector.back();
        dropped.push_back(std::move(direction));
    }
    return dropped;
}

SeparatedRow separate_row(const SeparationCase& stated, std::size_t direction) {
    DesignRow design{stated.model, stated.constant, direction};
    TriangleOfRows rows{design.curve_columns() + 1};
    for (std::size_t i = 0; i < stated.points_mm.size(); ++i)
        rows.add(design.at(stated.points_mm[i]), stated.deviation_um[i][direction]);
    const Triangle whole = rows.finish();
    const bool free = stated.constant == ConstantRule::free_row;
    const std::size_t columns = design.curve_columns() + (free ? 1 : 0);
    const MinimumNormSolution with_free = solve_minimum_norm(whole);
    RowFit fit{stated, direction, std::move(design),
               free ? with_free : solve_minimum_norm(leading_columns(whole, columns)), columns};

    SeparatedRow row;
    row.rank = fit.solution.rank;
    row.columns = columns;
    row.condition = fit.solution.condition;
    const double squares = add_residuals(fit, row);
    const std::size_t points = stated.points_mm.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        SeparatedCurve& curve = row.curves[axis] = curve_of(fit, axis);
        if (points > row.rank)
            add_covariance(fit, axis, squares / static_cast<double>(points - row.rank), curve);
        if (stated.constant == ConstantRule::reference)
            curve.touched_without_reference =
                touched_part(with_free, fit.first_term(axis), fit.order(axis));
    }
    if (free) row.free_constant_um = fit.solution.coefficients.back();
    row.dropped = dropped_of(fit);
    return row;
}

} // namespace

Result<PerAxis<SeparatedRow>> separate_errors(const SeparationCase& stated) {
    AXISCAL_CHECK(check_separation(stated));
    PerAxis<SeparatedRow> rows;
    for (std::size_t direction = 0; direction < 3; ++direction)
        rows[direction] = separate_row(stated, direction);
    return rows;
}

} // namespace axiscal

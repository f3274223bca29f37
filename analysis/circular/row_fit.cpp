// Triangle of the rows, columns scaled to length 1, singular values of that. A direction whose
// singular value is below 1e-10 of the largest is dropped: its coefficient would carry no digit of
// readings that have six.

#include "analysis/circular/row_fit.hpp"

#include "analysis/linear/singular_values.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal::circular {
namespace {

constexpr double dropped_below = 1e-10;
constexpr double replaceable_above = 1e-6; ///< share of a unit column within the dropped directions

using Columns = std::vector<std::vector<double>>;

/// Groups of columns that share a dropped direction. `share[i][j]` is the projector on those.
std::vector<std::vector<std::size_t>> groups_of(const Columns& share) {
    const std::size_t n = share.size();
    std::vector<std::vector<std::size_t>> groups;
    std::vector<bool> taken(n, false);
    for (std::size_t start = 0; start < n; ++start) {
        if (taken[start] || share[start][start] < replaceable_above * replaceable_above) continue;
        std::vector<std::size_t> group{start};
        taken[start] = true;
        for (std::size_t next = 0; next < group.size(); ++next)
            for (std::size_t j = 0; j < n; ++j)
                if (!taken[j] && std::fabs(share[group[next]][j]) > replaceable_above) {
                    taken[j] = true;
                    group.push_back(j);
                }
        std::ranges::sort(group);
        groups.push_back(std::move(group));
    }
    return groups;
}

/// Square triangle with columns of length 1, and their lengths.
struct Scaled {
    Matrix columns;
    std::vector<double> length;
};

Scaled scaled(const Matrix& triangle) {
    Scaled out{triangle, std::vector<double>(triangle.columns, 1)};
    for (std::size_t j = 0; j < triangle.columns; ++j) {
        const double norm = std::sqrt(dot(triangle.column(j), triangle.column(j)));
        if (norm > 0) out.length[j] = norm;
        for (double& entry : out.columns.column(j))
            entry /= out.length[j];
    }
    return out;
}

/// What the singular directions make: solution, inverse of the normal matrix, projector on what is
/// dropped; all in scaled columns.
struct Spectrum {
    std::vector<double> value, rest;
    Columns inverse, dropped;
    std::size_t rank = 0;
    double condition = 0;
};

void add_outer(Columns& sum, std::span<const double> v, double factor) {
    for (std::size_t i = 0; i < v.size(); ++i)
        for (std::size_t j = 0; j < v.size(); ++j)
            sum[i][j] += v[i] * v[j] * factor;
}

Spectrum spectrum_of(const Matrix& matrix, const std::vector<double>& right) {
    const std::size_t n = matrix.columns;
    const SingularValues parts = singular_values(matrix);
    const double largest = parts.values.front();
    const Columns zero(n, std::vector<double>(n, 0));
    Spectrum out{std::vector<double>(n, 0), right, zero, zero};
    for (std::size_t k = 0; k < n; ++k) {
        const double s = parts.values[k];
        const auto v = parts.right.column(k);
        if (!(s > dropped_below * largest)) {
            add_outer(out.dropped, v, 1);
            continue;
        }
        ++out.rank;
        out.condition = largest / s; // they fall
        const auto u = parts.left.column(k);
        const double share = dot(u, right);
        for (std::size_t i = 0; i < n; ++i) {
            out.rest[i] -= share * u[i];
            out.value[i] += share / s * v[i];
        }
        add_outer(out.inverse, v, 1 / (s * s));
    }
    return out;
}

} // namespace

double LinearSolution::standard_uncertainty(std::size_t column) const {
    return covariance.empty() ? 0 : std::sqrt(covariance[column][column]);
}

void RowFit::add(std::span<const double> row, double value, double weight) {
    weighted_.assign(row.begin(), row.end());
    for (double& factor : weighted_)
        factor *= weight;
    rows_.add(weighted_, weight * value);
}

void RowFit::add_all_of(const RowFit& other) {
    TriangleOfRows whole = other.rows_;
    rows_.add_all_of(whole.finish());
}

LinearSolution RowFit::solve() const {
    TriangleOfRows whole = rows_;
    const Triangle triangle = whole.finish();
    const std::size_t n = triangle.upper.columns;
    const Scaled matrix = scaled(triangle.upper);
    Spectrum spectrum = spectrum_of(matrix.columns, triangle.projected);
    LinearSolution out;
    out.rows = triangle.rows;
    out.rank = spectrum.rank;
    out.condition = spectrum.condition;
    out.residual_sum_of_squares = triangle.remainder + dot(spectrum.rest, spectrum.rest);
    out.tied = groups_of(spectrum.dropped);
    for (std::size_t i = 0; i < n; ++i) {
        out.value.push_back(spectrum.value[i] / matrix.length[i]);
        out.estimable.push_back(spectrum.dropped[i][i] < replaceable_above * replaceable_above);
    }
    if (out.rows <= out.rank) return out;
    const double variance = out.residual_sum_of_squares / static_cast<double>(out.rows - out.rank);
    out.covariance = std::move(spectrum.inverse);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            out.covariance[i][j] *= variance / (matrix.length[i] * matrix.length[j]);
    return out;
}

} // namespace axiscal::circular

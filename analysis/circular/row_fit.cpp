// Householder triangle of [A | b] in blocks of rows, then a one-sided Jacobi singular value
// decomposition of the small triangle. A direction whose singular value is below 1e-10 of the
// largest is dropped: its coefficient would carry no digit of readings that have six.

#include "analysis/circular/row_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal::circular {
namespace {

constexpr std::size_t block_rows = 256;
constexpr double dropped_below = 1e-10;
constexpr double replaceable_above = 1e-6; ///< share of a unit column within the dropped directions

using Columns = std::vector<std::vector<double>>;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Turns columns i and j so that they stand at right angles, and the same two of `turned` with
/// them.
bool rotate(Columns& columns, Columns& turned, std::size_t i, std::size_t j) {
    const double aa = dot(columns[i], columns[i]), bb = dot(columns[j], columns[j]);
    const double ab = dot(columns[i], columns[j]);
    if (std::fabs(ab) <= 1e-17 * std::sqrt(aa * bb)) return false;
    const double zeta = (bb - aa) / (2 * ab);
    const double t = (zeta < 0 ? -1 : 1) / (std::fabs(zeta) + std::sqrt(1 + zeta * zeta));
    const double c = 1 / std::sqrt(1 + t * t), s = c * t;
    for (Columns* both : {&columns, &turned})
        for (std::size_t k = 0; k < (*both)[i].size(); ++k) {
            const double first = (*both)[i][k], second = (*both)[j][k];
            (*both)[i][k] = c * first - s * second;
            (*both)[j][k] = s * first + c * second;
        }
    return true;
}

/// A = U S V^T of a square matrix: `columns` comes as A and leaves as U S, the result is V.
Columns jacobi(Columns& columns) {
    const std::size_t n = columns.size();
    Columns v(n, std::vector<double>(n, 0));
    for (std::size_t k = 0; k < n; ++k)
        v[k][k] = 1;
    constexpr int sweeps = 40; // converges in about ten
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        bool turned = false;
        for (std::size_t i = 0; i + 1 < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                turned = rotate(columns, v, i, j) || turned;
        if (!turned) break;
    }
    return v;
}

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

/// Square triangle with columns of length 1, and its right side.
struct Scaled {
    Columns columns;
    std::vector<double> length, right;
};

Scaled scaled(const std::vector<double>& triangle, std::size_t n) {
    Scaled out{Columns(n, std::vector<double>(n, 0)), std::vector<double>(n, 1),
               std::vector<double>(n)};
    const std::size_t width = n + 1;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i <= j; ++i)
            out.columns[j][i] = triangle[i * width + j];
        const double norm = std::sqrt(dot(out.columns[j], out.columns[j]));
        if (norm > 0) out.length[j] = norm;
        for (double& entry : out.columns[j])
            entry /= out.length[j];
        out.right[j] = triangle[j * width + n];
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

void add_outer(Columns& sum, const std::vector<double>& v, double factor) {
    for (std::size_t i = 0; i < v.size(); ++i)
        for (std::size_t j = 0; j < v.size(); ++j)
            sum[i][j] += v[i] * v[j] * factor;
}

Spectrum spectrum_of(Scaled matrix) {
    const std::size_t n = matrix.right.size();
    const Columns v = jacobi(matrix.columns);
    std::vector<double> singular(n);
    for (std::size_t k = 0; k < n; ++k)
        singular[k] = std::sqrt(dot(matrix.columns[k], matrix.columns[k]));
    const double largest = std::ranges::max(singular);
    double smallest = largest;
    const Columns zero(n, std::vector<double>(n, 0));
    Spectrum out{std::vector<double>(n, 0), matrix.right, zero, zero};
    for (std::size_t k = 0; k < n; ++k) {
        const double s = singular[k];
        if (!(s > dropped_below * largest)) {
            add_outer(out.dropped, v[k], 1);
            continue;
        }
        ++out.rank;
        smallest = std::min(smallest, s);
        const double strength = dot(matrix.columns[k], matrix.right) / (s * s);
        for (std::size_t i = 0; i < n; ++i) {
            out.rest[i] -= strength * matrix.columns[k][i];
            out.value[i] += strength * v[k][i];
        }
        add_outer(out.inverse, v[k], 1 / (s * s));
    }
    out.condition = largest > 0 ? largest / smallest : 0;
    return out;
}

} // namespace

double LinearSolution::standard_uncertainty(std::size_t column) const {
    return covariance.empty() ? 0 : std::sqrt(covariance[column][column]);
}

RowFit::RowFit(std::size_t columns)
    : columns_{columns}
    , width_{columns + 1}
    , triangle_(width_ * width_, 0)
    , block_(width_ * block_rows, 0) {}

void RowFit::add(std::span<const double> row, double value, double weight) {
    for (std::size_t k = 0; k < columns_; ++k)
        block_[k * block_rows + held_] = weight * row[k];
    block_[columns_ * block_rows + held_] = weight * value;
    ++rows_;
    if (++held_ == block_rows) fold();
}

void RowFit::add_all_of(const RowFit& other) {
    RowFit whole = other;
    whole.fold();
    const std::size_t rows = rows_ + other.rows_;
    std::vector<double> row(columns_);
    for (std::size_t i = 0; i < width_; ++i) {
        for (std::size_t k = 0; k < columns_; ++k)
            row[k] = whole.triangle_[i * width_ + k];
        add(row, whole.triangle_[i * width_ + columns_]);
    }
    rows_ = rows;
}

/// Reflects the held rows into the triangle. Above the diagonal row k and within the block nothing
/// but zero stands under column k, so each reflection touches row k and the block alone.
void RowFit::fold() {
    for (std::size_t k = 0; k < width_; ++k) {
        double* const head = &block_[k * block_rows];
        double below = 0;
        for (std::size_t i = 0; i < held_; ++i)
            below += head[i] * head[i];
        if (below == 0) continue;
        double& corner = triangle_[k * width_ + k];
        const double norm = std::sqrt(corner * corner + below);
        const double first = corner + (corner < 0 ? -norm : norm);
        const double scale = 2 / (first * first + below);
        for (std::size_t j = k + 1; j < width_; ++j) {
            double* const column = &block_[j * block_rows];
            double product = first * triangle_[k * width_ + j];
            for (std::size_t i = 0; i < held_; ++i)
                product += head[i] * column[i];
            product *= scale;
            triangle_[k * width_ + j] -= product * first;
            for (std::size_t i = 0; i < held_; ++i)
                column[i] -= product * head[i];
        }
        corner = corner < 0 ? norm : -norm;
    }
    std::ranges::fill(block_, 0.0);
    held_ = 0;
}

LinearSolution RowFit::solve() const {
    RowFit whole = *this;
    whole.fold();
    const std::size_t n = columns_;
    const Scaled matrix = scaled(whole.triangle_, n);
    Spectrum spectrum = spectrum_of(matrix);
    const double corner = whole.triangle_[n * width_ + n];
    LinearSolution out;
    out.rows = rows_;
    out.rank = spectrum.rank;
    out.condition = spectrum.condition;
    out.residual_sum_of_squares = corner * corner + dot(spectrum.rest, spectrum.rest);
    out.tied = groups_of(spectrum.dropped);
    for (std::size_t i = 0; i < n; ++i) {
        out.value.push_back(spectrum.value[i] / matrix.length[i]);
        out.estimable.push_back(spectrum.dropped[i][i] < replaceable_above * replaceable_above);
    }
    if (rows_ <= out.rank) return out;
    const double variance = out.residual_sum_of_squares / static_cast<double>(rows_ - out.rank);
    out.covariance = std::move(spectrum.inverse);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            out.covariance[i][j] *= variance / (matrix.length[i] * matrix.length[j]);
    return out;
}

} // namespace axiscal::circular

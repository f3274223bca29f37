#include "analysis/separation/minimum_norm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace axiscal {
namespace {

constexpr std::size_t block_rows = 64; // 64 rows of 20 columns stay in the first-level cache
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Householder step j: folds column j of the block into the diagonal of the triangle.
void eliminate(Triangle& triangle, Matrix& block, std::size_t j) {
    const std::size_t n = triangle.upper.columns;
    const auto below = block.column(j);
    const double squares = dot(below, below);
    if (squares == 0) return;
    const double diagonal = triangle.upper(j, j);
    const double norm = std::sqrt(diagonal * diagonal + squares);
    const double reflected = diagonal > 0 ? -norm : norm;
    const double head = diagonal - reflected;
    const double scale = 2 / (head * head + squares);
    triangle.upper(j, j) = reflected;
    for (std::size_t k = j + 1; k <= n; ++k) {
        double& top = k < n ? triangle.upper(j, k) : triangle.projected[j];
        const auto column = block.column(k);
        const double share = scale * (head * top + dot(below, column));
        top -= share * head;
        for (std::size_t i = 0; i < column.size(); ++i)
            column[i] -= share * below[i];
    }
}

/// Turns columns i and j of both matrices so that those of `work` stand perpendicular; false when
/// they did already.
bool rotate(Matrix& work, Matrix& right, std::size_t i, std::size_t j) {
    const auto a = work.column(i), b = work.column(j);
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
    // half a unit in the last place of either norm; tiny columns whose squares vanish are zero
    if (std::fabs(ab) <= epsilon * std::sqrt(aa) * std::sqrt(bb)) return false;
    const double zeta = (bb - aa) / (2 * ab);
    const double root = std::fabs(zeta) > 1e150 ? std::fabs(zeta) : std::sqrt(1 + zeta * zeta);
    const double tangent = (zeta < 0 ? -1 : 1) / (std::fabs(zeta) + root);
    const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = cosine * tangent;
    for (Matrix* matrix : {&work, &right}) {
        const auto first = matrix->column(i), second = matrix->column(j);
        for (std::size_t k = 0; k < first.size(); ++k) {
            const double kept = first[k];
            first[k] = cosine * kept - sine * second[k];
            second[k] = sine * kept + cosine * second[k];
        }
    }
    return true;
}

} // namespace

TriangleOfRows::TriangleOfRows(std::size_t columns)
    : columns_{columns}
    , block_{block_rows, columns + 1} {
    triangle_.upper = Matrix{columns, columns};
    triangle_.projected.assign(columns, 0);
}

void TriangleOfRows::add(std::span<const double> row, double value) {
    for (std::size_t j = 0; j < columns_; ++j)
        block_(filled_, j) = row[j];
    block_(filled_, columns_) = value;
    ++triangle_.rows;
    if (++filled_ == block_rows) fold();
}

void TriangleOfRows::fold() {
    for (std::size_t j = 0; j < columns_; ++j)
        eliminate(triangle_, block_, j);
    triangle_.remainder += dot(block_.column(columns_), block_.column(columns_));
    std::ranges::fill(block_.values, 0.0);
    filled_ = 0;
}

Triangle TriangleOfRows::finish() {
    if (filled_ > 0) fold();
    return triangle_;
}

Triangle choose_columns(const Triangle& whole, std::span<const std::size_t> columns) {
    TriangleOfRows chosen{columns.size()};
    std::vector<double> row(columns.size());
    for (std::size_t i = 0; i < whole.upper.rows; ++i) {
        for (std::size_t j = 0; j < columns.size(); ++j)
            row[j] = whole.upper(i, columns[j]);
        chosen.add(row, whole.projected[i]);
    }
    Triangle triangle = chosen.finish();
    triangle.remainder += whole.remainder;
    triangle.rows = whole.rows;
    return triangle;
}

SingularValues singular_values(const Matrix& matrix) {
    const std::size_t n = matrix.columns;
    Matrix work = matrix, right{n, n};
    for (std::size_t j = 0; j < n; ++j)
        right(j, j) = 1;
    constexpr int most_sweeps = 60; // ten are usual; rounding alone could turn for ever
    bool turned = true;
    for (int sweep = 0; sweep < most_sweeps && turned; ++sweep) {
        turned = false;
        for (std::size_t i = 0; i + 1 < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                turned = rotate(work, right, i, j) || turned;
    }
    std::vector<double> norms(n);
    for (std::size_t j = 0; j < n; ++j)
        norms[j] = std::sqrt(dot(work.column(j), work.column(j)));
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](auto a, auto b) { return norms[a] > norms[b]; });
    SingularValues result{{}, Matrix{matrix.rows, n}, Matrix{n, n}};
    for (std::size_t j = 0; j < n; ++j) {
        result.values.push_back(norms[order[j]]);
        std::ranges::copy(right.column(order[j]), result.right.column(j).begin());
        if (norms[order[j]] == 0) continue;
        for (std::size_t i = 0; i < matrix.rows; ++i)
            result.left(i, j) = work(i, order[j]) / norms[order[j]];
    }
    return result;
}

double MinimumNormSolution::leverage(std::span<const double> row) const {
    double sum = 0;
    for (std::size_t j = 0; j < rank; ++j) {
        const double share = dot(row, directions.column(j)) / singular_values[j];
        sum += share * share;
    }
    return sum;
}

double MinimumNormSolution::inverse_normal(std::size_t i, std::size_t j) const {
    double sum = 0;
    for (std::size_t k = 0; k < rank; ++k)
        sum += (directions(i, k) / singular_values[k]) * (directions(j, k) / singular_values[k]);
    return sum;
}

MinimumNormSolution solve_minimum_norm(const Triangle& triangle) {
    SingularValues parts = singular_values(triangle.upper);
    const std::size_t n = triangle.upper.columns;
    MinimumNormSolution solution;
    solution.coefficients.assign(n, 0);
    const double largest = n == 0 ? 0 : parts.values.front();
    const double zero = static_cast<double>(std::max(triangle.rows, n)) * epsilon * largest;
    while (solution.rank < n && parts.values[solution.rank] > zero)
        ++solution.rank;
    for (std::size_t j = 0; j < solution.rank; ++j) {
        const double share = dot(parts.left.column(j), triangle.projected) / parts.values[j];
        for (std::size_t i = 0; i < n; ++i)
            solution.coefficients[i] += share * parts.right(i, j);
    }
    if (solution.rank > 0) solution.condition = largest / parts.values[solution.rank - 1];
    solution.singular_values = std::move(parts.values);
    solution.directions = std::move(parts.right);
    return solution;
}

} // namespace axiscal

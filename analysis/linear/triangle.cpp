#include "analysis/linear/triangle.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr std::size_t block_rows = 64; // 64 rows of 20 columns stay in the first-level cache

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

void TriangleOfRows::add_all_of(const Triangle& other) {
    const std::size_t rows = triangle_.rows + other.rows;
    std::vector<double> row(columns_);
    for (std::size_t i = 0; i < other.upper.rows; ++i) {
        for (std::size_t j = 0; j < columns_; ++j)
            row[j] = other.upper(i, j);
        add(row, other.projected[i]);
    }
    triangle_.remainder += other.remainder;
    triangle_.rows = rows;
}

Triangle TriangleOfRows::finish() {
    if (filled_ > 0) fold();
    return triangle_;
}

Triangle choose_columns(const Triangle& whole, std::span<const std::size_t> columns) {
    Triangle chosen = whole;
    chosen.upper = Matrix{whole.upper.rows, columns.size()};
    for (std::size_t j = 0; j < columns.size(); ++j)
        std::ranges::copy(whole.upper.column(columns[j]), chosen.upper.column(j).begin());
    TriangleOfRows folded{columns.size()};
    folded.add_all_of(chosen);
    return folded.finish();
}

} // namespace axiscal

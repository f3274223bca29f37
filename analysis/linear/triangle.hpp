#pragma once
// Rows of a least-squares problem, taken one by one and folded into a triangle. Pure.
//
// Householder QR over blocks of rows: orthogonal, hence with the accuracy of the condition and not
// of its square, and a million rows cost no memory. Only + - * / and sqrt in a fixed order: equal
// input gives equal bits on every compiler and CPU. Eigen's QR wants the whole matrix.

#include "analysis/linear/matrix.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal {

/// A = Q R with one right side: what least squares needs of A and b.
struct Triangle {
    Matrix upper;                  ///< R, n by n
    std::vector<double> projected; ///< the first n elements of Q^T b
    double remainder = 0;          ///< sum of squares of the others
    std::size_t rows = 0;          ///< rows that were added
};

class TriangleOfRows {
public:
    explicit TriangleOfRows(std::size_t columns);
    /// row: `columns` finite numbers; value: the right side.
    void add(std::span<const double> row, double value);
    /// As if every row that went into `other` had been added; exact up to rounding.
    void add_all_of(const Triangle& other);
    /// Of the rows so far; more may follow.
    [[nodiscard]] Triangle finish();

private:
    void fold();

    std::size_t columns_, filled_ = 0;
    Triangle triangle_;
    Matrix block_; ///< right side in the last column
};

/// The problem with only the stated columns; exact up to rounding.
Triangle choose_columns(const Triangle& whole, std::span<const std::size_t> columns);

} // namespace axiscal

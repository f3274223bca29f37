#pragma once
// Linear least squares of many rows and few columns, with what the rows cannot tell apart. Pure.

#include "analysis/linear/triangle.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal::circular {

/// Solution of least norm in columns scaled to length 1.
struct LinearSolution {
    std::vector<double> value;
    /// Of the values, row by row, by the scatter of the residuals; empty where the rows are not
    /// more than the rank.
    std::vector<std::vector<double>> covariance;
    /// False for a column that others can replace without changing the residuals: its value is one
    /// of many.
    std::vector<bool> estimable;
    /// Columns that replace each other, group by group; an unused column is a group by itself.
    std::vector<std::vector<std::size_t>> tied;
    std::size_t rank = 0;
    double condition = 0; ///< of the scaled columns that count: largest / smallest singular value
    double residual_sum_of_squares = 0;
    std::size_t rows = 0;
    /// Root of the variance; 0 where the covariance is empty.
    [[nodiscard]] double standard_uncertainty(std::size_t column) const;
};

/// Takes rows one at a time and keeps their triangle.
class RowFit {
public:
    explicit RowFit(std::size_t columns)
        : rows_{columns} {}
    /// `row` times the unknowns shall be `value`; both are multiplied by `weight`.
    void add(std::span<const double> row, double value, double weight = 1);
    /// As if every row of `other` had been added here.
    void add_all_of(const RowFit& other);
    [[nodiscard]] LinearSolution solve() const;

private:
    TriangleOfRows rows_;
    std::vector<double> weighted_; ///< the row being added
};

} // namespace axiscal::circular

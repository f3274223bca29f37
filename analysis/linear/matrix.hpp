#pragma once
// A dense matrix of doubles, columns one after the other. Pure.

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal {

struct Matrix {
    Matrix() = default;
    Matrix(std::size_t row_count, std::size_t column_count)
        : rows{row_count}
        , columns{column_count}
        , values(row_count * column_count) {}

    [[nodiscard]] double& operator()(std::size_t row, std::size_t column) {
        return values[column * rows + row];
    }
    [[nodiscard]] double operator()(std::size_t row, std::size_t column) const {
        return values[column * rows + row];
    }
    [[nodiscard]] std::span<double> column(std::size_t index) {
        return std::span{values}.subspan(index * rows, rows);
    }
    [[nodiscard]] std::span<const double> column(std::size_t index) const {
        return std::span{values}.subspan(index * rows, rows);
    }

    std::size_t rows = 0, columns = 0;
    std::vector<double> values;
};

/// Sum of the products, in the order of the elements.
inline double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

} // namespace axiscal

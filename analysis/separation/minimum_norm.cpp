#include "analysis/separation/minimum_norm.hpp"

#include <algorithm>
#include <limits>

namespace axiscal {

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
    const double zero = static_cast<double>(std::max(triangle.rows, n)) *
                        std::numeric_limits<double>::epsilon() * largest;
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

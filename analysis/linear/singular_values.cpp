#include "analysis/linear/singular_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace axiscal {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

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

} // namespace axiscal

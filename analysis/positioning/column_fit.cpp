#include "analysis/positioning/column_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace axiscal {
namespace {

using Column = std::vector<double>;

double length_from(const Column& column, std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < column.size(); ++i)
        sum += column[i] * column[i];
    return std::sqrt(sum);
}

/// Reflects `column` from row `first` on by the reflector stored there in `mirror` (v v = 2).
void reflect(const Column& mirror, std::size_t first, Column& column) {
    double product = 0;
    for (std::size_t i = first; i < column.size(); ++i)
        product += mirror[i] * column[i];
    for (std::size_t i = first; i < column.size(); ++i)
        column[i] -= product * mirror[i];
}

/// Makes a reflector of the lower part of `column`; the diagonal of R that it leaves.
double make_mirror(Column& column, std::size_t first) {
    const double length = length_from(column, first);
    if (length == 0) return 0;
    const double diagonal = column[first] > 0 ? -length : length;
    column[first] -= diagonal;
    const double scale = std::sqrt(2.0) / length_from(column, first);
    for (std::size_t i = first; i < column.size(); ++i)
        column[i] *= scale;
    return diagonal;
}

/// R is the upper part of `work` with its own diagonal.
Column solve_upwards(const std::vector<Column>& work, const Column& diagonal, const Column& right) {
    Column solution(diagonal.size());
    for (std::size_t k = diagonal.size(); k-- > 0;) {
        double rest = right[k];
        for (std::size_t j = k + 1; j < diagonal.size(); ++j)
            rest -= work[j][k] * solution[j];
        solution[k] = rest / diagonal[k];
    }
    return solution;
}

double spread_of(const Column& diagonal) {
    double low = std::fabs(diagonal.front()), high = low;
    for (const double value : diagonal) {
        low = std::min(low, std::fabs(value));
        high = std::max(high, std::fabs(value));
    }
    return low > 0 ? high / low : std::numeric_limits<double>::infinity();
}

} // namespace

ColumnFit fit_columns(const std::vector<Column>& columns, const Column& right_side) {
    ColumnFit fit;
    const std::size_t count = columns.size();
    std::vector<Column> work = columns;
    Column diagonal(count), right = right_side;
    for (std::size_t k = 0; k < count; ++k) {
        diagonal[k] = make_mirror(work[k], k);
        for (std::size_t j = k + 1; j < count; ++j)
            reflect(work[k], k, work[j]);
        reflect(work[k], k, right);
    }
    fit.condition = spread_of(diagonal);
    fit.coefficients.assign(count, 0.0);
    if (std::isfinite(fit.condition)) fit.coefficients = solve_upwards(work, diagonal, right);
    fit.residuals = right_side;
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < right_side.size(); ++i)
            fit.residuals[i] -= fit.coefficients[k] * columns[k][i];
    return fit;
}

} // namespace axiscal

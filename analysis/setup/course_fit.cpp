#include "analysis/setup/course_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace axiscal {
namespace {

/// A column of which less is left beside the columns before it says nothing of its own.
constexpr double least_left = 1e-3;

double dot(const CourseColumn& a, const CourseColumn& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void take_off(CourseColumn& from, double factor, const CourseColumn& what) {
    for (std::size_t i = 0; i < from.size(); ++i)
        from[i] -= factor * what[i];
}

/// Columns as orthonormal ones and the upper triangle that makes them so.
struct Triangle {
    std::vector<CourseColumn> orthonormal;
    std::vector<std::vector<double>> upper; ///< [column][row]
    bool full_rank = true;
};

Triangle triangle_of(std::span<const CourseColumn* const> columns) {
    Triangle out;
    for (const CourseColumn* column : columns) {
        CourseColumn rest = *column;
        std::vector<double> row;
        for (const CourseColumn& before : out.orthonormal) {
            row.push_back(dot(before, rest));
            take_off(rest, row.back(), before);
        }
        const double whole = std::sqrt(dot(*column, *column)), left = std::sqrt(dot(rest, rest));
        if (!(left > least_left * whole)) {
            out.full_rank = false;
            return out;
        }
        row.push_back(left);
        for (double& value : rest)
            value /= left;
        out.orthonormal.push_back(std::move(rest));
        out.upper.push_back(std::move(row));
    }
    return out;
}

/// x of R x = y.
std::vector<double> back_substituted(const Triangle& triangle, std::vector<double> y) {
    for (std::size_t k = y.size(); k-- > 0;) {
        y[k] /= triangle.upper[k][k];
        for (std::size_t i = 0; i < k; ++i)
            y[i] -= triangle.upper[k][i] * y[k];
    }
    return y;
}

} // namespace

CourseColumn beside_cell_means(const RunCourse& course, CourseColumn column) {
    std::map<int, std::pair<double, int>> cells;
    for (std::size_t i = 0; i < column.size(); ++i) {
        auto& [sum, count] = cells[course.points[i].cell];
        sum += column[i];
        ++count;
    }
    for (std::size_t i = 0; i < column.size(); ++i) {
        const auto& [sum, count] = cells[course.points[i].cell];
        column[i] -= sum / count;
    }
    return column;
}

CourseFit fit_course(const CourseColumn& deviation_um,
                     std::span<const CourseColumn* const> columns,
                     int degrees_of_freedom) {
    CourseFit fit;
    const Triangle triangle = triangle_of(columns);
    const int left = degrees_of_freedom - static_cast<int>(columns.size());
    if (!triangle.full_rank || left < 1) return fit;
    CourseColumn rest = deviation_um;
    std::vector<double> along;
    for (const CourseColumn& column : triangle.orthonormal) {
        along.push_back(dot(column, rest));
        take_off(rest, along.back(), column);
    }
    fit.solvable = true;
    fit.residual_um2 = dot(rest, rest);
    fit.coefficients = back_substituted(triangle, along);
    const double s_um = std::sqrt(fit.residual_um2 / left);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < columns.size(); ++j) {
            std::vector<double> unit(columns.size(), 0.0);
            unit[j] = 1;
            const double entry = back_substituted(triangle, std::move(unit))[k];
            sum += entry * entry;
        }
        fit.standard_uncertainties.push_back(s_um * std::sqrt(sum));
    }
    return fit;
}

} // namespace axiscal

#include "analysis/setup/course_drift.hpp"

#include "analysis/setup/course_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace axiscal {

std::optional<CourseDrift> drift_of(const RunCourse& course) {
    constexpr std::size_t fewest_points = 20;
    if (course.points.size() < fewest_points) return std::nullopt;
    CourseColumn deviation_um, hours;
    std::set<int> cells;
    for (const CoursePoint& point : course.points) {
        deviation_um.push_back(point.deviation_um);
        hours.push_back(point.seconds / 3600);
        cells.insert(point.cell);
    }
    const double lasted_h = hours.back() - hours.front();
    const CourseColumn in_time = beside_cell_means(course, std::move(hours));
    constexpr double rounding = 1e-9; // of the mean of equal times
    if (std::ranges::all_of(in_time, [&](double h) { return std::fabs(h) <= rounding * lasted_h; }))
        return std::nullopt;
    const std::array<const CourseColumn*, 1> columns{&in_time};
    const int freedom = static_cast<int>(course.points.size() - cells.size());
    const CourseFit fit =
        fit_course(beside_cell_means(course, std::move(deviation_um)), columns, freedom);
    if (!fit.solvable) return std::nullopt;
    return CourseDrift{std::fabs(fit.coefficients.front()) * lasted_h,
                       fit.standard_uncertainties.front() * lasted_h};
}

} // namespace axiscal

#pragma once
// How much of a run's scatter a few columns over time explain. Pure.

#include "analysis/setup/run_course.hpp"

#include <span>
#include <vector>

namespace axiscal {

/// One value for each point of a course.
using CourseColumn = std::vector<double>;

/// Without the mean of each cell: what cannot be told from the machine's own error is gone.
CourseColumn beside_cell_means(const RunCourse& course, CourseColumn column);

struct CourseFit {
    bool solvable = false;            ///< no column is a sum of others, or constant in each cell
    double residual_um2 = 0;          ///< sum of squares
    std::vector<double> coefficients; ///< um for one of each column
    std::vector<double> standard_uncertainties;
};

/// Least squares by Gram-Schmidt. All columns are beside_cell_means(); two or three are usual.
/// @param degrees_of_freedom  without columns: points - cells
CourseFit fit_course(const CourseColumn& deviation_um,
                     std::span<const CourseColumn* const> columns,
                     int degrees_of_freedom);

} // namespace axiscal

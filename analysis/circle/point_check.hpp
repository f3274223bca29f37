#pragma once
// What every circle fit asks of its points first. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace axiscal::circle {

using Values = std::span<const double>;

struct Box {
    double low_x = 0, high_x = 0, low_y = 0, high_y = 0;
    [[nodiscard]] double extent() const;    ///< of its diagonal
    [[nodiscard]] double magnitude() const; ///< largest |coordinate|
};

struct CheckedPoints {
    Box box;
    double mean_x = 0, mean_y = 0;
    std::vector<std::size_t> distinct; ///< as first_distinct()
};

/// Indices of the first distinct points, `enough` at most. Of four: three are a circle's own.
std::vector<std::size_t> first_distinct(Values x, Values y, std::size_t enough = 4);

/// @errors Fault::bad_case: lists of different length, a coordinate that is not finite or beyond
/// 1e12 ("points[7]"), fewer than three distinct points ("points").
Result<CheckedPoints> check_points(Values x, Values y);

/// What a fit that found no circle says.
tl::unexpected<Error> refuse_line();

} // namespace axiscal::circle

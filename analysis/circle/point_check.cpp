#include "analysis/circle/point_check.hpp"

#include "analysis/circle/point_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace axiscal::circle {
namespace {

/// Far beyond any machine in any unit, far below where a fourth power overflows.
constexpr double largest_magnitude = 1e12;
/// Far below any instrument in any unit, far above where a fourth power vanishes.
constexpr double smallest_extent = 1e-30;

tl::unexpected<Error> refuse_coordinate(Values x, Values y) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::string field = "points[" + std::to_string(i) + "]";
        for (const double value : {x[i], y[i]}) {
            if (!std::isfinite(value))
                return refuse(Fault::bad_case, field, "is not a finite number");
            if (std::fabs(value) > largest_magnitude)
                return refuse(Fault::bad_case, field, "is larger than 1e12, beyond any machine");
        }
    }
    return refuse(Fault::internal, "points", "were found wrong without a wrong coordinate");
}

} // namespace

std::vector<std::size_t> first_distinct(Values x, Values y, std::size_t enough) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < x.size() && found.size() < enough; ++i)
        if (std::ranges::none_of(found, [&](auto j) { return x[i] == x[j] && y[i] == y[j]; }))
            found.push_back(i);
    return found;
}

double Box::extent() const {
    return std::sqrt((high_x - low_x) * (high_x - low_x) + (high_y - low_y) * (high_y - low_y));
}

double Box::magnitude() const {
    return std::max({std::fabs(low_x), std::fabs(high_x), std::fabs(low_y), std::fabs(high_y)});
}

Result<CheckedPoints> check_points(Values x, Values y) {
    if (x.size() != y.size())
        return refuse(Fault::bad_case, "points", "have not as many x as y coordinates");
    if (x.empty()) return refuse(Fault::bad_case, "points", "are missing; a circle needs three");
    const Survey seen = survey(x, y);
    const Box box{seen.low_x, seen.high_x, seen.low_y, seen.high_y};
    // a NaN can hide from the bounds, not from the sums
    if (!std::isfinite(seen.sum_x + seen.sum_y) || box.magnitude() > largest_magnitude)
        return refuse_coordinate(x, y);
    auto distinct = first_distinct(x, y);
    if (distinct.size() < 3)
        return refuse(Fault::bad_case, "points",
                      "hold " + std::to_string(distinct.size()) +
                          " distinct point(s); a circle needs three");
    if (box.extent() < smallest_extent)
        return refuse(Fault::bad_case, "points",
                      "lie within 1e-30 of each other: no circle can be fitted");
    const auto n = static_cast<double>(x.size());
    return CheckedPoints{box, seen.sum_x / n, seen.sum_y / n, std::move(distinct)};
}

tl::unexpected<Error> refuse_line() {
    return refuse(Fault::bad_case, "points", "lie on a line: no circle fits them");
}

} // namespace axiscal::circle

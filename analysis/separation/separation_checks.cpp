// What a separation accepts, and the sum of nine curves at a point.

#include "analysis/separation/error_separation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace axiscal {
namespace {

constexpr double largest = 1e12;

std::string at(const std::string& field, std::size_t index) {
    return field + "[" + std::to_string(index) + "]";
}
std::string axis_name(std::size_t axis) {
    return std::string(1, static_cast<char>('x' + axis));
}

Result<void> check_range(const AxisRange& range, const std::string& field) {
    AXISCAL_CHECK(check_number(range.from, at(field, 0)));
    AXISCAL_CHECK(check_number(range.to, at(field, 1)));
    const double size = std::max(std::fabs(range.from), std::fabs(range.to));
    // below 1e-9 of the coordinate the normalised one has no digits left
    if (!(range.to - range.from > 1e-9 * size))
        return refuse(Fault::bad_case, field, "must rise from its first number to its second");
    return {};
}

Result<void> check_row(const SeparationModel& model, std::size_t direction) {
    const auto& orders = model.orders[direction];
    if (orders[0] + orders[1] + orders[2] == 0)
        return refuse(Fault::bad_case, "order", "leaves row " + axis_name(direction) + " empty");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (orders[axis] > highest_separation_order)
            return refuse(Fault::bad_case, "order", "must not be above 20");
        if (std::fabs(model.signs[direction][axis]) != 1)
            return refuse(Fault::bad_case, at(at("signs", direction), axis), "must be 1 or -1");
    }
    return {};
}

} // namespace

Result<void> check_number(double value, const std::string& field) {
    if (!std::isfinite(value)) return refuse(Fault::bad_case, field, "is not a finite number");
    if (std::fabs(value) > largest) return refuse(Fault::bad_case, field, "is larger than 1e12");
    return {};
}

Result<void> check_point(const SeparationModel& model,
                         const PerAxis<double>& point_mm,
                         const std::string& field) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        AXISCAL_CHECK(check_number(point_mm[axis], at(field, axis)));
        if (!model.ranges_mm[axis].holds(point_mm[axis]))
            return refuse(Fault::bad_case, at(field, axis),
                          "lies outside ranges_mm." + axis_name(axis));
    }
    return {};
}

Result<void> check_model(const SeparationModel& model) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        AXISCAL_CHECK(check_range(model.ranges_mm[axis], "ranges_mm." + axis_name(axis)));
    AXISCAL_CHECK(check_point(model, model.reference_mm, "reference_mm"));
    for (std::size_t direction = 0; direction < 3; ++direction)
        AXISCAL_CHECK(check_row(model, direction));
    return {};
}

Result<void> check_separation(const SeparationCase& stated) {
    AXISCAL_CHECK(check_model(stated.model));
    if (stated.points_mm.empty()) return refuse(Fault::bad_case, "points_mm", "is empty");
    if (stated.deviation_um.size() != stated.points_mm.size())
        return refuse(Fault::bad_case, "deviation_um",
                      "must have one row a point, " + std::to_string(stated.points_mm.size()) +
                          ", not " + std::to_string(stated.deviation_um.size()));
    for (std::size_t i = 0; i < stated.points_mm.size(); ++i) {
        const std::string index = "[" + std::to_string(i) + "]";
        AXISCAL_CHECK(check_point(stated.model, stated.points_mm[i], "points_mm" + index));
        for (std::size_t axis = 0; axis < 3; ++axis)
            AXISCAL_CHECK(check_number(stated.deviation_um[i][axis],
                                       "deviation_um" + index + "[" + std::to_string(axis) + "]"));
    }
    return {};
}

PerAxis<double> deviation_from(const PerCurve<std::vector<double>>& coefficients_um,
                               const SeparationModel& model,
                               const PerAxis<double>& point_mm) {
    PerAxis<double> deviation{};
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            deviation[a] += model.signs[a][b] * curve_at(coefficients_um[a][b], model.ranges_mm[b],
                                                         model.reference_mm[b], point_mm[b]);
    return deviation;
}

} // namespace axiscal

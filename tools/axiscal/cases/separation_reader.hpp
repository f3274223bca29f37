#pragma once
// The members that both kinds of `error_separation` share. Pure.

#include "analysis/separation/error_separation.hpp"
#include "tools/axiscal/cases/case_reader.hpp"

#include <string>

namespace axiscal {

/// "x", "y", "z"
std::string axis_letter(std::size_t axis);
/// "xy": direction, then moving axis.
std::string curve_name(std::size_t direction, std::size_t axis);

Result<PerAxis<double>> triple_of(const nlohmann::json& array, const std::string& field);

/// Orders as stated: one number, [nx,ny,nz], or a row for each direction; "auto" gives nothing.
struct StatedOrders {
    PerCurve<std::size_t> orders{};
    std::optional<std::size_t> highest; ///< "auto": up to this one
};
Result<StatedOrders> orders_of(const nlohmann::json& object);

/// signs (default 1, 1, -1 each row), ranges_mm, reference_mm; orders are left at their default.
Result<SeparationModel> model_of(const nlohmann::json& object, const std::string& prefix = "");

nlohmann::ordered_json model_to_json(const SeparationModel& model);
/// "Dx = dxx(x) + dxy(y) - dxz(z); ..."
std::string convention_of(const PerCurve<double>& signs);

/// Curves by "xx"; a missing one is empty. Refuses unknown names and orders above 20.
Result<PerCurve<std::vector<double>>> terms_of(const nlohmann::json& object,
                                               const std::string& field);

} // namespace axiscal

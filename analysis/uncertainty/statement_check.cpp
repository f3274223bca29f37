// What a budget may be made of: sizes, companions, and no term of a linear axis on a rotary one.

#include "analysis/uncertainty/budget.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

struct Field {
    std::string key; ///< as the contract names it: lengths end in the unit of the axis
    std::optional<double> value;
    bool linear_only = true;
};
using Fields = std::vector<Field>;

Fields fields_of(const UncertaintyStatement& s) {
    const std::string unit = s.axis_kind == AxisKind::rotary ? "_arcsec" : "_um";
    return {{"device_U" + unit, s.device_U, false},
            {"device_width" + unit, s.device_width, false},
            {"k", s.device_k, false},
            {"eve" + unit, s.eve, false},
            {"length_m", s.length_m},
            {"misalignment_mm", s.misalignment_mm},
            {"misalignment_rad", s.misalignment_rad},
            {"expansion_per_K", s.alpha_um_per_m_K},
            {"temperature_width_K", s.temperature_width_K},
            {"temperature_offset_K", s.temperature_offset_K},
            {"expansion_width_per_K", s.alpha_width_um_per_m_K},
            {"device_expansion_per_K", s.device_alpha_um_per_m_K},
            {"device_temperature_width_K", s.device_temperature_width_K},
            {"device_temperature_offset_K", s.device_temperature_offset_K},
            {"device_expansion_width_per_K", s.device_alpha_width_um_per_m_K}};
}

/// Every stated number is finite and of a size that instruments have; an offset may be below 20.
Result<void> check_sizes(const Fields& fields) {
    constexpr double largest = 1e9, smallest = 1e-6; // of what others are divided by
    for (const auto& [key, value, linear_only] : fields) {
        if (!value) continue;
        const bool may_be_negative = key.ends_with("temperature_offset_K");
        if (!(std::fabs(*value) <= largest) || (*value < 0 && !may_be_negative))
            return refuse(Fault::bad_case, key,
                          may_be_negative ? "must be a number of magnitude up to 1e9"
                                          : "must be a number from 0 to 1e9");
        constexpr double no_material = 1000; // um/(m K); plastics have 200
        if (*value > no_material && key.find("expansion") != key.npos)
            return refuse(Fault::bad_case, key,
                          "is above 0.001 per kelvin, as no material is: 11.7 um/(m K) are 1.17e-5");
        if (*value < smallest && (key == "k" || key == "length_m"))
            return refuse(Fault::bad_case, key, "must be above 1e-6");
    }
    return {};
}

bool is_stated(const Fields& fields, std::string_view key) {
    return std::ranges::find(fields, key, &Field::key)->value.has_value();
}

Result<void> check_once(const Fields& fields, const std::string& first, const std::string& second) {
    if (!is_stated(fields, first) || !is_stated(fields, second)) return {};
    return refuse(Fault::bad_case, second, "stands beside '" + first + "'; one of them is enough");
}

/// A factor without its companion would silently give a term of zero.
Result<void> check_companions(const Fields& fields) {
    const std::string_view device = fields.front().key;
    const std::pair<std::string_view, std::string_view> companions[]{
        {device, "k"},
        {"k", device},
        {"misalignment_mm", "length_m"},
        {"misalignment_rad", "length_m"},
        {"temperature_width_K", "length_m"},
        {"temperature_width_K", "expansion_per_K"},
        {"expansion_width_per_K", "length_m"},
        {"expansion_width_per_K", "temperature_offset_K"},
        {"device_temperature_width_K", "length_m"},
        {"device_temperature_width_K", "device_expansion_per_K"},
        {"device_expansion_width_per_K", "length_m"},
        {"device_expansion_width_per_K", "device_temperature_offset_K"}};
    for (const auto& [key, companion] : companions)
        if (is_stated(fields, key) && !is_stated(fields, companion))
            return refuse(Fault::bad_case, std::string{companion},
                          "is missing; '" + std::string{key} + "' needs it");
    return {};
}

/// The formulas of L hold for a beam that is nearly along the axis.
Result<void> check_angle(const UncertaintyStatement& s) {
    constexpr double largest_rad = 0.1, mm_per_m = 1000;
    if (s.misalignment_rad && *s.misalignment_rad > largest_rad)
        return refuse(Fault::bad_case, "misalignment_rad", "is above 0.1 rad: no alignment");
    if (s.misalignment_mm && *s.misalignment_mm > largest_rad * mm_per_m * *s.length_m)
        return refuse(Fault::bad_case, "misalignment_mm", "is above a tenth of the length");
    return {};
}

/// A rotary axis has no temperature, expansion or misalignment of its own: they are in the device.
Result<void> check_rotary(const Fields& fields) {
    for (const Field& field : fields)
        if (field.linear_only && field.value)
            return refuse(Fault::bad_case, field.key,
                          "belongs to a linear axis; the budget of a rotary axis has device and "
                          "environment alone");
    return {};
}

} // namespace

Result<void> check_statement(const UncertaintyStatement& statement) {
    const Fields fields = fields_of(statement);
    if (statement.axis_kind == AxisKind::rotary) AXISCAL_CHECK(check_rotary(fields));
    AXISCAL_CHECK(check_sizes(fields));
    AXISCAL_CHECK(check_once(fields, fields[0].key, fields[1].key));
    AXISCAL_CHECK(check_once(fields, "misalignment_mm", "misalignment_rad"));
    AXISCAL_CHECK(check_companions(fields));
    return check_angle(statement);
}

} // namespace axiscal

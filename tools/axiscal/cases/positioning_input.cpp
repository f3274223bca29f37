#include "tools/axiscal/cases/positioning_input.hpp"

#include "tools/axiscal/cases/reference_angles_member.hpp"

#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

void subtract_targets(DeviationTable& table) {
    for (auto* rows : {&table.forward, &table.backward})
        for (std::size_t i = 0; i < rows->size(); ++i)
            for (double& value : (*rows)[i])
                value -= table.targets[i];
}

Result<DeviationTable> table_of(const json& object) {
    DeviationTable table;
    AXISCAL_TRY(table.targets, numbers_at(object, "targets", "targets"));
    if (table.targets.empty()) // else the rows, of which none is right then, would be named
        return refuse(Fault::bad_case, "targets", "is empty; at least one target is needed");
    AXISCAL_TRY(const json* forward, member(object, "forward", "forward"));
    AXISCAL_TRY(table.forward, rows_of(*forward, "forward"));
    if (object.contains("backward")) {
        AXISCAL_TRY(table.backward, rows_of(object.at("backward"), "backward"));
    }
    return table;
}

Result<void> check_compensation(const json& object) {
    if (!object.contains("compensation")) return {};
    AXISCAL_TRY(const auto stated,
                one_of(object, "compensation", "compensation", {"already_at_20C"}));
    return {};
}

/// "positions" or "deviations".
Result<std::string> readings_of(const json& object, const CaseAxis& axis) {
    AXISCAL_TRY(std::string readings,
                one_of(object, "readings", "readings", {"positions", "deviations"}));
    if (readings == "positions" && axis.unit != axis.target_unit)
        return refuse(Fault::bad_case, "target_unit",
                      "must be the unit of the readings where these are positions");
    return readings;
}

} // namespace

Result<const PositioningStandard*> standard_of(const json& object) {
    Words names;
    for (const PositioningStandard& standard : positioning_standards())
        names.emplace_back(standard.name);
    AXISCAL_TRY(const std::string name, one_of(object, "standard", "standard", names));
    return find_positioning_standard(name);
}

Result<CaseAxis> axis_of(const json& object) {
    AXISCAL_TRY(const json* stated, member(object, "axis", "axis"));
    AXISCAL_CHECK(check_object(*stated, "axis", {"name", "kind"}));
    CaseAxis axis;
    AXISCAL_TRY(axis.name, text_of(*stated, "name", "axis.name"));
    AXISCAL_TRY(const std::string kind, one_of(*stated, "kind", "axis.kind", {"linear", "rotary"}));
    axis.kind = kind == "linear" ? AxisKind::linear : AxisKind::rotary;
    const Words units =
        axis.kind == AxisKind::linear ? Words{"mm", "um", "m"} : Words{"deg", "arcsec"};
    AXISCAL_TRY(axis.unit, one_of(object, "unit", "unit", units));
    axis.target_unit = axis.unit;
    if (object.contains("target_unit")) {
        AXISCAL_TRY(axis.target_unit, one_of(object, "target_unit", "target_unit", units));
    }
    return axis;
}

double base_units_in(const std::string& unit) {
    if (unit == "um") return 1e-3;
    if (unit == "m") return 1e3;
    if (unit == "arcsec") return 1.0 / 3600;
    return 1;
}

Result<PositioningInput> positioning_input_of(const json& object) {
    AXISCAL_TRY(const PositioningStandard* standard, standard_of(object));
    AXISCAL_TRY(CaseAxis axis, axis_of(object));
    AXISCAL_TRY(const std::string readings, readings_of(object, axis));
    AXISCAL_CHECK(check_compensation(object));
    AXISCAL_TRY(DeviationTable table, table_of(object));
    table.unit = axis.unit;
    // positions are first checked as they came: the shape must be right and the numbers sane
    AXISCAL_TRY(const RunAt20C as_it_came, declare_at_20C(table, "as it came"));
    if (readings == "positions") subtract_targets(table);
    AXISCAL_CHECK(take_out_artefact(object, axis, table));
    AXISCAL_TRY(RunAt20C run,
                declare_at_20C(std::move(table), "a case is taken as measured at 20 degC"));
    return PositioningInput{std::move(axis), standard, std::move(run)};
}

} // namespace axiscal

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

/// What stands in the rows of a case.
struct Rows20C {
    DeviationTable table;
    int expected = 0;
    std::vector<std::string> missing;
};

/// `null` is a reading that is missing. All rows must state as many, though.
Result<Rows> rows_with_gaps(const json& object, const std::string& key, Rows20C& out) {
    json present = json::array();
    const json& rows = object.at(key);
    for (std::size_t i = 0; rows.is_array() && i < rows.size(); ++i) {
        json row = rows[i].is_array() ? json::array() : rows[i];
        for (std::size_t j = 0; rows[i].is_array() && j < rows[i].size(); ++j) {
            ++out.expected;
            if (rows[i][j].is_null())
                out.missing.push_back(indexed(indexed(key, i), j));
            else
                row.push_back(rows[i][j]);
        }
        if (rows[i].is_array() && rows[0].is_array() && !rows[0].empty() &&
            rows[i].size() != rows[0].size())
            return refuse(Fault::bad_case, indexed(key, i),
                          "has " + std::to_string(rows[i].size()) + " readings where " + key +
                              "[0] has " + std::to_string(rows[0].size()) +
                              "; null stands for one that is missing");
        present.push_back(std::move(row));
    }
    return rows_of(rows.is_array() ? present : rows, key);
}

Result<Rows20C> table_of(const json& object) {
    Rows20C out;
    DeviationTable& table = out.table;
    AXISCAL_TRY(table.targets, numbers_at(object, "targets", "targets"));
    if (table.targets.empty()) // else the rows, of which none is right then, would be named
        return refuse(Fault::bad_case, "targets", "is empty; at least one target is needed");
    AXISCAL_TRY([[maybe_unused]] const json* forward, member(object, "forward", "forward"));
    AXISCAL_TRY(table.forward, rows_with_gaps(object, "forward", out));
    if (object.contains("backward")) {
        AXISCAL_TRY(table.backward, rows_with_gaps(object, "backward", out));
    }
    return out;
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
    AXISCAL_TRY(Rows20C rows, table_of(object));
    DeviationTable& table = rows.table;
    const RowLengths lengths = rows.missing.empty() ? RowLengths::equal : RowLengths::any;
    if (lengths == RowLengths::any && !standard->is_iso())
        return refuse(Fault::bad_case, rows.missing.front(),
                      "is missing: a figure of this style needs all readings");
    table.unit = axis.unit;
    // positions are first checked as they came: the shape must be right and the numbers sane
    AXISCAL_TRY(const RunAt20C as_it_came, declare_at_20C(table, "as it came", lengths));
    if (readings == "positions") subtract_targets(table);
    AXISCAL_CHECK(take_out_artefact(object, axis, table));
    AXISCAL_TRY(RunAt20C run, declare_at_20C(std::move(table),
                                             "a case is taken as measured at 20 degC", lengths));
    return PositioningInput{std::move(axis), standard, std::move(run), rows.expected,
                            std::move(rows.missing)};
}

} // namespace axiscal

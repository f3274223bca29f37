#include "tools/axiscal/cases/case_table.hpp"

#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/table_columns.hpp"

#include <algorithm>
#include <map>

namespace axiscal {
namespace {

using nlohmann::json;

constexpr std::string_view template_hint = "; 'axiscal case new KIND --csv FILE' writes a template";

tl::unexpected<Error>
refuse_column(const CaseTable& table, const std::string& name, std::string why) {
    return refuse(Fault::bad_case,
                  "table line " + std::to_string(table.header.line) + ", column " + printable(name),
                  std::move(why) + std::string{template_hint});
}

std::string place_of(const CaseTable& table, const TableRow& row, std::size_t column) {
    return "table line " + std::to_string(row.line) + ", column " +
           printable(table.header.cells[column]);
}

/// A statement's value: JSON where it is (a number, true, an object), else the words.
json value_of(const std::string& text) {
    json value = json::parse(text, nullptr, false);
    const bool number = value.is_number() || value.is_boolean() || value.is_structured();
    return !value.is_discarded() && number ? value : json(text);
}

/// "uncertainty.eve_um" is a member of a member. False where that is stated as something else.
bool put(json& object, const std::string& key, json value) {
    const auto point = key.find('.');
    if (point == std::string::npos) {
        object[key] = std::move(value);
        return true;
    }
    json& member = object[key.substr(0, point)];
    if (!member.is_null() && !member.is_object()) return false;
    return put(member, key.substr(point + 1), std::move(value));
}

Result<json> statements_of(const CaseTable& table) {
    const Words columns{"targets", "forward", "backward", "traces"};
    json object = json::object();
    for (const auto& [key, text] : table.statements) {
        if (std::ranges::find(columns, key) != columns.end())
            return refuse(Fault::bad_case, printable(key),
                          "is made of the table's columns: leave the line out");
        if (!put(object, key, value_of(text)))
            return refuse(Fault::bad_case, printable(key),
                          "is a member of what another line states as a whole");
    }
    return object;
}

/// The unit of some columns, from their headings or the statement `key`; one of both must tell it.
Result<std::string> common_unit(const CaseTable& table,
                                const std::vector<std::size_t>& columns,
                                const json& stated,
                                const std::string& key) {
    const std::string usual = key == "target_unit" ? "mm" : "um";
    std::string unit =
        stated.contains(key) && stated.at(key).is_string() ? stated.at(key).get<std::string>() : "";
    for (const std::size_t column : columns) {
        const std::string own = heading_of(table.header.cells[column]).unit;
        if (own.empty() || own == unit) continue;
        if (!unit.empty())
            return refuse_column(table, table.header.cells[column],
                                 "is in '" + printable(own) + "' where another states '" +
                                     printable(unit) + "': one unit for all");
        unit = own;
    }
    if (!unit.empty()) return unit;
    return refuse_column(table, table.header.cells[columns.front()],
                         "states no unit: write \"" +
                             heading_of(table.header.cells[columns.front()]).name + " [" + usual +
                             "]\", or \"# " + key + ": " + usual + "\" above the header");
}

/// Of a table whose numbers have both points and commas, the commas are no decimal ones.
Result<void> check_marks(const CaseTable& table) {
    bool point = false;
    for (const TableRow& row : table.rows)
        for (const std::string& cell : row.cells)
            point = point || (cell.find('.') != std::string::npos &&
                              cell.find_first_not_of("+-.0123456789eE ") == std::string::npos);
    for (const TableRow& row : table.rows)
        for (std::size_t at = 0; point && at < row.cells.size(); ++at)
            if (row.cells[at].find(',') != std::string::npos &&
                row.cells[at].find_first_not_of("+-,0123456789eE ") == std::string::npos)
                return refuse(Fault::bad_case, place_of(table, row, at),
                              "has a comma where other numbers have a point");
    return {};
}

Result<double> reading_at(const CaseTable& table, const TableRow& row, std::size_t column) {
    if (row.cells[column].empty())
        return refuse(Fault::bad_case, place_of(table, row, column),
                      "is empty: every target needs all its readings");
    return number_in_cell(row.cells[column], table.separator, place_of(table, row, column));
}

/// A row a reading: which column holds what.
struct LongForm {
    std::size_t target = 0, reading = 0, direction = 0;
    std::string readings; ///< "deviations" or "positions"; empty: the heading does not say
};

std::optional<std::size_t> column_named(const CaseTable& table, const Words& names) {
    for (std::size_t at = 0; at < table.header.cells.size(); ++at)
        if (std::ranges::find(names, lower(heading_of(table.header.cells[at]).name)) != names.end())
            return at;
    return std::nullopt;
}

/// Nothing where the table has a column a reading.
Result<std::optional<LongForm>> long_form_of(const CaseTable& table) {
    const auto deviation = column_named(table, {"deviation", "deviations", "error"});
    const auto position = column_named(table, {"position", "positions"});
    const auto other = column_named(table, {"reading", "readings", "value"});
    if (!deviation && !position && !other) return std::optional<LongForm>{};
    const auto direction = column_named(table, {"direction", "dir"});
    if (!direction)
        return refuse_column(table, table.header.cells.back(),
                             "stands without a column \"direction\" of + and -");
    LongForm form;
    form.target = column_named(table, {"target", "targets"}).value_or(0);
    form.direction = *direction;
    form.reading = deviation ? *deviation : position ? *position : *other;
    form.readings = deviation ? "deviations" : position ? "positions" : "";
    return std::optional{form};
}

/// Readings of a target and direction in the order of their rows.
Result<void> read_long_rows(const CaseTable& table, const LongForm& form, json& object) {
    std::vector<double> targets;
    std::map<double, std::pair<json, json>> readings;
    for (const TableRow& row : table.rows) {
        AXISCAL_TRY(const double target, reading_at(table, row, form.target));
        json reading; // an empty cell: it is missing
        if (!row.cells[form.reading].empty()) {
            AXISCAL_TRY(reading, reading_at(table, row, form.reading));
        }
        const auto approach = approach_of(row.cells[form.direction]);
        if (!approach)
            return refuse(Fault::bad_case, place_of(table, row, form.direction),
                          "must be + or -, forward or backward, up or down");
        if (!readings.contains(target)) targets.push_back(target);
        auto& [forward, backward] = readings[target];
        (approach->forward ? forward : backward).push_back(std::move(reading));
    }
    const bool both =
        std::ranges::any_of(readings, [](const auto& one) { return !one.second.second.is_null(); });
    for (const double target : targets) {
        auto& [forward, backward] = readings[target];
        object["targets"].push_back(target);
        object["forward"].push_back(forward.is_null() ? json::array() : std::move(forward));
        if (both)
            object["backward"].push_back(backward.is_null() ? json::array() : std::move(backward));
    }
    return {};
}

using ApproachColumns = std::map<Approach, std::size_t>;

Result<ApproachColumns> approach_columns(const CaseTable& table) {
    ApproachColumns columns;
    for (std::size_t at = 1; at < table.header.cells.size(); ++at) {
        const std::string& cell = table.header.cells[at];
        const auto approach = approach_of(heading_of(cell).name);
        if (!approach)
            return refuse_column(table, cell,
                                 "names no approach: write \"run1 +\" and \"run1 -\", or "
                                 "\"forward 1\" and \"backward 1\"");
        if (!columns.try_emplace(*approach, at).second)
            return refuse_column(table, cell, "stands twice");
    }
    if (columns.empty())
        return refuse_column(table, table.header.cells[0], "stands alone: no column of readings");
    return columns;
}

std::vector<std::size_t> places_of(const ApproachColumns& columns) {
    std::vector<std::size_t> places;
    for (const auto& [approach, column] : columns)
        places.push_back(column);
    return places;
}

Result<void> read_rows(const CaseTable& table, const ApproachColumns& columns, json& object) {
    for (const TableRow& row : table.rows) {
        AXISCAL_TRY(const double target, reading_at(table, row, 0));
        object["targets"].push_back(target);
        json forward = json::array(), backward = json::array();
        for (const auto& [approach, column] : columns) {
            json reading; // an empty cell: it is missing
            if (!row.cells[column].empty()) {
                AXISCAL_TRY(reading, reading_at(table, row, column));
            }
            (approach.forward ? forward : backward).push_back(std::move(reading));
        }
        if (!forward.empty()) object["forward"].push_back(std::move(forward));
        if (!backward.empty()) object["backward"].push_back(std::move(backward));
    }
    return {};
}

/// What a table need not say.
Result<void> complete_positioning(json& object) {
    if (!object.contains("readings"))
        return refuse(
            Fault::bad_case, "readings",
            "is not stated: write \"# readings: deviations\" or \"# readings: positions\" "
            "above the header" +
                std::string{template_hint});
    const json unit = object["target_unit"];
    json axis = object.value("axis", json("X"));
    if (axis.is_string())
        axis = {{"name", axis}, {"kind", unit == "deg" || unit == "arcsec" ? "rotary" : "linear"}};
    object["axis"] = std::move(axis);
    if (!object.contains("standard")) object["standard"] = "ISO 230-2:2014";
    object["analysis"] = "positioning";
    return {};
}

Result<json> long_positioning_of(const CaseTable& table, const LongForm& form) {
    AXISCAL_TRY(json object, statements_of(table));
    AXISCAL_TRY(object["target_unit"], common_unit(table, {form.target}, object, "target_unit"));
    AXISCAL_TRY(object["unit"], common_unit(table, {form.reading}, object, "unit"));
    if (!object.contains("readings") && !form.readings.empty()) object["readings"] = form.readings;
    AXISCAL_CHECK(complete_positioning(object));
    AXISCAL_CHECK(read_long_rows(table, form, object));
    return object;
}

Result<json> positioning_of(const CaseTable& table) {
    AXISCAL_TRY(const auto form, long_form_of(table));
    if (form) return long_positioning_of(table, *form);
    AXISCAL_TRY(json object, statements_of(table));
    AXISCAL_TRY(const ApproachColumns columns, approach_columns(table));
    AXISCAL_TRY(object["target_unit"], common_unit(table, {0}, object, "target_unit"));
    AXISCAL_TRY(object["unit"], common_unit(table, places_of(columns), object, "unit"));
    AXISCAL_CHECK(complete_positioning(object));
    AXISCAL_CHECK(read_rows(table, columns, object));
    return object;
}

/// One sense: its angles, and its deviations in mm.
Result<json> trace_of(const CaseTable& table, std::size_t column, const std::string& angle_unit) {
    const Heading heading = heading_of(table.header.cells[column]);
    const std::string sense = lower(heading.name);
    if (sense != "ccw" && sense != "cw")
        return refuse_column(table, table.header.cells[column], "must be \"ccw\" or \"cw\"");
    if (heading.unit != "mm" && heading.unit != "um")
        return refuse_column(table, table.header.cells[column],
                             "states no unit: write \"" + sense + " [um]\" or \"" + sense +
                                 " [mm]\"");
    const std::string angles = "angle_" + angle_unit;
    json trace{{"sense", sense}, {angles, json::array()}, {"radial_deviation_mm", json::array()}};
    for (const TableRow& row : table.rows) {
        if (row.cells[column].empty()) continue;
        AXISCAL_TRY(const double angle, reading_at(table, row, 0));
        AXISCAL_TRY(const double deviation, reading_at(table, row, column));
        trace[angles].push_back(angle);
        trace["radial_deviation_mm"].push_back(heading.unit == "um" ? deviation / 1000 : deviation);
    }
    return trace;
}

Result<json> circular_of(const CaseTable& table) {
    AXISCAL_TRY(json object, statements_of(table));
    object["analysis"] = "circular";
    const std::string unit = heading_of(table.header.cells[0]).unit;
    if (unit != "deg" && unit != "rad")
        return refuse_column(table, table.header.cells[0],
                             "states no unit: write \"angle [deg]\" or \"angle [rad]\"");
    for (std::size_t column = 1; column < table.header.cells.size(); ++column) {
        AXISCAL_TRY(json trace, trace_of(table, column, unit));
        object["traces"].push_back(std::move(trace));
    }
    return object;
}

} // namespace

std::optional<TableKind> kind_of_table(std::string_view utf8) {
    Words names;
    for (std::string& cell : header_cells_of(utf8))
        names.push_back(lower(heading_of(std::move(cell)).name));
    if (names.empty()) return std::nullopt;
    if (names.front() == "angle") return TableKind::circular;
    if (names.front() == "feature") return TableKind::workpiece;
    const bool has_target = std::ranges::any_of(
        names, [](const std::string& name) { return name == "target" || name == "targets"; });
    return has_target ? std::optional{TableKind::positioning} : std::nullopt;
}

Result<json> case_of_table(const CaseTable& table, TableKind kind) {
    if (table.rows.empty())
        return refuse(Fault::bad_case, "table", "holds no row below its header");
    AXISCAL_CHECK(check_marks(table));
    return kind == TableKind::circular ? circular_of(table) : positioning_of(table);
}

} // namespace axiscal

#include "tools/axiscal/cases/case_table.hpp"

#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
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

/// "run1 + [um]" is the name "run1 +" in "um"; also with round brackets or "target_mm".
struct Heading {
    std::string name, unit;
};

std::string unit_word(std::string unit) {
    if (unit == "\xc2\xb5m" || unit == "\xce\xbcm") return "um"; // both letters mu
    if (unit == "\xc2\xb0") return "deg";
    return unit;
}

Heading heading_of(std::string text) {
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        const auto begin = text.rfind(open);
        if (begin == std::string::npos || text.empty() || text.back() != close) continue;
        std::string unit = text.substr(begin + 1, text.size() - begin - 2);
        const auto end = text.find_last_not_of(' ', begin == 0 ? 0 : begin - 1);
        return {text.substr(0, end + 1), unit_word(std::move(unit))};
    }
    for (const std::string unit : {"mm", "um", "deg", "rad", "arcsec"})
        if (text.ends_with("_" + unit))
            return {text.substr(0, text.size() - unit.size() - 1), unit};
    return {std::move(text), ""};
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return text;
}

/// One reading of a target: the word or sign of its direction, and its number.
struct Approach {
    bool forward = true;
    int number = 1;
    auto operator<=>(const Approach&) const = default;
};

bool is_word_in(const std::string& name, std::string_view word) {
    const auto at = name.find(word);
    if (at == std::string::npos) return false;
    const auto letter = [&](std::size_t place) {
        return place < name.size() && std::isalpha(static_cast<unsigned char>(name[place])) != 0;
    };
    return (at == 0 || !letter(at - 1)) && !letter(at + word.size());
}

std::optional<Approach> approach_of(const std::string& heading) {
    constexpr std::array forward{"+", "\xe2\x86\x91", "forward", "up", "positive", "pos", "fwd"};
    constexpr std::array backward{"-",        "\xe2\x86\x93", "backward", "down",
                                  "negative", "neg",          "reverse"};
    const std::string name = lower(heading);
    const auto says = [&](const char* word) { return is_word_in(name, word); };
    const bool goes_up = std::ranges::any_of(forward, says);
    const bool goes_down = std::ranges::any_of(backward, says);
    if (goes_up == goes_down) return std::nullopt;
    const auto digit = name.find_first_of("0123456789");
    Approach found{goes_up, 1};
    if (digit != std::string::npos) found.number = std::atoi(name.c_str() + digit);
    return found;
}

/// A statement's value: JSON where it is (a number, true, an object), else the words.
json value_of(const std::string& text) {
    json value = json::parse(text, nullptr, false);
    const bool number = value.is_number() || value.is_boolean() || value.is_structured();
    return !value.is_discarded() && number ? value : json(text);
}

/// "uncertainty.eve_um" is a member of a member.
void put(json& object, const std::string& key, json value) {
    const auto point = key.find('.');
    if (point == std::string::npos)
        object[key] = std::move(value);
    else
        put(object[key.substr(0, point)], key.substr(point + 1), std::move(value));
}

json statements_of(const CaseTable& table) {
    json object = json::object();
    for (const auto& [key, text] : table.statements)
        put(object, key, value_of(text));
    return object;
}

/// The unit of some columns, from their headings or the statement `key`; one of both must tell it.
Result<std::string> common_unit(const CaseTable& table,
                                const std::vector<std::size_t>& columns,
                                const json& stated,
                                const std::string& key) {
    std::string unit =
        stated.contains(key) && stated.at(key).is_string() ? stated.at(key).get<std::string>() : "";
    for (const std::size_t column : columns) {
        const std::string own = heading_of(table.header.cells[column]).unit;
        if (own.empty() || own == unit) continue;
        if (!unit.empty())
            return refuse_column(table, table.header.cells[column],
                                 "is in '" + printable(own) + "' where another tells '" +
                                     printable(unit) + "': one unit for all");
        unit = own;
    }
    if (!unit.empty()) return unit;
    return refuse_column(table, table.header.cells[columns.front()],
                         "tells no unit: write \"" +
                             heading_of(table.header.cells[columns.front()]).name +
                             " [um]\", or \"# " + key + ": um\" above the header");
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
            AXISCAL_TRY(const double reading, reading_at(table, row, column));
            (approach.forward ? forward : backward).push_back(reading);
        }
        if (!forward.empty()) object["forward"].push_back(std::move(forward));
        if (!backward.empty()) object["backward"].push_back(std::move(backward));
    }
    return {};
}

Result<json> positioning_of(const CaseTable& table) {
    json object = statements_of(table);
    AXISCAL_TRY(const ApproachColumns columns, approach_columns(table));
    AXISCAL_TRY(object["target_unit"], common_unit(table, {0}, object, "target_unit"));
    AXISCAL_TRY(object["unit"], common_unit(table, places_of(columns), object, "unit"));
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
                             "tells no unit: write \"" + sense + " [um]\" or \"" + sense +
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
    json object = statements_of(table);
    object["analysis"] = "circular";
    const std::string unit = heading_of(table.header.cells[0]).unit;
    if (unit != "deg" && unit != "rad")
        return refuse_column(table, table.header.cells[0],
                             "tells no unit: write \"angle [deg]\" or \"angle [rad]\"");
    for (std::size_t column = 1; column < table.header.cells.size(); ++column) {
        AXISCAL_TRY(json trace, trace_of(table, column, unit));
        object["traces"].push_back(std::move(trace));
    }
    return object;
}

} // namespace

std::optional<TableKind> kind_of_table(std::string_view utf8) {
    const std::string first = lower(heading_of(first_cell_of(utf8)).name);
    if (first == "target" || first == "targets") return TableKind::positioning;
    if (first == "angle") return TableKind::circular;
    if (first == "feature") return TableKind::workpiece;
    return std::nullopt;
}

Result<json> case_of_table(const CaseTable& table, TableKind kind) {
    if (table.rows.empty())
        return refuse(Fault::bad_case, "table", "holds no row below its header");
    AXISCAL_CHECK(check_marks(table));
    return kind == TableKind::circular ? circular_of(table) : positioning_of(table);
}

} // namespace axiscal

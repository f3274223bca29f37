#include "tools/axiscal/imports/table_file.hpp"

#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/table_text.hpp"
#include "tools/axiscal/imports/passes.hpp"
#include "tools/axiscal/imports/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

/// Without blanks, and quotes that a cell kept.
std::string word_in(std::string_view cell) {
    std::string_view text = without_blanks(cell);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    return std::string{without_blanks(text)};
}

/// A column by its number from 1.
std::optional<std::size_t> column_number(const std::string& name) {
    std::size_t value = 0;
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), value);
    const bool whole = fault == std::errc{} && end == name.data() + name.size();
    return whole && value >= 1 && value <= 1000 ? std::optional{value - 1} : std::nullopt;
}

/// Every column that holds readings.
std::vector<std::string> reading_columns(const TableMap& map) {
    if (map.forward_columns.empty()) return {map.reading};
    std::vector<std::string> columns = map.forward_columns;
    columns.insert(columns.end(), map.backward_columns.begin(), map.backward_columns.end());
    return columns;
}

/// Whether a column has a name: a line of headings is then looked for.
bool names_columns(const TableMap& map) {
    std::vector<std::string> columns = reading_columns(map);
    columns.push_back(map.target);
    if (!map.run.empty()) columns.push_back(map.run);
    if (!map.direction.empty()) columns.push_back(map.direction);
    return !std::ranges::all_of(
        columns, [](const std::string& name) { return column_number(name).has_value(); });
}

/// A heading first: runs are often called by their numbers.
std::optional<std::size_t>
column_of(const std::vector<std::string>& cells, const std::string& name, bool by_heading) {
    if (by_heading)
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (word_in(cells[i]) == name) return i;
    const auto number = column_number(name);
    return number && *number < cells.size() ? number : std::nullopt;
}

/// Whether the table begins at this line.
bool begins(const std::string& line, const TableMap& map) {
    const auto cells = header_cells_of(line);
    const bool by_heading = names_columns(map);
    const auto target = column_of(cells, map.target, by_heading);
    if (!target || !column_of(cells, reading_columns(map).front(), by_heading)) return false;
    // Any separator: whether a comma is a decimal one is seen when all is read.
    return by_heading || number_in_cell(cells[*target], ';', "").has_value();
}

struct FoundTable {
    CaseTable table;
    bool has_header = true;
};

/// Lines above the table become empty ones, so that the places in refusals are those of the file.
Result<FoundTable> find_table(const std::string& utf8, const TableMap& map) {
    std::string above;
    for (std::size_t at = 0; at < utf8.size();) {
        const auto end = std::min(utf8.find('\n', at), utf8.size());
        if (begins(utf8.substr(at, end - at), map)) {
            FoundTable found;
            AXISCAL_TRY(found.table, read_table_text(above + utf8.substr(at)));
            found.has_header = names_columns(map);
            return found;
        }
        above += '\n';
        at = end + 1;
    }
    return refuse(Fault::bad_case, "table",
                  "no line has the columns " + printable(map.target) + " and " +
                      printable(reading_columns(map).front()) + ", which the map names");
}

struct Columns {
    std::size_t target = 0;
    std::vector<std::size_t> readings; ///< as reading_columns()
    std::optional<std::size_t> run, direction;
};

Result<void> check_distinct(const Columns& columns, const std::string& place) {
    std::vector<std::size_t> all = columns.readings;
    all.push_back(columns.target);
    if (columns.run) all.push_back(*columns.run);
    if (columns.direction) all.push_back(*columns.direction);
    std::ranges::sort(all);
    if (std::ranges::adjacent_find(all) == all.end()) return {};
    return refuse(Fault::bad_case, place, "has one column for two names of the map");
}

Result<Columns> columns_of(const CaseTable& table, const TableMap& map) {
    Columns columns;
    const bool by_heading = names_columns(map);
    columns.target = column_of(table.header.cells, map.target, by_heading).value_or(0);
    const std::string place = "table line " + std::to_string(table.header.line);
    for (const std::string& name : reading_columns(map)) {
        const auto column = column_of(table.header.cells, name, by_heading);
        if (!column) return refuse(Fault::bad_case, place, "has no column " + printable(name));
        columns.readings.push_back(*column);
    }
    if (!map.run.empty()) columns.run = column_of(table.header.cells, map.run, by_heading);
    if (!map.direction.empty())
        columns.direction = column_of(table.header.cells, map.direction, by_heading);
    if (!map.run.empty() && !columns.run)
        return refuse(Fault::bad_case, place, "has no column " + printable(map.run));
    if (!map.direction.empty() && !columns.direction)
        return refuse(Fault::bad_case, place, "has no column " + printable(map.direction));
    AXISCAL_CHECK(check_distinct(columns, place));
    return columns;
}

Result<bool> says_forward(const std::string& cell, const TableMap& map, const std::string& place) {
    const std::string word = word_in(cell);
    if (std::ranges::find(map.forward, word) != map.forward.end()) return true;
    if (std::ranges::find(map.backward, word) != map.backward.end()) return false;
    return refuse(Fault::bad_case, place,
                  "'" + printable(word) + "' is neither forward nor backward in the map");
}

std::string place_of(const TableRow& row) {
    return "table line " + std::to_string(row.line);
}

Result<Captured> begun(const TableRow& row, const Columns& at, std::size_t k, char separator) {
    const std::string& cell = row.cells[at.readings[k]];
    Captured one;
    one.line = row.line;
    AXISCAL_TRY(one.target,
                number_in_cell(row.cells[at.target], separator, place_of(row) + ", target"));
    AXISCAL_TRY(one.reading, number_in_cell(cell, separator, place_of(row) + ", reading"));
    return one;
}

/// Of a row a reading.
Result<Captured>
captured_in(const TableRow& row, const Columns& at, const TableMap& map, char separator) {
    AXISCAL_TRY(Captured one, begun(row, at, 0, separator));
    if (at.run) one.group = word_in(row.cells[*at.run]);
    if (!at.direction) return one;
    AXISCAL_TRY(one.says_forward, says_forward(row.cells[*at.direction], map, place_of(row)));
    if (at.run)
        one.pass = "run " + printable(one.group) + (*one.says_forward ? " forward" : " backward");
    return one;
}

/// Of a row a target; an empty cell is no reading.
Result<void> add_row(const TableRow& row,
                     const Columns& at,
                     const TableMap& map,
                     char separator,
                     std::vector<Captured>& captured) {
    const std::size_t forward = map.forward_columns.size(), before = captured.size();
    for (std::size_t k = 0; k < at.readings.size(); ++k) {
        if (word_in(row.cells[at.readings[k]]).empty()) continue;
        AXISCAL_TRY(Captured one, begun(row, at, k, separator));
        one.says_forward = k < forward;
        one.pass = "run " + printable(k < forward ? map.forward_columns[k]
                                                  : map.backward_columns[k - forward]);
        captured.push_back(std::move(one));
    }
    if (captured.size() == before)
        return refuse(Fault::bad_case, place_of(row), "has a target and no reading");
    return {};
}

bool is_empty(const TableRow& row, const Columns& at) {
    return word_in(row.cells[at.target]).empty() &&
           std::ranges::all_of(at.readings,
                               [&](std::size_t k) { return word_in(row.cells[k]).empty(); });
}

/// Where some numbers have a point, a comma may part thousands.
Result<void> check_marks(const CaseTable& table, const Columns& at) {
    std::vector<std::size_t> columns = at.readings;
    columns.push_back(at.target);
    bool point = false;
    const TableRow* comma = nullptr;
    for (const TableRow& row : table.rows)
        for (const std::size_t k : columns) {
            point = point || row.cells[k].find('.') != std::string::npos;
            if (comma == nullptr && row.cells[k].find(',') != std::string::npos) comma = &row;
        }
    if (!point || comma == nullptr) return {};
    return refuse(Fault::bad_case, place_of(*comma),
                  "has a comma where other numbers have a point");
}

} // namespace

Result<LaserReadings> read_table(const std::string& utf8, const ImportMap& map) {
    const TableMap& of = std::get<TableMap>(map.of);
    AXISCAL_TRY(auto found, find_table(utf8, of));
    CaseTable& table = found.table;
    AXISCAL_TRY(const Columns columns, columns_of(table, of));
    if (!found.has_header) table.rows.insert(table.rows.begin(), table.header);
    AXISCAL_CHECK(check_marks(table, columns));
    std::vector<Captured> captured;
    for (const TableRow& row : table.rows) {
        if (is_empty(row, columns)) continue;
        if (!of.forward_columns.empty()) {
            AXISCAL_CHECK(add_row(row, columns, of, table.separator, captured));
            continue;
        }
        AXISCAL_TRY(Captured one, captured_in(row, columns, of, table.separator));
        captured.push_back(std::move(one));
    }
    LaserReadings out;
    out.kind = map.kind;
    out.unit = map.unit;
    out.target_unit = map.target_unit;
    out.positions = map.positions;
    out.order_tells = of.forward_columns.empty();
    AXISCAL_CHECK(add_passes(captured, out));
    return out;
}

} // namespace axiscal

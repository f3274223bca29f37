#include "tools/axiscal/imports/workbook.hpp"

#include "analysis/quantity/text_encoding.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/imports/workbook_parts.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

/// From 0.
struct CellPlace {
    std::size_t row = 0, column = 0;
};

struct SheetCell {
    std::string text;
    bool is_number = false;
};

using SheetGrid = std::vector<std::vector<SheetCell>>;

constexpr std::size_t largest_grid = 1'000'000;                     ///< cells
constexpr std::size_t most_rows = 1'048'576, most_columns = 16'384; ///< of a sheet

/// "B3"; nothing where it is no such place.
std::optional<CellPlace> cell_place(std::string_view name) {
    CellPlace place;
    std::size_t letters = 0;
    for (; letters < name.size() && letters < 3 && name[letters] >= 'A' && name[letters] <= 'Z';
         ++letters)
        place.column = place.column * 26 + static_cast<std::size_t>(name[letters] - 'A' + 1);
    const char* const end = name.data() + name.size();
    const auto [stop, fault] = std::from_chars(name.data() + letters, end, place.row);
    if (letters == 0 || fault != std::errc{} || stop != end || place.row < 1 ||
        place.row > most_rows || place.column > most_columns)
        return std::nullopt;
    return CellPlace{place.row - 1, place.column - 1};
}

/// With the 15 digits that spreadsheets show: 0.1 + 0.2 lies in the file as 0.30000000000000004,
/// and is the same target as 0.3.
std::string as_shown(std::string value) {
    constexpr int digits = 15;
    double number = 0;
    const char* const end = value.data() + value.size();
    const auto [stop, fault] = std::from_chars(value.data(), end, number);
    if (std::ssize(value) <= digits || fault != std::errc{} || stop != end) return value;
    std::array<char, 32> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), number,
                                       std::chars_format::general, digits);
    return {text.data(), written.ptr};
}

/// What a number without a value, or with the format of a date, is shown as: a word, so that it is
/// no reading.
SheetCell number_cell(const pugi::xml_node& cell, const WorkbookParts& parts, std::string value) {
    if (value.empty() && child_named(cell, "f")) return {"formula without a value", false};
    const auto style = cell.attribute("s").as_ullong();
    if (!value.empty() && style < parts.dates.size() && parts.dates[style])
        return {"date " + value, false};
    return {as_shown(std::move(value)), true};
}

SheetCell cell_in(const pugi::xml_node& cell, const WorkbookParts& parts) {
    const std::string type = attribute_named(cell, "t");
    std::string value = child_named(cell, "v").text().get();
    if (type == "inlineStr") return {text_of_runs(child_named(cell, "is")), false};
    if (type == "b") return {value == "0" ? "FALSE" : "TRUE", false};
    if (type != "s")
        return type.empty() || type == "n" ? number_cell(cell, parts, std::move(value))
                                           : SheetCell{std::move(value), false};
    std::size_t index = parts.texts.size();
    std::from_chars(value.data(), value.data() + value.size(), index);
    return {index < parts.texts.size() ? parts.texts[index] : "text that is missing", false};
}

tl::unexpected<Error> refuse_sheet(std::string reason) {
    return refuse(Fault::bad_case, "sheet", std::move(reason));
}

/// One shared text, or one merged cell, may stand a million times.
tl::unexpected<Error> refuse_long_texts() {
    return refuse_sheet("holds more than " + std::to_string(largest_case_bytes >> 20) +
                        " MiB of text: copy the table into a sheet of its own");
}

Result<void> put_cell(SheetGrid& grid, std::size_t& width, CellPlace place, SheetCell cell) {
    width = std::max(width, place.column + 1);
    const std::size_t height = std::max(grid.size(), place.row + 1);
    if (height * width > largest_grid)
        return refuse_sheet("has cells far from each other, in row " +
                            std::to_string(place.row + 1) +
                            " too: copy the table into a sheet of its own, or save it as CSV");
    grid.resize(height);
    auto& row = grid[place.row];
    if (row.size() <= place.column) row.resize(place.column + 1);
    row[place.column] = std::move(cell);
    return {};
}

/// Rows and cells without a place follow the one before them. Empty cells, which may have a format
/// far out, do not count.
Result<SheetGrid> grid_of(const pugi::xml_node& sheet, const WorkbookParts& parts) {
    SheetGrid grid;
    std::size_t width = 0, next_row = 0, bytes = 0;
    for (const pugi::xml_node& row : child_named(sheet, "sheetData").children()) {
        const std::size_t number = row.attribute("r").as_ullong(next_row + 1);
        if (number < 1 || number > most_rows)
            return refuse_sheet("is damaged: it has a row at no place");
        CellPlace place{number - 1, 0};
        next_row = number;
        for (const pugi::xml_node& cell : row.children()) {
            const std::string name = attribute_named(cell, "r");
            if (!name.empty()) {
                const auto named = cell_place(name);
                if (!named) return refuse_sheet("is damaged: it has a cell at no place");
                place = *named;
            }
            SheetCell found = cell_in(cell, parts);
            bytes += found.text.size();
            if (bytes > largest_case_bytes) return refuse_long_texts();
            const bool blank = found.text.find_first_not_of(" \t\r\n") == std::string::npos;
            if (!blank) AXISCAL_CHECK(put_cell(grid, width, place, std::move(found)));
            ++place.column;
        }
    }
    for (auto& row : grid)
        row.resize(width);
    return grid;
}

/// As a reader takes them: what they hold stands in each. Clipped to the table.
void fill_merged(SheetGrid& grid, CellPlace first, CellPlace last) {
    if (first.row >= grid.size() || first.column >= grid[first.row].size()) return;
    const SheetCell cell = grid[first.row][first.column];
    for (std::size_t i = first.row; i <= std::min(last.row, grid.size() - 1); ++i)
        for (std::size_t k = first.column; k <= std::min(last.column, grid[i].size() - 1); ++k)
            grid[i][k] = cell;
}

Result<void> fill_merged_cells(const pugi::xml_node& sheet, SheetGrid& grid) {
    std::size_t filled = 0, bytes = 0;
    for (const pugi::xml_node& one : child_named(sheet, "mergeCells").children()) {
        const std::string range = attribute_named(one, "ref");
        const auto colon = std::min(range.find(':'), range.size());
        const auto first = cell_place(std::string_view{range}.substr(0, colon));
        const auto last =
            cell_place(std::string_view{range}.substr(std::min(colon + 1, range.size())));
        if (!first || !last || last->row < first->row || last->column < first->column) continue;
        if (first->row >= grid.size() || first->column >= grid.front().size()) continue;
        const std::size_t cells = (std::min(last->row + 1, grid.size()) - first->row) *
                                  (std::min(last->column + 1, grid.front().size()) - first->column);
        filled += cells;
        if (filled > 16 * largest_grid)
            return refuse_sheet("is damaged: its merged cells lie over each other");
        bytes += cells * grid[first->row][first->column].text.size();
        if (bytes > largest_case_bytes) return refuse_long_texts();
        fill_merged(grid, *first, *last);
    }
    return {};
}

/// A text that is a number with a comma which parts no thousands: "0,123", "2,5", "1234,567".
bool has_decimal_comma(const SheetCell& cell) {
    std::string_view text = cell.text;
    if (cell.is_number || text.find_first_not_of("+-0123456789,") != std::string_view::npos)
        return false;
    if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
    const auto comma = text.find(',');
    if (comma == std::string_view::npos || comma == 0 || comma + 1 == text.size() ||
        text.find_first_of("+-,", comma + 1) != std::string_view::npos)
        return false;
    return text.size() - comma != 4 || comma > 3 || text.front() == '0';
}

bool has_decimal_commas(const SheetGrid& grid) {
    return std::ranges::any_of(
        grid, [](const auto& row) { return std::ranges::any_of(row, has_decimal_comma); });
}

void add_cell_text(std::string& out, const SheetCell& cell, bool commas) {
    std::string text = cell.text;
    if (cell.is_number && commas) std::ranges::replace(text, '.', ',');
    for (const char end : {'\n', '\r'})
        std::ranges::replace(text, end, ' ');
    if (text.find_first_of("\t;\"") == std::string::npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char letter : text)
        out += letter == '"' ? std::string{"\"\""} : std::string{letter};
    out += '"';
}

std::string text_of_grid(const SheetGrid& grid) {
    const bool commas = has_decimal_commas(grid);
    std::string text;
    for (const auto& row : grid) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (k > 0) text += '\t';
            add_cell_text(text, row[k], commas);
        }
        text += '\n';
    }
    return text;
}

constexpr std::string_view ole_mark = "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1";

/// As the directory of the container writes it.
bool is_encrypted_workbook(std::string_view bytes) {
    std::string wide;
    for (const char letter : std::string_view{"EncryptedPackage"})
        wide += {letter, '\0'};
    return bytes.find(wide) != std::string_view::npos;
}

} // namespace

bool is_workbook(std::string_view bytes) {
    return bytes.starts_with("PK\x03\x04") || bytes.starts_with(ole_mark);
}

Result<std::string> sheet_text(std::string_view bytes, const std::string& sheet) {
    if (bytes.starts_with(ole_mark))
        return refuse(Fault::bad_case, "file",
                      is_encrypted_workbook(bytes)
                          ? "is an encrypted workbook: save it without a password, as .xlsx or CSV"
                          : "is an .xls of old, or another file of that kind: save it as .xlsx or "
                            "CSV");
    AXISCAL_TRY(const WorkbookParts parts, workbook_parts(bytes, sheet));
    AXISCAL_TRY(const auto document, parsed_part(parts.sheet, "of the sheet"));
    const pugi::xml_node root = document.document_element();
    AXISCAL_TRY(SheetGrid grid, grid_of(root, parts));
    if (grid.empty())
        return refuse_sheet("has no cell with a value: name another sheet in the map");
    AXISCAL_CHECK(fill_merged_cells(root, grid));
    std::string text = text_of_grid(grid);
    if (wrong_encoding(text))
        return refuse_sheet("is damaged: it is no UTF-8. Save the workbook again as .xlsx or CSV");
    return text;
}

} // namespace axiscal

#include "tools/axiscal/cases/table_text.hpp"

#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

namespace axiscal {
namespace {

constexpr std::string_view utf8_mark = "\xef\xbb\xbf", little_mark = "\xff\xfe",
                           big_mark = "\xfe\xff";
constexpr std::string_view blanks = " \t\r\xc2\xa0"; // UTF-8 of the no-break space, too

tl::unexpected<Error> refuse_table(const std::string& place, std::string reason) {
    return refuse(Fault::bad_case, place, std::move(reason));
}

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

void put_utf8(std::string& out, std::uint32_t code) {
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (code < 0x80) return put(code);
    if (code < 0x800) return put(0xC0 | code >> 6U), put(0x80 | (code & 0x3FU));
    if (code < 0x10000)
        return put(0xE0 | code >> 12U), put(0x80 | (code >> 6U & 0x3FU)),
               put(0x80 | (code & 0x3FU));
    put(0xF0 | code >> 18U), put(0x80 | (code >> 12U & 0x3FU));
    put(0x80 | (code >> 6U & 0x3FU)), put(0x80 | (code & 0x3FU));
}

/// RFC 2781.
Result<std::string> of_utf16(std::string_view bytes, bool little) {
    const auto unit = [&](std::size_t at) {
        const auto first = static_cast<std::uint8_t>(bytes[at]),
                   second = static_cast<std::uint8_t>(bytes[at + 1]);
        return static_cast<std::uint32_t>(little ? second << 8 | first : first << 8 | second);
    };
    std::string out;
    for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
        std::uint32_t code = unit(at);
        if (code >= 0xDC00 && code < 0xE000)
            return refuse_table("table", "is no whole UTF-16: save it as UTF-8");
        if (code >= 0xD800 && code < 0xDC00) {
            at += 2;
            if (at + 1 >= bytes.size() || (unit(at) & 0xFC00U) != 0xDC00)
                return refuse_table("table", "is no whole UTF-16: save it as UTF-8");
            code = 0x10000 + ((code & 0x3FFU) << 10U | (unit(at) & 0x3FFU));
        }
        put_utf8(out, code);
    }
    if (bytes.size() % 2 != 0) return refuse_table("table", "is no whole UTF-16: save it as UTF-8");
    return out;
}

char separator_of(std::string_view line) {
    bool quoted = false, semicolon = false, tab = false;
    for (const char letter : line) {
        quoted = quoted != (letter == '"');
        semicolon |= letter == ';' && !quoted;
        tab |= letter == '\t' && !quoted;
    }
    return semicolon ? ';' : tab ? '\t' : ',';
}

/// RFC 4180, but for line ends within quotes.
Result<TableRow> row_of(std::string_view line, std::size_t number, char separator) {
    TableRow row{number, {}};
    for (std::size_t at = 0; at <= line.size();) {
        std::string cell;
        while (at < line.size() && (line[at] == ' ' || line[at] == '\r'))
            ++at;
        const bool quoted = at < line.size() && line[at] == '"';
        if (quoted) {
            for (++at; at < line.size(); ++at) {
                if (line[at] == '"' && line.substr(at, 2) != "\"\"") break;
                if (line[at] == '"') ++at;
                cell += line[at];
            }
            if (at == line.size())
                return refuse_table("table line " + std::to_string(number),
                                    "opens a quote and does not close it");
        }
        const auto end = std::min(line.find(separator, at), line.size());
        if (!quoted) cell = trimmed(line.substr(at, end - at));
        row.cells.push_back(std::move(cell));
        at = end + 1;
    }
    return row;
}

/// "# key: value" with a key as cases have them.
std::optional<std::pair<std::string, std::string>> statement_in(std::string_view line) {
    line.remove_prefix(1);
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view key = trimmed(line.substr(0, colon));
    const auto of_key = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '.';
    };
    if (key.empty() || key.front() < 'a' || key.front() > 'z' || !std::ranges::all_of(key, of_key))
        return std::nullopt;
    return std::pair{std::string{key}, std::string{trimmed(line.substr(colon + 1))}};
}

Result<void> add_row(CaseTable& table, TableRow row) {
    if (std::ranges::all_of(row.cells, &std::string::empty)) return {};
    if (table.header.cells.empty()) {
        table.header = std::move(row);
        return {};
    }
    if (row.cells.size() != table.header.cells.size() && row.cells[0].starts_with('#')) return {};
    if (row.cells.size() != table.header.cells.size())
        return refuse_table("table line " + std::to_string(row.line),
                            "has " + std::to_string(row.cells.size()) + " cells, the header has " +
                                std::to_string(table.header.cells.size()));
    table.rows.push_back(std::move(row));
    return {};
}

bool parts_thousands(std::string_view cell, std::size_t comma) {
    const std::string_view before = cell.substr(0, comma);
    return cell.size() - comma == 4 && !before.empty() && before.size() <= 4 &&
           before.find_first_of("123456789") != std::string_view::npos && before.back() != '-' &&
           before.front() != '0';
}

} // namespace

Result<std::string> utf8_of(std::string_view bytes) {
    if (bytes.starts_with(utf8_mark)) return std::string{bytes.substr(utf8_mark.size())};
    if (bytes.starts_with(little_mark)) return of_utf16(bytes.substr(2), true);
    if (bytes.starts_with(big_mark)) return of_utf16(bytes.substr(2), false);
    return std::string{bytes};
}

std::vector<std::string> header_cells_of(std::string_view utf8) {
    while (!utf8.empty()) {
        const auto end = std::min(utf8.find('\n'), utf8.size());
        const std::string_view line = utf8.substr(0, end);
        utf8.remove_prefix(std::min(end + 1, utf8.size()));
        if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
        const char separator = separator_of(line);
        if (auto row = row_of(line, 1, separator)) return std::move(row->cells);
        return {std::string{trimmed(line.substr(0, line.find(separator)))}}; // a quote stays open
    }
    return {};
}

Result<CaseTable> read_table_text(std::string_view utf8) {
    if (utf8.size() > largest_case_bytes)
        return refuse_table("table line 1", "opens a table larger than 64 MiB");
    CaseTable table;
    for (std::size_t number = 1; !utf8.empty(); ++number) {
        const auto end = std::min(utf8.find('\n'), utf8.size());
        const std::string_view line = utf8.substr(0, end);
        utf8.remove_prefix(std::min(end + 1, utf8.size()));
        if (trimmed(line).empty()) continue;
        if (table.header.cells.empty() && trimmed(line).starts_with('#')) {
            if (auto statement = statement_in(trimmed(line)))
                table.statements.push_back(*std::move(statement));
            continue;
        }
        if (table.header.cells.empty()) table.separator = separator_of(line);
        AXISCAL_TRY(TableRow row, row_of(line, number, table.separator));
        AXISCAL_CHECK(add_row(table, std::move(row)));
    }
    return table;
}

Result<double> number_in_cell(const std::string& cell, char separator, const std::string& place) {
    std::string text{trimmed(cell)};
    constexpr std::string_view minus = "\xe2\x88\x92"; // U+2212, as typeset
    if (text.starts_with(minus)) text.replace(0, minus.size(), "-");
    const auto comma = text.find(',');
    const bool both = comma != std::string::npos && text.find('.') != std::string::npos;
    if (both || std::ranges::count(text, ',') > 1 ||
        (comma != std::string::npos && separator == ',' && parts_thousands(text, comma)))
        return refuse_table(place, "'" + printable(cell) +
                                       "' may part thousands: write numbers without such marks");
    if (comma != std::string::npos) text[comma] = '.';
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value))
        return refuse_table(place, "'" + printable(cell) + "' is not a number");
    return value;
}

} // namespace axiscal

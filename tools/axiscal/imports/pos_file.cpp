#include "tools/axiscal/imports/pos_file.hpp"

#include "tools/axiscal/imports/text_lines.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace axiscal {
namespace {

enum class Averages : std::uint8_t { bidirectional, forward, backward };

std::optional<Averages> title_of(std::string_view line) {
    const auto words = words_of(line);
    if (words.size() < 4 || words.front() != "Position" || words.back() != "Error" ||
        words[words.size() - 2] != "Avg")
        return std::nullopt;
    if (words[1] == "Bidirectional") return Averages::bidirectional;
    if (words[1] == "Forward") return Averages::forward;
    if (words[1] == "Backward" || words[1] == "Reverse") return Averages::backward;
    return std::nullopt;
}

struct Table {
    std::size_t line = 0;
    std::map<double, double> error_mm; ///< by position
};

using Tables = std::map<Averages, Table>;

Result<void> add_row(Table& table, const TextLine& line) {
    const auto words = words_of(line.text);
    if (words.size() != 2)
        return refuse_line(line.number, "has " + std::to_string(words.size()) +
                                            " words; a row has position and error");
    AXISCAL_TRY(const double position, number_of(words[0], line.number));
    AXISCAL_TRY(const double error, number_of(words[1], line.number));
    if (!table.error_mm.emplace(position, error).second)
        return refuse_line(line.number, "the position " + std::string{words[0]} + " stands twice");
    if (table.line == 0) table.line = line.number;
    return {};
}

/// A table ends where no number begins a line.
Result<Tables> tables_of(std::string_view text) {
    Tables tables;
    Table* open = nullptr;
    for (const TextLine& line : lines_of(text)) {
        if (line.text.empty()) continue;
        if (const auto title = title_of(line.text)) {
            if (tables.contains(*title))
                return refuse_line(line.number, "a second table of this title: two axes in one "
                                                "file; save each by itself");
            open = &tables[*title];
            continue;
        }
        const bool number = line.text.find_first_of("+-.0123456789") == 0;
        if (!number) open = nullptr;
        if (open != nullptr) AXISCAL_CHECK(add_row(*open, line));
    }
    return tables;
}

LaserPass pass_of(const Table& table, std::string name, bool forward) {
    LaserPass pass;
    pass.name = std::move(name);
    pass.line = table.line;
    pass.says_forward = forward;
    for (const auto& [position, error] : table.error_mm) {
        pass.order.push_back(pass.order.size());
        pass.readings.emplace_back(error);
    }
    return pass;
}

Result<void> check_positions(const LaserReadings& out, const Table& table) {
    const auto same = [](double position, const auto& row) { return position == row.first; };
    if (std::ranges::equal(out.targets, table.error_mm, same)) return {};
    return refuse(Fault::bad_case, "file",
                  "has tables of averages at other positions than the first");
}

} // namespace

bool is_pos(std::string_view utf8) {
    return std::ranges::any_of(
        lines_of(utf8), [](const TextLine& line) { return title_of(line.text).has_value(); });
}

Result<LaserReadings> read_pos(std::string_view utf8) {
    AXISCAL_TRY(Tables tables, tables_of(utf8));
    if (tables.contains(Averages::backward) && !tables.contains(Averages::forward))
        return refuse(Fault::bad_case, "file", "has no forward averages");
    if (!tables.contains(Averages::forward))
        return refuse(Fault::bad_case, "file",
                      "has averages of both directions together alone: neither E nor B follow from "
                      "them; export the forward and backward ones as well");
    LaserReadings out;
    out.unit = "mm";
    const Table& forward = tables[Averages::forward];
    for (const auto& [position, error] : forward.error_mm)
        out.targets.push_back(position);
    for (const auto& [which, table] : tables)
        AXISCAL_CHECK(check_positions(out, table));
    if (!tables.contains(Averages::backward) && tables.contains(Averages::bidirectional)) {
        Table& backward = tables[Averages::backward];
        for (const auto& [position, both] : tables[Averages::bidirectional].error_mm)
            backward.error_mm[position] = 2 * both - forward.error_mm.at(position);
        out.remarks.emplace_back(
            "The backward averages are twice those of both directions less the forward ones.");
    }
    out.passes.push_back(pass_of(forward, "forward averages", true));
    if (tables.contains(Averages::backward))
        out.passes.push_back(pass_of(tables[Averages::backward], "backward averages", false));
    out.remarks.emplace_back(
        "The file holds averages alone: E, M and B follow from them, A and R do not. No file of "
        "the maker's own program has confirmed this layout.");
    return out;
}

} // namespace axiscal

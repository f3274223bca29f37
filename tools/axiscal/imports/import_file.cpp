#include "tools/axiscal/imports/import_file.hpp"

#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/case_table.hpp"
#include "tools/axiscal/imports/foreign_text.hpp"
#include "tools/axiscal/imports/pos_file.hpp"
#include "tools/axiscal/imports/readings_case.hpp"
#include "tools/axiscal/imports/rtl_file.hpp"
#include "tools/axiscal/imports/stream_file.hpp"
#include "tools/axiscal/imports/table_file.hpp"
#include "tools/axiscal/imports/umd_file.hpp"
#include "tools/axiscal/imports/workbook.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

Result<ImportedFile>
as_case(std::string form, Result<LaserReadings> read, const std::optional<ImportMap>& map) {
    if (!read) return tl::unexpected<Error>(read.error());
    LaserReadings& readings = *read;
    AXISCAL_TRY(auto document, case_of_readings(readings));
    if (map && !map->axis.empty()) document["axis"]["name"] = map->axis;
    return ImportedFile{std::move(form), std::move(document), readings.only_backward,
                        std::move(readings.remarks)};
}

/// What says itself which column is which.
Result<ImportedFile>
known_form(std::string form, Result<LaserReadings> read, const std::optional<ImportMap>& map) {
    if (read && map)
        read->remarks.emplace_back(
            "The map counts for the name of the axis alone: the file says the rest.");
    return as_case(std::move(form), std::move(read), map);
}

/// A table as `axiscal case new` writes it.
Result<ImportedFile> own_table(const std::string& text, TableKind kind) {
    if (kind == TableKind::workpiece)
        return refuse(
            Fault::bad_case, "file",
            "is a table of both measurements of a workpiece: axiscal analyze takes it as it is");
    AXISCAL_TRY(const CaseTable table, read_table_text(text));
    AXISCAL_TRY(auto document, case_of_table(table, kind));
    return ImportedFile{"table", std::move(document), false, {}};
}

tl::unexpected<Error> refuse_unknown(const std::string& text) {
    std::string columns;
    for (const std::string& cell : header_cells_of(text))
        if (columns.size() < 200) columns += (columns.empty() ? "" : ", ") + printable(cell);
    return refuse(Fault::bad_case, "file",
                  "is no Laser10 text and no table of ours; a map says what its columns are "
                  "(--map, docs/import.md). Its first line has: " +
                      columns);
}

/// By the same rules as a table of text.
Result<ImportedFile> import_workbook(std::string_view bytes, const std::optional<ImportMap>& map) {
    const TableMap* const table = map ? std::get_if<TableMap>(&map->of) : nullptr;
    if (map && table == nullptr)
        return refuse(Fault::bad_case, "file",
                      "is a workbook: a map of kind \"table\" says what its columns are (--map, "
                      "docs/import.md)");
    AXISCAL_TRY(const std::string text, sheet_text(bytes, table ? table->sheet : std::string{}));
    if (map) return as_case("sheet of a workbook (.xlsx)", read_table(text, *map), map);
    if (const auto kind = kind_of_table(text)) return own_table(text, *kind);
    return refuse_unknown(text);
}

/// What only a map makes readings of.
Result<ImportedFile> import_record(const std::string& text, const std::optional<ImportMap>& map) {
    const bool stream = map && std::holds_alternative<StreamMap>(map->of);
    const UmdMap* const umd = map ? std::get_if<UmdMap>(&map->of) : nullptr;
    if (umd != nullptr && is_umd(text)) return as_case("uMD log", read_umd(text, *umd), map);
    if (is_umd(text))
        return refuse(Fault::bad_case, "file",
                      "is a log of the uMD: a map of kind \"umd\" says what a count is, and where "
                      "the axis was to stand (--map, docs/import.md)");
    if (umd != nullptr)
        return refuse(Fault::bad_case, "file",
                      "is no log of the uMD, as the map says: it begins with \"Sample Frequency\", "
                      "or with \"D:<count> N:<number>\"");
    if (stream) return as_case("raw stream", read_stream(text, *map), map);
    return refuse(Fault::bad_case, "file",
                  "is a raw stream: a map of kind \"stream\" says which name is what (--map, "
                  "docs/import.md)");
}

bool is_record(const std::string& text, const std::optional<ImportMap>& map) {
    // "Sample Frequency" and "Gap" may stand above a table, too.
    if (map && std::holds_alternative<TableMap>(map->of)) return is_stream(text);
    return map.has_value() || is_stream(text) || is_umd(text);
}

} // namespace

Result<ImportedFile> import_file(std::string_view bytes, const std::optional<ImportMap>& map) {
    if (is_workbook(bytes)) return import_workbook(bytes, map);
    AXISCAL_TRY(const ForeignText read, foreign_text(bytes));
    const std::string& text = read.utf8;
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return refuse(Fault::bad_case, "file", "is empty");
    if (text[begin] == '{' || text[begin] == '[')
        return refuse(Fault::bad_case, "file", "is JSON: axiscal analyze takes a case as it is");
    if (is_rtl(text)) return known_form("Laser10 text (.rtl, .rta)", read_rtl(text), map);
    if (is_pos(text)) return known_form("API .pos", read_pos(text), map);
    if (is_record(text, map)) return import_record(text, map);
    if (map) return as_case("table", read_table(text, *map), map);
    if (const auto kind = kind_of_table(text)) return own_table(text, *kind);
    return refuse_unknown(text);
}

} // namespace axiscal

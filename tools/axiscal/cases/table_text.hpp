#pragma once
// A table as programs export it: cells between commas, semicolons or tabs, perhaps quoted, decimal
// points or commas, UTF-8 with or without byte order mark, UTF-16 with one. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axiscal {

/// The text in UTF-8, without its byte order mark.
/// @errors Fault::bad_case, field "table": half a character of UTF-16.
Result<std::string> utf8_of(std::string_view bytes);

struct TableRow {
    std::size_t line = 0; ///< in the file, from 1
    std::vector<std::string> cells;
};

struct CaseTable {
    /// "# key: value" above the header; other lines that begin with # there are remarks.
    std::vector<std::pair<std::string, std::string>> statements;
    TableRow header;
    std::vector<TableRow> rows; ///< as many cells each as the header has; none is wholly empty
    char separator = ',';
};

/// Of the header, as far as they can be told; none where there is no header.
std::vector<std::string> header_cells_of(std::string_view utf8);

/// Empty lines are passed over. Below the header # is a letter like any other, but a line that
/// begins with it and has another number of cells is a remark.
/// @errors Fault::bad_case, field "table line N": a row of another length, a quote that is not
/// closed, larger than 64 MiB.
Result<CaseTable> read_table_text(std::string_view utf8);

/// The number in a cell: decimal point, or decimal comma. Both in one cell, and a comma that may
/// part thousands ("1,234" between commas), are refused.
/// @param place  of the cell, for the refusal: "table line 7, column run1 +"
Result<double> number_in_cell(const std::string& cell, char separator, const std::string& place);

} // namespace axiscal

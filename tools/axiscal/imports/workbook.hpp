#pragma once
// Workbooks of spreadsheet programs (.xlsx, ECMA-376): one sheet as text of a table. Pure.

#include "analysis/quantity/result.hpp"

#include <string>
#include <string_view>

namespace axiscal {

/// Begins as a ZIP, or as the older container (OLE) of .xls and of encrypted workbooks.
bool is_workbook(std::string_view bytes);

/// A line a row, tabs between cells, so that a line has the number of its row and read_table()
/// takes it as any other table. A formula gives the value that its program kept; what merged cells
/// hold stands in each of them; a cell with the format of a date is a word, and so no number.
/// Where text cells certainly have decimal commas, numbers are written with commas, too.
/// @param sheet  its name; empty: the first that is not hidden
/// @errors Fault::bad_case, "file", with the way out: an .xls, a password, no workbook, damaged,
/// too large, cells far apart; "sheet": no sheet of this name, or an empty one.
Result<std::string> sheet_text(std::string_view bytes, const std::string& sheet);

} // namespace axiscal

#pragma once
// A table of readings as the case that it stands for: what JSON would have said, so that both go
// the same way. Pure.

#include "tools/axiscal/cases/table_text.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace axiscal {

enum class TableKind : std::uint8_t { positioning, circular, workpiece };

/// By its header: the first column is angle or feature, or one is target. Empty for any other.
std::optional<TableKind> kind_of_table(std::string_view utf8);

/// Columns of positioning: "target [mm]", then one a reading, "run1 + [um]", "run1 - [um]"; or a
/// row a reading with the columns target, direction, and deviation or position. Of circular: "angle
/// [deg]", then "ccw [um]", "cw [um]"; an empty cell is no reading.
/// @errors Fault::bad_case with line and column, and the form that is accepted.
Result<nlohmann::json> case_of_table(const CaseTable& table, TableKind kind);

/// What the command that writes it gives: `axiscal analyze` takes it as it is.
/// @param kind "positioning", "circular" or "workpiece"; empty text for any other
std::string table_template(std::string_view kind);

} // namespace axiscal

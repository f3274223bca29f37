#pragma once
// A table of readings that another program exported, a row a reading. Pure.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/import_map.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <string>
#include <string_view>

namespace axiscal {

/// The table begins where a line has the headings of the map, or, where the map counts columns,
/// with the first line that has numbers there; what stands above is passed over. Rows that are
/// empty in both columns, too.
/// @errors Fault::bad_case with "table line N": a heading that is not there, a row of another
/// length, a word in place of a number, a direction that the map does not have.
Result<LaserReadings> read_table(const std::string& utf8, const ImportMap& map);

} // namespace axiscal

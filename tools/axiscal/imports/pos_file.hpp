#pragma once
// .pos text of API's laser programs (Automated Precision Inc.). Pure.
//
// The layout is that which one public program reads; no document of the maker is public, and no
// file of its program confirms it. Raw runs are not known: only the tables of averages are read.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <string_view>

namespace axiscal {

/// Whether a line is the title of a table of averages: "Position" and "... Avg Error".
bool is_pos(std::string_view utf8);

/// Tables under "Position  Bidirectional Avg Error", "Position  Forward Directional Avg Error" and
/// another "... Directional Avg Error", which is backward: position and error in mm, one pass each.
/// Where the backward one is missing it is twice the bidirectional average less the forward one.
/// @errors Fault::bad_case with "line N": a word in place of a number, a position twice; "file":
/// averages of both directions together alone, tables of other positions.
Result<LaserReadings> read_pos(std::string_view utf8);

} // namespace axiscal

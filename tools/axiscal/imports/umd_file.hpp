#pragma once
// The log that the uMD's own program writes: counts of axis 1, and no word about length, place or
// plan. Pure.
//
// The layout is that of the program's public source (2016); three public readers of it agree.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/import_map.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <string_view>

namespace axiscal {

/// Whether the first line that is not empty is "Sample Frequency = ... Hz", the word "Gap", or a
/// sample: "D:<count> N:<number>".
bool is_umd(std::string_view utf8);

/// One capture of the file; the map says what a count is, where the axis stands when it begins, and
/// where it was to stand. Where numbers leap samples were lost: outside of the windows that count a
/// remark says how many. A last line without an end is not taken.
/// @errors Fault::bad_case with "line N": what is no sample, a sample of the test mode, a number
/// that does not follow, a frequency that is missing; "file": more captures than one, where the map
/// names none; and those of standstills.hpp.
Result<LaserReadings> read_umd(std::string_view utf8, const UmdMap& map);

} // namespace axiscal

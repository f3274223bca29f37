#pragma once
// Laser10 text files of Renishaw's calibration programs: .rtl (linear), .rta (angular). Pure.
//
// The layout is that on which four independent public programs agree, one that writes and three
// that read; no document of the maker is public. Not confirmed by a file of the maker's own
// program: the unit of .rta, and what ENVIRONMENT and EQUIPMENT hold.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <string_view>

namespace axiscal {

/// Whether the text begins as such a file does: "HEADER::".
bool is_rtl(std::string_view utf8);

/// Sections HEADER, TARGET DATA, USER-TEXT, RUNS, DEVIATIONS, and perhaps EQUIPMENT and
/// ENVIRONMENT; "Key : value" or "Key:value". Targets in mm or degrees, free-form. Deviations, um
/// or arcsec, one a line: run, target, value; both count from 1. Decimal points or commas.
/// @errors Fault::bad_case with "line N": another file type, fewer or more targets than stated,
/// a target or run outside of the counts, a reading twice, a word in place of a number; "file" with
/// the section that is missing, a file that ends within a section, and two axes in one file.
Result<LaserReadings> read_rtl(std::string_view utf8);

} // namespace axiscal

#pragma once
// Raw streams as EPICS' camonitor prints them, and rigs for acceptance tests log them. Pure.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/import_map.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <string_view>

namespace axiscal {

/// Whether the first line is "NAME YYYY-MM-DD HH:MM:SS.ffffff VALUE", perhaps with status and
/// severity.
bool is_stream(std::string_view utf8);

/// Names are interleaved, each is sent when it changes; what is not named in the map is passed
/// over. Each change of the capture's number to another one than 0 is a capture: the last value
/// before it, or the mean of the values within the window about it. Captures of one direction and
/// cycle are a pass; where the number does not tell, a pass ends where the targets turn or come
/// again. Where the map has no capture but standstills, the readings are found where the axis
/// stands (standstills.hpp).
/// @errors Fault::bad_case with "line N": what is no such line, a number of a capture that does not
/// fit the digits of the map, two targets for one position, a value that is not valid (severity
/// INVALID), a target twice in a pass, a capture without a value; "file": a name that is not there.
Result<LaserReadings> read_stream(std::string_view utf8, const ImportMap& map);

} // namespace axiscal

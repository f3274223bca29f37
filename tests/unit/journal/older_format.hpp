#pragma once
// What makes a fresh run file one of an older format. Tests only.

#include <string>

namespace axiscal::testing {

inline const std::string drop_format_7 = "DROP TABLE signature; DROP TABLE ordered; ";
inline const std::string to_format_6 = drop_format_7 + "PRAGMA user_version=6";
/// Of a file without points: format 6 packs their samples.
inline const std::string to_format_5 = drop_format_7 + "PRAGMA user_version=5";
/// Without rows in them: their links would be missed.
inline const std::string drop_format_5 =
    drop_format_7 + "DROP TABLE linear_scale; DROP TABLE linear_scale_sensor; ";
inline const std::string drop_format_4 =
    drop_format_5 +
    "DROP TABLE channel_calibration; DROP TABLE channel_correction; DROP TABLE probing; "
    "DROP TABLE probing_touch; DROP TABLE stream_block_time; DROP TABLE circular_start; "
    "DROP TABLE synchronisation; "
    "DROP TABLE rotary; DROP TABLE rotary_deviation; ";

} // namespace axiscal::testing

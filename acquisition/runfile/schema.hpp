#pragma once
// schema.sql beside this file, and the tables of setups/, as text; put into the program by CMake.

namespace axiscal {

extern const char* const run_file_schema;

/// "AXCL": PRAGMA application_id, bytes 68..71 of the file, big-endian.
inline constexpr int run_file_application_id = 0x4158434C;
/// PRAGMA user_version.
inline constexpr int run_file_version = 1;

} // namespace axiscal

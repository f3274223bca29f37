#pragma once
// The schema files beside this one as text, put into the program by CMake.

#include <string>

namespace axiscal {

/// The schema of a format from 1 to run_file_version. A newer format only adds tables; format 6
/// packs the samples of a point, in the column where they stood as they are.
std::string run_file_schema(int format);

/// "AXCL": PRAGMA application_id, bytes 68..71 of the file, big-endian.
inline constexpr int run_file_application_id = 0x4158434C;
/// PRAGMA user_version of files written here; older ones are read, a newer one is refused.
inline constexpr int run_file_version = 7;

} // namespace axiscal

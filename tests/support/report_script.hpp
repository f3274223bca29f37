#pragma once
// A program that answers as axiscal-report does. Tests only.

#include "tests/support/scratch_folder.hpp"

#include <filesystem>
#include <string>

namespace axiscal::testing {

/// @returns the path of a shell script with this body; $1 is the run file, $3 the outbox.
inline std::string report_script(const ScratchFolder& folder, const std::string& body) {
    const std::string path = folder.file("report.sh");
    write_bytes(path, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
}

} // namespace axiscal::testing

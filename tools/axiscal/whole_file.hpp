#pragma once
// A file's bytes, for commands that take files of others.

#include "analysis/quantity/result.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace axiscal {

/// @errors Fault::io for what cannot be read, a folder too.
inline Result<std::string> whole_file(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file || std::filesystem::is_directory(path)) return fail(Fault::io, "cannot read " + path);
    return std::string{std::istreambuf_iterator<char>{file}, {}};
}

} // namespace axiscal

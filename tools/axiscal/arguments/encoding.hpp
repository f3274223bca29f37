#pragma once
// What is written on the command line is UTF-8, as all that is made of it: JSON, run files, papers.

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// What to tell of the first word that is not UTF-8; none where all are. A word that names a file
/// that is there passes: the file is called so.
std::optional<std::string> complaint_of_encoding(const std::vector<std::string>& words);

} // namespace axiscal

#pragma once
// The bearer token that a client over TCP needs to change anything.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

/// Reads the token file, or makes it (32 random bytes in hex, mode 0640).
/// @errors Fault::refused for a file that others may read or write, or that is no plain file, with
/// the way out; Fault::io.
Result<std::string> load_or_make_token(const std::string& path);

} // namespace axiscal

#pragma once
// The bearer token that a client over TCP needs to change anything.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

/// Reads the token file, or makes it (32 random bytes in hex, mode 0640).
Result<std::string> load_or_make_token(const std::string& path);

} // namespace axiscal

#pragma once
// The digest by which a recomputed result is known to have the same bits. Pure.

#include "analysis/positioning_accuracy.hpp"

#include <string>

namespace axiscal {

/// SHA-256 over canonical_bytes(result), 64 lower-case hexadecimal digits.
std::string result_digest(const PositioningResult& result);

} // namespace axiscal

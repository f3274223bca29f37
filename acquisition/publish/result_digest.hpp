#pragma once
// The digest by which a recomputed result is known to have the same bits. Pure.

#include "analysis/circular/circular_parameters.hpp"
#include "analysis/positioning_accuracy.hpp"

#include <string>

namespace axiscal {

/// SHA-256 over canonical_bytes(), 64 lower-case hexadecimal digits.
std::string result_digest(const PositioningResult& result);
std::string result_digest(const CircularParameters& parameters);

} // namespace axiscal

#pragma once
// The digest by which a recomputed result is known to have the same bits (of a circular test: to
// 1e-8 mm). One that differs is judged figure by figure: figure_agreement.hpp. Pure.

#include "analysis/circular/circular_parameters.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"

#include <string>

namespace axiscal {

/// SHA-256 over canonical_bytes(), 64 lower-case hexadecimal digits.
std::string result_digest(const PositioningResult& result);
std::string result_digest(const CircularParameters& parameters);

} // namespace axiscal

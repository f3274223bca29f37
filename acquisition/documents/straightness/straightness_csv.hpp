#pragma once
// A straightness result as comma-separated values. Pure.

#include "acquisition/documents/straightness/straightness_document.hpp"

#include <string>

namespace axiscal {

/// Head, verdicts, figures with U and means by target as lines that begin with "#"; then every
/// deviation: direction, target, number among the readings that count, um.
std::string straightness_csv(const StraightnessResult& result);

} // namespace axiscal

#pragma once
// A squareness result as comma-separated values. Pure.

#include "acquisition/documents/squareness/squareness_document.hpp"

#include <string>

namespace axiscal {

/// Head, verdicts, figures with U, square and lines with their means as lines that begin with "#";
/// then every deviation of this run: direction, target, number among the readings that count, um.
std::string squareness_csv(const SquarenessResult& result);

} // namespace axiscal

#pragma once
// What the CSV of a straightness and of a squareness say alike of their run. Pure.

#include "acquisition/documents/straightness/across_run_file.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Which run this is, as lines that begin with "#".
/// @param format  "axiscal.straightness-csv/1"
/// @param sign    of the figures, in words
void append_across_head(std::string& csv,
                        const AcrossRun& one,
                        const std::string& format,
                        const std::string& sign);

/// The terms that the budget lacks, a line each.
void append_missing(std::string& csv, const std::vector<std::string>& not_stated);

/// Direction, target, number among the readings that count, um.
void append_every_deviation(std::string& csv, const StraightnessReadings& readings);

} // namespace axiscal

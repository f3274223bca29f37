#pragma once
// What a certificate says of the checks before the run. Pure.

#include "analysis/record/run_revisions.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// A sentence for each check that failed, with the reason that was given to go on all the same, and
/// for each that passed with a warning.
void remark_on_preflight(const std::vector<PreflightRecord>& checks,
                         std::vector<std::string>& remarks);

} // namespace axiscal

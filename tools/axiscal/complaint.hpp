#pragma once
// What a command without a daemon says about an error.

#include "analysis/quantity/result.hpp"
#include "config/settings.hpp"

#include <vector>

namespace axiscal {

/// Describes the error on standard error. @returns exit_failed for Fault::io, else exit_refused.
int complain(const Error& error);

/// Every refusal of a station file with its line, as JSON on standard output. @returns
/// exit_refused.
int complain(const std::vector<Refusal>& refusals, bool json);

} // namespace axiscal

#pragma once
// What a command without a daemon says about an error.

#include "analysis/quantity/result.hpp"

namespace axiscal {

/// Describes the error on standard error. @returns exit_failed for Fault::io, else exit_refused.
int complain(const Error& error);

} // namespace axiscal

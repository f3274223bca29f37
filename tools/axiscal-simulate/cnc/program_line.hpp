#pragma once
// How a refusal names the line of a part program, in every dialect.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal::simulate {

/// Fault::bad_request: "line 12: reason". Lines count from 1.
inline tl::unexpected<Error> at_line(int line, const std::string& reason) {
    return fail(Fault::bad_request, "line " + std::to_string(line) + ": " + reason);
}

} // namespace axiscal::simulate

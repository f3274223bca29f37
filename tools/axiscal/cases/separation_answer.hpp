#pragma once
// A separation as a document. Pure.

#include "analysis/separation/error_separation.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// From "terms" to "not_evaluated".
void add_separation(nlohmann::ordered_json& out,
                    const PerAxis<SeparatedRow>& rows,
                    const SeparationCase& stated);

} // namespace axiscal

#pragma once
// A report that somebody else published, held against its own readings. Pure.

#include "analysis/quantity/result.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// {"verdict": "agrees" | "differs", "findings": [{"parameter", "published", "recomputed", "code",
/// "sentence"}]}. `report` is {"forward": [[]], "backward": [[]], "parameters": {"E": 0.0069}},
/// each key but the last may be left out; "unit" where it is not that of the case. The parameters
/// have our names, or E_fwd, E_bwd (as of A and R), and B_avg.
///
/// A figure agrees within half a unit of the last place of the published ones, and 6.5 times half a
/// unit of the last place of the case's readings, if that is not larger: 2 for a difference of two
/// means, and 4 s for A, where a rounded reading moves s by at most sqrt(n / (n - 1)) of it.
///
/// Codes: E_ONE_SIDE: E of one direction, or of the maximum of one and the minimum of the other, in
/// place of all means; R_WITHOUT_B: repeatability of one direction; DIRECTIONS_SWAPPED: forward and
/// backward exchanged; LAST_SAMPLE: the report has other readings than the case, and its figures
/// are those of its own; UNEXPLAINED.
/// @errors Fault::bad_case, as analyze_cases() of the case; of the report with its key.
Result<nlohmann::json> judge_report(const nlohmann::json& document, const nlohmann::json& report);

} // namespace axiscal

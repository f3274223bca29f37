#pragma once
// `tolerances` of a positioning or circular case: the user's limits, and the verdicts on them.
// Pure.

#include "analysis/conformity/tolerances.hpp"
#include "tools/axiscal/cases/positioning_input.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {

/// Limits in the unit of the case; travels in mm or degrees.
struct ToleranceSet : ToleranceRecord {
    AxisKind kind = AxisKind::linear;
};

/// {"name", "source", "unit", "rule", "to_be_checked", "limits": [{"parameter", "travel_up_to_mm"
/// or "travel_up_to_deg", "limit"}]}; converted to the unit of the axis. Without `rule` nothing is
/// decided.
/// @errors Fault::bad_case by field; a parameter that no standard knows, a band that stands twice.
Result<ToleranceSet> tolerance_set_of(const nlohmann::json& member, const CaseAxis& axis);

/// The same of a circular case, in um, without bands. @errors as tolerance_set_of().
Result<ToleranceRecord> circular_tolerances_of(const nlohmann::json& member);

/// Adds `tolerances` (name, source, rule, mark) and `verdicts`; values and expanded uncertainties
/// are taken from `parameters` of the finished document. `travel` in mm or degrees.
void add_verdicts(const ToleranceSet& set, double travel, nlohmann::ordered_json& document);
/// The same of a circular case, whose figures are in mm.
void add_verdicts(ToleranceRecord circular, nlohmann::ordered_json& document);

} // namespace axiscal

#pragma once
// Verdicts on the limits of a run, as JSON and CSV of every kind of test. Pure.

#include "analysis/conformity/conformity.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace axiscal {

/// {"parameter", "value", "U", "limit", "rule", "verdict", "unit", "guard_band", "travel_up_to",
/// "comparison", "reason"}, null where there is none. The verdict is "pass", "fail", "not_provable"
/// or "not_evaluated", and `reason` then says why.
nlohmann::ordered_json verdict_row(const JudgedFigure& figure, const Conformity& conformity);

/// `document` gains "verdict" (of all figures), "verdicts" (a row a limit) and "tolerances" {"name",
/// "source", "rule", "unit" of the limits, "to_be_checked"}; nothing without limits.
void add_conformity(nlohmann::ordered_json& document, const std::optional<Conformity>& conformity);

/// The lines "# tolerances", "# verdict" of all figures and one "# verdict" a limit; nothing without
/// limits.
void append_conformity(std::string& csv, const std::optional<Conformity>& conformity);

} // namespace axiscal

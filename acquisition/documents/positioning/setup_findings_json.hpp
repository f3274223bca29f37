#pragma once
// What the readings say of the set-up, as a member of certificate.json. Pure.

#include "analysis/setup/setup_findings.hpp"

#include <nlohmann/json.hpp>

#include <span>

namespace axiscal {

/// [{"error", "sensor", "value", "unit", "standard_uncertainty", "range_um", "seen", "probably",
/// "look_at"}]. `error` is name_of(SetupError), `unit` that of `value` and its uncertainty. Null:
/// what a finding of this kind does not have.
nlohmann::ordered_json setup_findings_json(std::span<const SetupFinding> findings);

} // namespace axiscal

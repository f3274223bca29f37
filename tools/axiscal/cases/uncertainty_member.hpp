#pragma once
// The member "uncertainty" of a positioning case: reads it, and adds to the result of the case what
// it asks for. Pure.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/uncertainty/budget.hpp"
#include "tools/axiscal/cases/monte_carlo_member.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace axiscal {

struct UncertaintyMember {
    UncertaintyStatement statement;
    std::map<std::string, double> target_uncertainty; ///< U_T by parameter, in the case's unit
    MonteCarloMember monte_carlo;
};

/// Lengths are micrometres (keys ending in _um), on a rotary axis seconds of arc (_arcsec).
/// @errors Fault::bad_case with the field below "uncertainty".
Result<UncertaintyMember> uncertainty_member(const nlohmann::json& member, AxisKind kind);

/// Each parameter of `document` that the budget knows gains "expanded_uncertainty" {value, k} and
/// "budget", in the unit of the case; the document gains "budget". A length that is not stated is
/// the span of the targets. Unless declined, the simulation of add_monte_carlo() stands beside it.
/// Figures already in the document stay as they are.
/// @errors those of make_budget() and simulate_sessions(), with the field below "uncertainty".
Result<void> add_uncertainty(nlohmann::ordered_json& document,
                             UncertaintyMember member,
                             const RunAt20C& run,
                             const PositioningResult& result);

} // namespace axiscal

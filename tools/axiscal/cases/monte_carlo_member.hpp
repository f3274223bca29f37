#pragma once
// The member "monte_carlo" of "uncertainty": how the sessions are simulated, and what stands beside
// the formulas afterwards. Pure.

#include "analysis/uncertainty/monte_carlo.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace axiscal {

struct MonteCarloMember {
    bool asked = true;
    std::optional<int> trials; ///< absent: default_trials()
    std::uint64_t seed = 1;
};

/// false, or {"trials", "seed"}, each with its default.
/// @errors Fault::bad_case with the field below "uncertainty.monte_carlo".
Result<MonteCarloMember> monte_carlo_member(const nlohmann::json& member);

/// Simulates and writes it down by add_simulation_json().
/// @errors those of simulate_sessions(), with the field below "uncertainty.monte_carlo".
Result<void> add_monte_carlo(nlohmann::ordered_json& document,
                             const MonteCarloMember& member,
                             const UncertaintyBudget& budget,
                             const RunAt20C& run,
                             const PositioningResult& result);

} // namespace axiscal

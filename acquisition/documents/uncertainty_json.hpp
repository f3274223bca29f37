#pragma once
// Expanded uncertainties and their budget in a result document, for cases and certificates alike.
// Pure.

#include "analysis/uncertainty/budget.hpp"
#include "analysis/uncertainty/monte_carlo.hpp"
#include "analysis/uncertainty/true_figures.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace axiscal {

/// Each parameter of `document` that the budget knows gains "expanded_uncertainty" {value, k},
/// "budget" and, where a target is given, "target_uncertainty" {value, met}; the document gains
/// "budget". All in `unit`, the targets too. What stands there already stays as it is.
void add_uncertainty_json(nlohmann::ordered_json& document,
                          const UncertaintyBudget& budget,
                          const std::map<std::string, double>& target_uncertainty,
                          const std::string& unit);

/// Each parameter of `document` that was simulated gains "monte_carlo" {mean, u, interval_95,
/// shortest_95}, the document "monte_carlo" with trials, seed, generator and remarks, all in
/// `unit`.
void add_simulation_json(nlohmann::ordered_json& document,
                         const MonteCarloResult& simulated,
                         const UncertaintyBudget& budget,
                         const std::string& unit);

/// Each parameter of `document` whose true figure was searched gains "true_value_95" [low, high],
/// in the unit of the result; the document gains "true_values" with trials, seed and method.
void add_true_figures_json(nlohmann::ordered_json& document, const TrueFigures& found);

} // namespace axiscal

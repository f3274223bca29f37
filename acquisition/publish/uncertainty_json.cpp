#include "acquisition/publish/uncertainty_json.hpp"

namespace axiscal {
namespace {

using nlohmann::ordered_json;

ordered_json term_json(const Contribution& term, double divisor) {
    ordered_json object;
    object["term"] = name_of(term.term);
    object["u"] = term.u / divisor;
    object["formula"] = term.formula;
    object["status"] = term.status;
    object["distribution"] = name_of(term.distribution);
    return object;
}

/// The terms that count in one parameter; (factor u)^2 add up to its u^2.
ordered_json parameter_json(const UncertaintyBudget& budget,
                            const ParameterUncertainty& figure,
                            double divisor) {
    ordered_json object;
    object["u"] = figure.u / divisor;
    object["formula"] = figure.formula;
    object["status"] = figure.status;
    if (figure.strict_u) {
        object["strict_propagation"]["u"] = *figure.strict_u / divisor;
        object["strict_propagation"]["formula"] = "u_EVE sqrt(2 k^2/(n-1) + 2/n)";
    }
    object["terms"] = ordered_json::array();
    for (const Contribution& term : budget.contributions) {
        const bool environment = term.term == UncertaintyTerm::environment;
        const double factor = environment ? figure.environment : figure.systematic;
        if (factor == 0) continue;
        object["terms"].push_back(term_json(term, divisor));
        object["terms"].back()["factor"] = factor;
    }
    return object;
}

ordered_json budget_json(const UncertaintyBudget& budget, const std::string& unit, double divisor) {
    ordered_json object;
    object["source"] = budget.axis_kind == AxisKind::rotary ? "ISO 230-2 annex B, rotary axis"
                                                            : "ISO 230-2 annex A, linear axis";
    object["unit"] = unit;
    object["n"] = budget.approaches;
    object["k"] = budget.coverage;
    object["eve_model"] = name_of(budget.eve_model);
    if (budget.length_m) object["length_m"] = *budget.length_m;
    object["terms"] = ordered_json::array();
    for (const Contribution& term : budget.contributions)
        object["terms"].push_back(term_json(term, divisor));
    object["not_stated"] = budget.not_stated;
    object["marks"] = "S: stands in a source document; R: reconstructed from its structure";
    return object;
}

void add_to_parameter(ordered_json& parameter,
                      const std::map<std::string, double>& targets,
                      const UncertaintyBudget& budget,
                      const ParameterUncertainty& figure,
                      double divisor) {
    const double U = figure.expanded / divisor;
    parameter["expanded_uncertainty"]["value"] = U;
    parameter["expanded_uncertainty"]["k"] = budget.coverage;
    parameter["budget"] = parameter_json(budget, figure, divisor);
    const auto target = targets.find(figure.key);
    if (target == targets.end()) return;
    parameter["target_uncertainty"]["value"] = target->second;
    parameter["target_uncertainty"]["met"] = U <= target->second;
}

} // namespace

double budget_units_per(const std::string& unit) {
    constexpr double um_per_mm = 1e3, um_per_m = 1e6, arcsec_per_deg = 3600;
    if (unit == "mm") return um_per_mm;
    if (unit == "m") return um_per_m;
    return unit == "deg" ? arcsec_per_deg : 1;
}

void add_uncertainty_json(ordered_json& document,
                          const UncertaintyBudget& budget,
                          const std::map<std::string, double>& target_uncertainty,
                          const std::string& unit) {
    const double divisor = budget_units_per(unit);
    for (const ParameterUncertainty& figure : budget.parameters)
        if (auto found = document["parameters"].find(figure.key);
            found != document["parameters"].end())
            add_to_parameter(*found, target_uncertainty, budget, figure, divisor);
    document["budget"] = budget_json(budget, unit, divisor);
}

} // namespace axiscal

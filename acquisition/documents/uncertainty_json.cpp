#include "acquisition/documents/uncertainty_json.hpp"

#include <cmath>

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
    object["source"] = budget.axis_kind == AxisKind::rotary ? "after ISO 230-2 annex A, rotary axis"
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
    const double expanded = figure.expanded / divisor; // U
    parameter["expanded_uncertainty"]["value"] = expanded;
    parameter["expanded_uncertainty"]["k"] = budget.coverage;
    parameter["budget"] = parameter_json(budget, figure, divisor);
    const auto target = targets.find(figure.key);
    if (target == targets.end()) return;
    parameter["target_uncertainty"]["value"] = target->second;
    parameter["target_uncertainty"]["met"] = expanded <= target->second;
}

ordered_json simulated_json(const MonteCarloFigure& figure) {
    const auto& [symmetric, shortest] = figure.interval;
    ordered_json object;
    object["mean"] = figure.mean;
    object["u"] = figure.u;
    object["interval_95"] = {symmetric.low, symmetric.high};
    object["shortest_95"] = {shortest.low, shortest.high};
    return object;
}

/// The source's u(R) counts the spread of one direction for both: told with its size.
std::vector<std::string>
remarks_on(const MonteCarloResult& simulated, const UncertaintyBudget& budget, double divisor) {
    std::vector<std::string> remarks{
        "each reading is drawn by itself, so E and M count the environment at two targets, as "
        "eve_model difference does"};
    const auto ratio = conservatism_of_repeatability(budget, simulated, divisor);
    if (!ratio) return remarks;
    const long percent = std::lround(std::fabs(*ratio - 1) * 100);
    remarks.push_back("u(R) by the source's formula is " + std::to_string(percent) + " % " +
                      (*ratio >= 1 ? "above" : "below") +
                      " the simulated one: the formula adds u(B) to the spread of one direction "
                      "counted in full; strict propagation is under budget of R");
    return remarks;
}

} // namespace

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

void add_simulation_json(ordered_json& document,
                         const MonteCarloResult& simulated,
                         const UncertaintyBudget& budget,
                         const std::string& unit) {
    for (const MonteCarloFigure& figure : simulated.figures)
        if (auto found = document["parameters"].find(figure.key);
            found != document["parameters"].end())
            (*found)["monte_carlo"] = simulated_json(figure);
    ordered_json& summary = document["monte_carlo"];
    summary["trials"] = simulated.trials;
    summary["seed"] = simulated.seed;
    summary["generator"] = "xoshiro256+, 8 streams out of splitmix64(seed)";
    summary["remarks"] = remarks_on(simulated, budget, budget_units_per(unit));
    const auto evaluated = document["parameters"].find("R");
    if (evaluated != document["parameters"].end() &&
        scatters_less_than_stated(evaluated->at("value").get<double>(), simulated))
        summary["remarks"].push_back("the readings scatter less than the stated E_VE allows (the "
                                     "simulated mean of R lies above R by more than its u): look "
                                     "at E_VE");
}

void add_true_figures_json(ordered_json& document, const TrueFigures& found) {
    for (const TrueFigure& figure : found.figures)
        if (auto parameter = document["parameters"].find(figure.key);
            parameter != document["parameters"].end())
            (*parameter)["true_value_95"] = {figure.interval.low, figure.interval.high};
    ordered_json& summary = document["true_values"];
    summary["trials"] = found.trials;
    summary["seed"] = found.seed;
    summary["method"] = "common errors of the budget taken off the readings, those that grow with "
                        "length by the distance of the targets, and a drift in the time of the "
                        "run: a random walk as strong as one that ranges over E_VE";
}

} // namespace axiscal

#include "tools/axiscal/cases/uncertainty_member.hpp"

#include "tools/axiscal/cases/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const std::string field_prefix = "uncertainty.";

/// The statement's members by the keys of the contract.
std::vector<std::pair<std::string, std::optional<double>*>> numbers_of(UncertaintyStatement& s) {
    if (s.axis_kind == AxisKind::rotary)
        return {{"device_U_arcsec", &s.device_U},
                {"k", &s.device_k},
                {"device_width_arcsec", &s.device_width},
                {"eve_arcsec", &s.eve}};
    return {{"device_U_um", &s.device_U},
            {"k", &s.device_k},
            {"device_width_um", &s.device_width},
            {"length_m", &s.length_m},
            {"misalignment_mm", &s.misalignment_mm},
            {"misalignment_rad", &s.misalignment_rad},
            {"alpha_um_per_m_K", &s.alpha_um_per_m_K},
            {"temperature_width_K", &s.temperature_width_K},
            {"temperature_offset_K", &s.temperature_offset_K},
            {"alpha_width_um_per_m_K", &s.alpha_width_um_per_m_K},
            {"device_alpha_um_per_m_K", &s.device_alpha_um_per_m_K},
            {"device_temperature_width_K", &s.device_temperature_width_K},
            {"device_temperature_offset_K", &s.device_temperature_offset_K},
            {"device_alpha_width_um_per_m_K", &s.device_alpha_width_um_per_m_K},
            {"eve_um", &s.eve}};
}

Result<int> approaches_of(const json& member) {
    constexpr double most = 1e6;
    const std::string field = field_prefix + "n";
    AXISCAL_TRY(const double n, number_at(member, "n", field));
    if (n < 1 || n > most || n != std::floor(n))
        return refuse(Fault::bad_case, field, "must be a whole number from 1 to 1e6");
    return static_cast<int>(n);
}

Result<std::map<std::string, double>> targets_of(const json& member) {
    const std::string field = field_prefix + "target_uncertainty";
    const json& object = member.at("target_uncertainty");
    AXISCAL_CHECK(check_object(object, field, uncertain_parameters()));
    std::map<std::string, double> targets;
    for (const std::string& key : uncertain_parameters()) {
        if (!object.contains(key)) continue;
        AXISCAL_TRY(targets[key], number_at(object, key, field + "." + key));
        if (targets[key] < 0) return refuse(Fault::bad_case, field + "." + key, "is negative");
    }
    return targets;
}

/// How many of the budget's unit (um, arcsec) make one of the case's.
double divisor_of(const std::string& unit) {
    constexpr double um_per_mm = 1e3, um_per_m = 1e6, arcsec_per_deg = 3600;
    if (unit == "mm") return um_per_mm;
    if (unit == "m") return um_per_m;
    return unit == "deg" ? arcsec_per_deg : 1;
}

void default_length(UncertaintyStatement& statement, const RunAt20C& run) {
    constexpr double um_per_m = 1e6;
    const auto [low, high] = std::ranges::minmax(run.targets());
    if (statement.axis_kind == AxisKind::linear && !statement.length_m && high > low)
        statement.length_m = (high - low) * divisor_of(run.unit()) / um_per_m;
}

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
                      const UncertaintyMember& member,
                      const UncertaintyBudget& budget,
                      const ParameterUncertainty& figure,
                      double divisor) {
    const double U = figure.expanded / divisor;
    parameter["expanded_uncertainty"]["value"] = U;
    parameter["expanded_uncertainty"]["k"] = budget.coverage;
    parameter["budget"] = parameter_json(budget, figure, divisor);
    const auto target = member.target_uncertainty.find(figure.key);
    if (target == member.target_uncertainty.end()) return;
    parameter["target_uncertainty"]["value"] = target->second;
    parameter["target_uncertainty"]["met"] = U <= target->second;
}

} // namespace

Result<UncertaintyMember> uncertainty_member(const json& member, AxisKind kind) {
    UncertaintyMember out;
    out.statement.axis_kind = kind;
    const auto numbers = numbers_of(out.statement);
    Words known{"n", "eve_model", "target_uncertainty", "monte_carlo"};
    for (const auto& [key, place] : numbers)
        known.push_back(key);
    AXISCAL_CHECK(check_object(member, "uncertainty", known));
    for (const auto& [key, place] : numbers)
        if (member.contains(key)) {
            AXISCAL_TRY(*place, number_at(member, key, field_prefix + key));
        }
    if (member.contains("n")) {
        AXISCAL_TRY(out.approaches, approaches_of(member));
    }
    if (member.contains("eve_model")) {
        AXISCAL_TRY(const std::string model, one_of(member, "eve_model", field_prefix + "eve_model",
                                                    {"mean", "difference"}));
        if (model == "difference") out.statement.eve_model = EveModel::difference;
    }
    if (member.contains("target_uncertainty")) {
        AXISCAL_TRY(out.target_uncertainty, targets_of(member));
    }
    if (member.contains("monte_carlo")) {
        AXISCAL_TRY(out.monte_carlo, monte_carlo_member(member.at("monte_carlo")));
    }
    return out;
}

Result<void> add_uncertainty(ordered_json& document,
                             UncertaintyMember member,
                             const RunAt20C& run,
                             const PositioningResult& result) {
    default_length(member.statement, run);
    auto budget = make_budget(member.statement, member.approaches.value_or(result.approaches),
                              static_cast<int>(run.targets().size()), result.cover_factor);
    if (!budget)
        return refuse(Fault::bad_case, field_prefix + budget.error().field, budget.error().detail);
    const double divisor = divisor_of(result.unit);
    for (const ParameterUncertainty& figure : budget->parameters)
        if (auto found = document["parameters"].find(figure.key);
            found != document["parameters"].end())
            add_to_parameter(*found, member, *budget, figure, divisor);
    document["budget"] = budget_json(*budget, result.unit, divisor);
    if (!member.monte_carlo.asked) return {};
    return add_monte_carlo(document, member.monte_carlo, *budget, run, result, divisor);
}

} // namespace axiscal

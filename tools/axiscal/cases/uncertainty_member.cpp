#include "tools/axiscal/cases/uncertainty_member.hpp"

#include "acquisition/documents/uncertainty_json.hpp"
#include "tools/axiscal/cases/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const std::string field_prefix = "uncertainty.";

struct Number {
    std::string key;
    std::optional<double>* place;
    double factor = 1; ///< into the unit of the statement
};

/// The statement's members by the keys of the contract.
std::vector<Number> numbers_of(UncertaintyStatement& s) {
    constexpr double arcsec_per_deg = 3600, um_per_m_K = 1e6;
    if (s.axis_kind == AxisKind::rotary)
        return {{"device_U_arcsec", &s.device_U},
                {"device_U_deg", &s.device_U, arcsec_per_deg},
                {"k", &s.device_k},
                {"device_width_arcsec", &s.device_width},
                {"device_width_deg", &s.device_width, arcsec_per_deg},
                {"eve_arcsec", &s.eve},
                {"eve_deg", &s.eve, arcsec_per_deg}};
    return {{"device_U_um", &s.device_U},
            {"k", &s.device_k},
            {"device_width_um", &s.device_width},
            {"length_m", &s.length_m},
            {"misalignment_mm", &s.misalignment_mm},
            {"misalignment_rad", &s.misalignment_rad},
            {"expansion_per_K", &s.alpha_um_per_m_K, um_per_m_K},
            {"temperature_width_K", &s.temperature_width_K},
            {"temperature_offset_K", &s.temperature_offset_K},
            {"expansion_width_per_K", &s.alpha_width_um_per_m_K, um_per_m_K},
            {"device_expansion_per_K", &s.device_alpha_um_per_m_K, um_per_m_K},
            {"device_temperature_width_K", &s.device_temperature_width_K},
            {"device_temperature_offset_K", &s.device_temperature_offset_K},
            {"device_expansion_width_per_K", &s.device_alpha_width_um_per_m_K, um_per_m_K},
            {"eve_um", &s.eve}};
}

std::string key_to_take(bool rotary, const std::string& name) {
    return rotary ? "is a length; a rotary axis takes '" + name + "_arcsec' or '" + name + "_deg'"
                  : "is an angle; a linear axis takes '" + name + "_um'";
}

/// A micrometre is no angle without a radius, and an angle no length: told with the key to take.
Result<void> check_units(const json& member, AxisKind kind) {
    const bool rotary = kind == AxisKind::rotary;
    for (const std::string name : {"device_U", "device_width", "eve"})
        for (const char* unit : {"_um", "_arcsec", "_deg"}) {
            const bool is_length = unit == std::string_view{"_um"};
            if (is_length != rotary || !member.contains(name + unit)) continue;
            return refuse(Fault::bad_case, field_prefix + name + unit, key_to_take(rotary, name));
        }
    return {};
}

/// It may be stated; the rows decide, and positioning_remarks() tells where they say something
/// else.
Result<void> check_approaches(const json& member) {
    constexpr double most = 1e6;
    if (!member.contains("n")) return {};
    const std::string field = field_prefix + "n";
    AXISCAL_TRY(const double n, number_at(member, "n", field));
    if (n < 1 || n > most || n != std::floor(n))
        return refuse(Fault::bad_case, field, "must be a whole number from 1 to 1e6");
    return {};
}

Result<std::map<std::string, double>> targets_of(const json& member) {
    const std::string field = field_prefix + "target_uncertainty";
    const json& object = member.at("target_uncertainty");
    AXISCAL_CHECK(check_object(object, field, uncertain_parameters()));
    std::map<std::string, double> targets;
    const std::string place_in_it = field + ".";
    for (const std::string& key : uncertain_parameters()) {
        if (!object.contains(key)) continue;
        AXISCAL_TRY(targets[key], number_at(object, key, place_in_it + key));
        if (targets[key] < 0) return refuse(Fault::bad_case, place_in_it + key, "is negative");
    }
    return targets;
}

void default_length(UncertaintyStatement& statement, const RunAt20C& run) {
    constexpr double um_per_m = 1e6;
    const auto [low, high] = std::ranges::minmax(run.targets());
    if (statement.axis_kind == AxisKind::linear && !statement.length_m && high > low)
        statement.length_m = (high - low) * budget_units_per(run.unit()) / um_per_m;
}

} // namespace

Result<UncertaintyMember> uncertainty_member(const json& member, AxisKind kind) {
    UncertaintyMember out;
    out.statement.axis_kind = kind;
    const auto numbers = numbers_of(out.statement);
    Words known{"n", "eve_model", "target_uncertainty", "monte_carlo"};
    for (const Number& number : numbers)
        known.push_back(number.key);
    if (member.is_object()) AXISCAL_CHECK(check_units(member, kind));
    AXISCAL_CHECK(check_object(member, "uncertainty", known));
    for (const auto& [key, place, factor] : numbers)
        if (member.contains(key)) {
            if (*place)
                return refuse(Fault::bad_case, field_prefix + key, "is stated in another unit too");
            AXISCAL_TRY(const double value, number_at(member, key, field_prefix + key));
            *place = value * factor;
        }
    AXISCAL_CHECK(check_approaches(member));
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
    const int approaches = fewest_readings(run); // the largest U
    auto budget = make_budget(member.statement, approaches, static_cast<int>(run.targets().size()),
                              result.cover_factor);
    if (!budget)
        return refuse(Fault::bad_case, field_prefix + budget.error().field, budget.error().detail);
    add_uncertainty_json(document, *budget, member.target_uncertainty, result.unit);
    const bool uneven = approaches != result.approaches; // a simulation draws the same n
    if (!member.monte_carlo.asked || uneven) return {};
    return add_monte_carlo(document, member.monte_carlo, *budget, run, result);
}

} // namespace axiscal

#include "tools/axiscal/cases/monte_carlo_member.hpp"

#include "acquisition/documents/uncertainty_json.hpp"
#include "tools/axiscal/cases/case_reader.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const std::string simulation_field_prefix = "uncertainty.monte_carlo.";

/// Whole numbers that a double holds exactly.
Result<double> whole_at(const json& member, const std::string& key, double least, double most) {
    AXISCAL_TRY(const double number, number_at(member, key, simulation_field_prefix + key));
    if (number >= least && number <= most && number == std::floor(number)) return number;
    return refuse(Fault::bad_case, simulation_field_prefix + key,
                  "must be a whole number from " + std::to_string(static_cast<long long>(least)) +
                      " to " + std::to_string(static_cast<long long>(most)));
}

} // namespace

Result<MonteCarloMember> monte_carlo_member(const json& member) {
    constexpr double most_trials = 1e7, most_seed = 9007199254740991; // 2^53 - 1
    MonteCarloMember out;
    if (member.is_boolean() && !member.get<bool>()) {
        out.asked = false;
        return out;
    }
    AXISCAL_CHECK(check_object(member, "uncertainty.monte_carlo", {"trials", "seed"}));
    if (member.contains("trials")) {
        AXISCAL_TRY(const double trials, whole_at(member, "trials", 1000, most_trials));
        out.trials = static_cast<int>(trials);
    }
    if (member.contains("seed")) {
        AXISCAL_TRY(const double seed, whole_at(member, "seed", 0, most_seed));
        out.seed = static_cast<std::uint64_t>(seed);
    }
    return out;
}

Result<void> add_monte_carlo(ordered_json& document,
                             const MonteCarloMember& member,
                             const UncertaintyBudget& budget,
                             const RunAt20C& run,
                             const PositioningResult& result) {
    const MonteCarloRequest request{member.trials.value_or(default_trials(run)), member.seed};
    const auto simulated = simulate_sessions(
        run, result, session_errors(budget, budget_units_per(result.unit)), request);
    if (!simulated)
        return refuse(Fault::bad_case, simulation_field_prefix + simulated.error().field,
                      simulated.error().detail);
    add_simulation_json(document, *simulated, budget, result.unit);
    return {};
}

} // namespace axiscal

#include "tools/axiscal/cases/monte_carlo_member.hpp"

#include "tools/axiscal/cases/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const std::string field_prefix = "uncertainty.monte_carlo.";

/// Whole numbers that a double holds exactly.
Result<double> whole_at(const json& member, const std::string& key, double least, double most) {
    AXISCAL_TRY(const double number, number_at(member, key, field_prefix + key));
    if (number >= least && number <= most && number == std::floor(number)) return number;
    return refuse(Fault::bad_case, field_prefix + key,
                  "must be a whole number from " + std::to_string(static_cast<long long>(least)) +
                      " to " + std::to_string(static_cast<long long>(most)));
}

ordered_json figure_json(const MonteCarloFigure& figure) {
    const auto& [symmetric, shortest] = figure.interval;
    ordered_json object;
    object["mean"] = figure.mean;
    object["u"] = figure.u;
    object["interval_95"] = {symmetric.low, symmetric.high};
    object["shortest_95"] = {shortest.low, shortest.high};
    return object;
}

/// The source's u(R) counts the spread of one direction for both: told with its size.
std::vector<std::string> remarks_on(const MonteCarloResult& simulated,
                                    const UncertaintyBudget& budget,
                                    double budget_per_unit) {
    std::vector<std::string> remarks{
        "each reading is drawn by itself, so E and M count the environment at two targets, as "
        "eve_model difference does"};
    const auto drawn = std::ranges::find(simulated.figures, "R", &MonteCarloFigure::key);
    const ParameterUncertainty* formula = budget.find("R");
    if (drawn == simulated.figures.end() || !formula || !(drawn->u > 0)) return remarks;
    const double ratio = formula->u / budget_per_unit / drawn->u;
    const long percent = std::lround(std::fabs(ratio - 1) * 100);
    remarks.push_back("u(R) by the source's formula is " + std::to_string(percent) + " % " +
                      (ratio >= 1 ? "above" : "below") +
                      " the simulated one: the formula adds u(B) to the spread of one direction "
                      "counted in full; strict propagation is under budget of R");
    return remarks;
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
                             const PositioningResult& result,
                             double budget_per_unit) {
    const MonteCarloRequest request{member.trials.value_or(default_trials(run)), member.seed};
    const auto simulated =
        simulate_sessions(run, result, session_errors(budget, budget_per_unit), request);
    if (!simulated)
        return refuse(Fault::bad_case, field_prefix + simulated.error().field,
                      simulated.error().detail);
    for (const MonteCarloFigure& figure : simulated->figures)
        if (auto found = document["parameters"].find(figure.key);
            found != document["parameters"].end())
            (*found)["monte_carlo"] = figure_json(figure);
    ordered_json& summary = document["monte_carlo"];
    summary["trials"] = simulated->trials;
    summary["seed"] = simulated->seed;
    summary["generator"] = "xoshiro256+, 8 streams out of splitmix64(seed)";
    summary["remarks"] = remarks_on(*simulated, budget, budget_per_unit);
    return {};
}

} // namespace axiscal

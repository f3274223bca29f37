#include "analysis/uncertainty/monte_carlo.hpp"

#include "analysis/uncertainty/random_lanes.hpp"
#include "analysis/uncertainty/session_kernel.hpp"
#include "analysis/uncertainty/session_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

/// The draws of one group of eight sessions: uniform ones first, then those turned normal.
class Draws {
public:
    Draws(const SessionErrors& errors, std::size_t readings, std::uint64_t seed)
        : random_{seed}
        , code_{fastest_lane_code()} {
        const bool normal_readings = errors.environment == Distribution::normal;
        for (const auto& common : errors.common)
            if (common.distribution == Distribution::rectangular) add(common);
        uniform_ = places_.size();
        const std::size_t normals = errors.common.size() - uniform_;
        // normal common draws stand beside normal readings, so that one call makes them
        std::size_t normal_at = uniform_ + readings;
        first_normal_ = normal_readings ? uniform_ : normal_at;
        for (const auto& common : errors.common)
            if (common.distribution == Distribution::normal) {
                places_.push_back(normal_at++);
                scales_.push_back(factor_of_draw(common.u, common.distribution));
            }
        count_ = uniform_ + readings + normals;
        numbers_.resize(count_ * lanes);
    }

    void next() {
        fill_uniform(random_, numbers_.data(), count_, code_);
        to_normal(numbers_.data() + first_normal_ * lanes, (count_ - first_normal_) * lanes, code_);
        common_.fill(0);
        for (std::size_t c = 0; c < places_.size(); ++c)
            for (std::size_t l = 0; l < lanes; ++l)
                common_[l] += scales_[c] * numbers_[places_[c] * lanes + l];
    }
    [[nodiscard]] const double* readings() const { return numbers_.data() + uniform_ * lanes; }
    [[nodiscard]] const std::array<double, lanes>& common() const { return common_; }
    [[nodiscard]] LaneCode code() const { return code_; }

private:
    void add(const SessionErrors::Common& common) {
        places_.push_back(places_.size());
        scales_.push_back(factor_of_draw(common.u, common.distribution));
    }

    RandomLanes random_;
    LaneCode code_;
    std::size_t count_ = 0, uniform_ = 0, first_normal_ = 0;
    std::vector<std::size_t> places_; ///< of each common draw
    std::vector<double> scales_, numbers_;
    std::array<double, lanes> common_{};
};

/// Simulates group after group of eight sessions.
class Simulation {
public:
    Simulation(const SessionModel& model, Draws draws)
        : draws_(std::move(draws))
        , model_(model)
        , scratch_{model} {}
    const Figures& next() {
        draws_.next();
        evaluate_sessions(model_, draws_.readings(), draws_.common(), scratch_, figures_,
                          draws_.code());
        return figures_;
    }

private:
    Draws draws_;
    const SessionModel& model_;
    SessionScratch scratch_;
    Figures figures_{};
};

} // namespace

SessionErrors session_errors(const UncertaintyBudget& budget, double budget_per_unit) {
    constexpr double um_per_m = 1e6;
    SessionErrors errors;
    for (const Contribution& term : budget.contributions)
        if (term.term == UncertaintyTerm::environment) {
            errors.environment_u = term.u / budget_per_unit;
            errors.environment = term.distribution;
        } else {
            errors.common.push_back({term.u / budget_per_unit, term.distribution,
                                     term.term == UncertaintyTerm::misalignment});
        }
    if (budget.length_m) errors.length = *budget.length_m * um_per_m / budget_per_unit;
    return errors;
}

const MonteCarloFigure* MonteCarloResult::find(std::string_view key) const {
    const auto found = std::ranges::find(figures, key, &MonteCarloFigure::key);
    return found == figures.end() ? nullptr : &*found;
}

std::optional<double> conservatism_of_repeatability(const UncertaintyBudget& budget,
                                                    const MonteCarloResult& simulated,
                                                    double budget_per_unit) {
    const MonteCarloFigure* drawn = simulated.find("R");
    const ParameterUncertainty* formula = budget.find("R");
    if (!drawn || !formula || !(drawn->u > 0)) return std::nullopt;
    return formula->u / budget_per_unit / drawn->u;
}

bool scatters_less_than_stated(std::optional<double> evaluated_R,
                               const MonteCarloResult& simulated) {
    const MonteCarloFigure* drawn = simulated.find("R");
    return evaluated_R && drawn && drawn->mean > *evaluated_R + drawn->u;
}

Result<void> check_trials(std::size_t readings, const MonteCarloRequest& request) {
    constexpr int fewest = 1000, most = 10'000'000;
    constexpr double most_readings = 2e9;
    if (request.trials < fewest || request.trials > most)
        return refuse(Fault::bad_case, "trials", "must be from 1000 to 10000000");
    if (request.trials * static_cast<double>(readings) > most_readings)
        return refuse(Fault::bad_case, "trials",
                      "times the readings is above 2e9: too long a wait");
    return {};
}

int default_trials(const RunAt20C& run) {
    constexpr double most = 100'000, least = 10'000, readings_in_all = 2e7;
    const auto readings = static_cast<double>(number_of_readings(run));
    return static_cast<int>(std::clamp(readings_in_all / readings, least, most));
}

Result<MonteCarloResult> simulate_sessions(const RunAt20C& run,
                                           const PositioningResult& result,
                                           const SessionErrors& errors,
                                           const MonteCarloRequest& request) {
    AXISCAL_CHECK(check_equal_rows(run));
    AXISCAL_CHECK(check_trials(number_of_readings(run), request));
    const std::size_t groups = (static_cast<std::size_t>(request.trials) + lanes - 1) / lanes;
    SessionModel model = session_model_of(run, result, errors.length);
    model.environment = factor_of_draw(errors.environment_u, errors.environment);
    Simulation simulation{model, Draws{errors, model.readings(), request.seed}};
    const EvaluatedFigures evaluated = evaluated_figures(result.parameters);
    const FigureTally tally = tally_of(simulation, groups, evaluated.values);
    MonteCarloResult out{static_cast<int>(groups * lanes), request.seed, {}};
    for (const std::size_t f : evaluated.present)
        out.figures.push_back({uncertain_parameters()[f], tally.mean(f),
                               tally.standard_deviation(f), tally.intervals(f)});
    return out;
}

} // namespace axiscal

#include "analysis/uncertainty/monte_carlo.hpp"

#include "analysis/uncertainty/random_lanes.hpp"
#include "analysis/uncertainty/session_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

std::size_t readings_of(const RunAt20C& run) {
    const std::size_t directions = run.backward().empty() ? 1 : 2;
    return directions * run.targets().size() * run.forward().front().size();
}

/// The kernel draws the same n of every target and direction.
Result<void> check_equal_rows(const RunAt20C& run) {
    const std::size_t n = run.forward().front().size();
    for (const auto* side : {&run.forward(), &run.backward()})
        if (std::ranges::any_of(*side, [n](const auto& row) { return row.size() != n; }))
            return refuse(Fault::bad_case, "readings",
                          "differ in number between targets: a simulation draws the same n");
    return {};
}

void add_rows(SessionModel& model,
              const std::vector<std::vector<double>>& rows,
              bool forward,
              const PositioningResult& result) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const PositionRow& row = result.positions[i];
        const double mean = forward ? row.mean_forward : row.mean_backward.value_or(0);
        model.mean.push_back(mean);
        for (const double reading : rows[i])
            model.residual.push_back(reading - mean);
    }
}

/// Share of the length at which each target lies, from the lowest one.
std::vector<double> shape_of(const std::vector<double>& targets, double length) {
    const auto [low, high] = std::ranges::minmax(targets);
    const double whole = length > 0 ? length : high - low;
    std::vector<double> shape;
    shape.reserve(targets.size());
    for (const double target : targets)
        shape.push_back(whole > 0 ? (target - low) / whole : 0);
    return shape;
}

/// What turns a draw into an error: uniform draws have a width of one, normal ones a deviation of
/// one.
double scale_of(double u, Distribution distribution) {
    return distribution == Distribution::normal ? u : u * std::sqrt(12.0);
}

SessionModel
model_of(const RunAt20C& run, const PositioningResult& result, const SessionErrors& errors) {
    SessionModel model;
    model.targets = run.targets().size();
    model.approaches = run.forward().front().size();
    model.cover_factor = result.cover_factor;
    add_rows(model, run.forward(), true, result);
    if (run.backward().empty())
        add_rows(model, run.forward(), true, result);
    else
        add_rows(model, run.backward(), false, result);
    model.shape = shape_of(run.targets(), errors.length);
    model.environment = scale_of(errors.environment_u, errors.environment);
    return model;
}

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
                scales_.push_back(scale_of(common.u, common.distribution));
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
        scales_.push_back(scale_of(common.u, common.distribution));
    }

    RandomLanes random_;
    LaneCode code_;
    std::size_t count_ = 0, uniform_ = 0, first_normal_ = 0;
    std::vector<std::size_t> places_; ///< of each common draw
    std::vector<double> scales_, numbers_;
    std::array<double, lanes> common_{};
};

/// The figures that `p` has, and 0 where it has none.
std::array<double, figure_count> evaluated_of(const PositioningParameters& p,
                                              std::vector<std::size_t>& present) {
    const std::array<std::optional<double>, figure_count> figures{
        p.A, p.A_forward, p.A_backward, p.E,          p.E_forward, p.E_backward,
        p.M, p.R,         p.R_forward,  p.R_backward, p.B,         p.B_mean};
    std::array<double, figure_count> evaluated{};
    for (std::size_t f = 0; f < figure_count; ++f) {
        if (figures[f]) present.push_back(f);
        evaluated[f] = figures[f].value_or(0);
    }
    return evaluated;
}

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

FigureTally tally_of(Simulation& simulation,
                     std::size_t groups,
                     const std::array<double, figure_count>& evaluated) {
    constexpr std::size_t most_pilots = 512; // 4096 sessions show the range
    const LaneCode code = fastest_lane_code();
    std::vector<Figures> pilot(std::min(groups, most_pilots));
    for (Figures& figures : pilot)
        figures = simulation.next();
    FigureTally tally{evaluated, pilot};
    for (const Figures& figures : pilot)
        tally.add(figures, code);
    for (std::size_t g = pilot.size(); g < groups; ++g)
        tally.add(simulation.next(), code);
    return tally;
}

} // namespace

SessionErrors session_errors(const UncertaintyBudget& budget, double budget_per_unit) {
    constexpr double um_per_m = 1e6;
    SessionErrors errors;
    for (const Contribution& term : budget.contributions)
        if (term.term == UncertaintyTerm::environment) {
            errors.environment_u = term.u / budget_per_unit;
            errors.environment = term.distribution;
        } else {
            errors.common.push_back({term.u / budget_per_unit, term.distribution});
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

int default_trials(const RunAt20C& run) {
    constexpr double most = 100'000, least = 10'000, readings_in_all = 2e7;
    const auto readings = static_cast<double>(readings_of(run));
    return static_cast<int>(std::clamp(readings_in_all / readings, least, most));
}

Result<MonteCarloResult> simulate_sessions(const RunAt20C& run,
                                           const PositioningResult& result,
                                           const SessionErrors& errors,
                                           const MonteCarloRequest& request) {
    AXISCAL_CHECK(check_equal_rows(run));
    constexpr int fewest = 1000, most = 10'000'000;
    constexpr double most_readings = 2e9;
    if (request.trials < fewest || request.trials > most)
        return refuse(Fault::bad_case, "trials", "must be from 1000 to 10000000");
    if (request.trials * static_cast<double>(readings_of(run)) > most_readings)
        return refuse(Fault::bad_case, "trials",
                      "times the readings is above 2e9: too long a wait");
    const std::size_t groups = (static_cast<std::size_t>(request.trials) + lanes - 1) / lanes;
    const SessionModel model = model_of(run, result, errors);
    Simulation simulation{model, Draws{errors, model.readings(), request.seed}};
    std::vector<std::size_t> present;
    const auto evaluated = evaluated_of(result.parameters, present);
    const FigureTally tally = tally_of(simulation, groups, evaluated);
    MonteCarloResult out{static_cast<int>(groups * lanes), request.seed, {}};
    for (const std::size_t f : present)
        out.figures.push_back({uncertain_parameters()[f], tally.mean(f),
                               tally.standard_deviation(f), tally.intervals(f)});
    return out;
}

} // namespace axiscal

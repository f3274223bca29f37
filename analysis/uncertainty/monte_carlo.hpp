#pragma once
// Monte Carlo evaluation of a whole session (JCGM 101, GUM supplement 1): the check of the budget
// by a second method. Pure: a seed gives the same bits on every CPU, compiler and preset.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/uncertainty/budget.hpp"
#include "analysis/uncertainty/figure_tally.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// How the readings of a session may be wrong, in the unit of the run.
struct SessionErrors {
    struct Common {
        double u = 0; ///< standard uncertainty over the whole length
        Distribution distribution = Distribution::rectangular;
        /// A beam off the axis reads short, never long. simulate_true_figures() alone heeds it.
        bool one_sided = false;
    };
    /// Drawn once a session and grown in proportion to the distance from the lowest target, so that
    /// two targets a length apart differ by the whole of it: neither averages down nor reaches R,
    /// B.
    std::vector<Common> common;
    double length = 0;        ///< L; 0: the span of the targets
    double environment_u = 0; ///< of each reading by itself: u_EVE
    Distribution environment = Distribution::rectangular;
};

/// The budget's contributions as errors of readings. simulate_sessions() draws a misalignment about
/// its middle: the budget takes its width alone, so does this. `budget_per_unit`: how many um
/// (arcsec) one unit of the run has.
SessionErrors session_errors(const UncertaintyBudget& budget, double budget_per_unit);

struct MonteCarloRequest {
    int trials = 100'000; ///< 1000 ... 1e7, and trials x readings at most 2e9
    std::uint64_t seed = 1;
};

/// @errors Fault::bad_case "trials" outside the bounds.
Result<void> check_trials(std::size_t readings, const MonteCarloRequest& request);

struct MonteCarloFigure {
    std::string key;
    double mean = 0; ///< beside the evaluated figure: extremes of noisy values lie further out
    double u = 0;
    CoverageIntervals interval; ///< 95 %
};

struct MonteCarloResult {
    int trials = 0; ///< the request, rounded up to whole groups of eight
    std::uint64_t seed = 0;
    std::vector<MonteCarloFigure> figures; ///< those that `result` has, in the contract's order
    [[nodiscard]] const MonteCarloFigure* find(std::string_view key) const;
};

/// Draws `trials` sessions about the measured one and evaluates each by the formulas of
/// evaluate_positioning(), which made `result` from `run`. Every reading has its own draw of the
/// environment, so E counts it at two targets: the budget's EveModel::difference. Sampling error of
/// u about u / sqrt(2 trials); the quantile function adds 1e-9.
/// @errors Fault::bad_case "trials" outside the bounds; "readings" that differ in number between
/// targets or directions.
Result<MonteCarloResult> simulate_sessions(const RunAt20C& run,
                                           const PositioningResult& result,
                                           const SessionErrors& errors,
                                           const MonteCarloRequest& request);

/// u(R) of the budget's formula over the simulated one, both made of the same statement: above 1
/// the formula is conservative. None where either lacks R.
std::optional<double> conservatism_of_repeatability(const UncertaintyBudget& budget,
                                                    const MonteCarloResult& simulated,
                                                    double budget_per_unit);

/// Whether readings scatter less than the stated environment allows: the simulated mean of R lies
/// above the evaluated R by more than its u. The formulas and the simulation then tell of E_VE, not
/// of the machine. false without R.
bool scatters_less_than_stated(std::optional<double> evaluated_R,
                               const MonteCarloResult& simulated);

/// Trials that a case gets when it does not say: 100000, fewer for many readings (2e7 in all),
/// never below 10000. About 20 ms for 11 targets, 5 approaches, both directions.
int default_trials(const RunAt20C& run);

} // namespace axiscal

#pragma once
// The uncertainty budget of one run: what its station file stated (UncertaintySetup), completed by
// what the run itself knows. Pure.

#include "analysis/record/run_record.hpp"
#include "analysis/uncertainty/budget.hpp"
#include "analysis/uncertainty/monte_carlo.hpp"
#include "analysis/uncertainty/true_figures.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// What a complete budget needs and the run does not give.
struct MissingTerm {
    std::string name;  ///< one word for a page's head: "device"
    std::string words; ///< "the expanded uncertainty of the laser system"
};

struct RunUncertainty {
    UncertaintyStatement statement; ///< what make_budget() was given
    /// `parameters` holds those alone whose every term is stated: with a term left out, U would be
    /// too small. None without a statement in the run, or when it was refused.
    std::optional<UncertaintyBudget> budget;
    /// The whole evaluation simulated with the same statement, beside the formulas: of the
    /// parameters that `budget` holds, in the unit of the result. None without a budget.
    std::optional<MonteCarloResult> simulation;
    /// Where the true figures lie, of the same parameters; in the unit of the result.
    std::optional<TrueFigures> true_figures;
    std::vector<MissingTerm> missing; ///< empty: the certificate is final
    std::vector<std::string> remarks; ///< what was derived instead of stated
};

/// L is the span of the targets, dT the largest |theta - 20| of all material readings of the run,
/// n and m are those of the plan, alpha that of the compensation. A device limit for each metre is
/// taken over L. A width of the expansion coefficient that is not stated is 2 sqrt(3) times its
/// standard uncertainty, if that one is. A statement that no budget can be made of (a beam off by a
/// tenth of L) takes no measured run its certificate: it is named in `missing`.
RunUncertainty uncertainty_of(const RunRecord& run, double edition_k);
/// The readings that the figures are made of.
struct ReadingsInUse {
    int approaches = 0;       ///< the fewest of a target and direction
    std::vector<int> targets; ///< 0-based, of the plan
};
/// The same where readings are missing: L is the span of these targets, m their number, n the
/// fewest readings. Every factor of the budget falls with n, so that no U is too small. A remark
/// says so.
RunUncertainty uncertainty_of(const RunRecord& run, double edition_k, const ReadingsInUse& used);

/// Fills `known.simulation` and `known.true_figures`. The seed is the plan's or, of a plan without
/// one, made of the run's id (FNV-1a), its low 53 bits: the same run gives the same bits anywhere
/// and for ever, and a case can state the same seed. `result` was evaluated from `deviations`,
/// which hold every point of the targets in use. @param targets  ReadingsInUse::targets
void simulate_run(RunUncertainty& known,
                  const RunRecord& run,
                  const RunAt20C& deviations,
                  const PositioningResult& result,
                  const std::vector<int>& targets);

/// Seconds of arc of a coordinate of a rotary axis, where one millimetre stands for one degree.
constexpr double arcsec_of(Length angle) {
    return angle.in(mm)*3600;
}
/// A stated amount in the unit of the budget: micrometres, of a rotary axis seconds of arc.
double in_budget_units(const RunRecord& run, Length amount);

/// U_T of one parameter; null when none is stated.
const TargetUncertainty* target_uncertainty_of(const RunRecord& run, std::string_view parameter);

} // namespace axiscal

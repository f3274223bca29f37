#pragma once
// A straightness test as it was evaluated from its run file: what every paper of it says. Pure.

#include "acquisition/documents/straightness/across_run_file.hpp"
#include "analysis/straightness/straightness_budget.hpp"
#include "analysis/straightness/straightness_trials.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// The mean line of both directions, or that of one, with its uncertainty against each reference.
struct BudgetedLine {
    std::string_view name; ///< "mean" | "forward" | "backward"
    StraightnessLine found;
    StraightnessBudget budget;
};

/// A figure under the name by which a limit knows it, um.
struct NamedStraightness {
    std::string key; ///< "straightness_least_squares", "straightness_end_points_forward"
    double value_um = 0;
    std::optional<double> expanded_um; ///< U; absent: not evaluated
};

/// What a straightness test gave.
struct StraightnessResult : AcrossRun {
    std::vector<BudgetedLine> lines; ///< mean, forward; backward of a two-way plan
    /// The form of the mirror in its normal position, where reversal parted it from the motion:
    /// then figures and lines are the mean of both positions.
    std::optional<StraightnessLine> mirror;
    std::optional<TriedStraightness> tried; ///< of the mean line, where its budget is whole

    [[nodiscard]] const StraightnessSetup& setup() const { return optics(); }
    [[nodiscard]] const BudgetedLine& mean() const { return lines.front(); }
};

/// Computes everything of a run file that was read; without its hash. Of a run that is open, or was
/// closed as incomplete, the partial result. Nothing is brought to 20 degC.
/// @errors Fault::bad_run_file naming `path` without a set-up or of a rotary axis; those of
/// read_straightness(), evaluate_straightness() and make_straightness_budget().
Result<StraightnessResult> straightness_result_of(const std::string& path,
                                                  RunFileContents contents);

const StraightnessUncertainty& uncertainty_against(const BudgetedLine& line,
                                                   LineReference reference);

/// Every figure, that of the mean against each reference first, B, B_mean and R last.
std::vector<NamedStraightness> figures_of(const StraightnessResult& result);

/// u of the main figure by what errs at each reading by itself: the part that the trials repeat.
std::optional<double> independent_u_um(const StraightnessResult& result);

/// "E_YX": the motion of X in the direction of Y (ISO 230-1:2012); of an axis without a name "E_Y".
std::string straightness_symbol_of(const StraightnessResult& result);

} // namespace axiscal

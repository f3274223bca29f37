#pragma once
// A straightness test as it was evaluated from its run file: what every paper of it says. Pure.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/conformity/conformity.hpp"
#include "analysis/positioning/completeness.hpp"
#include "analysis/straightness/run_straightness.hpp"
#include "analysis/straightness/straightness_trials.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// The figure that a paper leads with; a station names no other so far.
inline constexpr LineReference main_reference = LineReference::least_squares;
inline constexpr std::array line_references{LineReference::end_points, LineReference::least_squares,
                                            LineReference::minimum_zone};

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

/// What a straightness test gave. With `completeness.partial()` it bears no number and no verdict.
struct StraightnessResult {
    RunRecord run; ///< its times told by one clock (run_clock.hpp)
    RunRevisions revisions;
    RunAttachments attachments;
    StraightnessReadings readings;
    StraightnessFigures figures;
    Completeness completeness;
    std::vector<BudgetedLine> lines;        ///< mean, forward; backward of a two-way plan
    std::optional<TriedStraightness> tried; ///< of the mean line, where its budget is whole
    std::vector<std::string> remarks;
    std::optional<Conformity> conformity; ///< of a complete test with limits
    std::string replaces;                 ///< the certificate that this one replaces; empty: none
    std::string run_file_sha256, result_digest;

    [[nodiscard]] const StraightnessSetup& setup() const;
    [[nodiscard]] const BudgetedLine& mean() const { return lines.front(); }
};

/// Computes everything of a run file that was read; without its hash. Of a run that is open, or was
/// closed as incomplete, the partial result. Nothing is brought to 20 degC.
/// @errors Fault::bad_run_file naming `path` without a set-up or of a rotary axis; those of
/// read_straightness(), evaluate_straightness() and make_straightness_budget().
Result<StraightnessResult> straightness_result_of(const std::string& path,
                                                  RunFileContents contents);

const ReferenceLine& line_against(const Straightness& against, LineReference reference);
const StraightnessUncertainty& uncertainty_against(const BudgetedLine& line,
                                                   LineReference reference);

/// Every figure, that of the mean against each reference first, B, B_mean and R last.
std::vector<NamedStraightness> figures_of(const StraightnessResult& result);

/// u of the main figure by what errs at each reading by itself: the part that the trials repeat.
std::optional<double> independent_u_um(const StraightnessResult& result);

/// "E_YX": the motion of X in the direction of Y (ISO 230-1:2012); of an axis without a name "E_Y".
std::string straightness_symbol_of(const StraightnessResult& result);

} // namespace axiscal

#pragma once
// A squareness test as it was evaluated from its run file: what every paper of it says. Pure.

#include "acquisition/documents/straightness/across_run_file.hpp"
#include "analysis/squareness/squareness_budget.hpp"
#include "analysis/squareness/squareness_figures.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// One of the lines that a squareness is made of, and the run that gave it.
struct SquareLine {
    SquarePosition square = SquarePosition::normal;
    RecordedLine recorded;
    StraightnessLine found;
};

/// A figure under the name by which a limit knows it.
struct NamedSquareness {
    std::string key; ///< "squareness_least_squares"
    double value_um_per_m = 0;
    std::optional<double> expanded_um_per_m; ///< U; absent: not evaluated
};

/// What a squareness test gave; `readings` and `figures` are those of the second axis alone.
struct SquarenessResult : AcrossRun {
    SquarenessFigures found;
    SquarenessBudget budget;
    /// First and second axis by this run, then both with the square in the other position.
    std::vector<SquareLine> lines;

    [[nodiscard]] const SquarenessSetup& setup() const;
    [[nodiscard]] const std::string& first_axis() const { return setup().first.axis; }
    [[nodiscard]] const std::string& second_axis() const { return run.statements.axis; }
};

/// Computes everything of a run file that was read; without its hash. Of a run that is open, or was
/// closed as incomplete, the partial result. Nothing is brought to 20 degC.
/// @errors Fault::bad_run_file naming `path` without a set-up, of a rotary axis, of optics that are
/// no Wollaston prism, with lines that are not of these two axes, or with limits that are lengths;
/// those of read_across_run(),
/// evaluate_squareness() and make_squareness_budget().
Result<SquarenessResult> squareness_result_of(const std::string& path, RunFileContents contents);

inline constexpr double um_per_m_of_rad = 1e6;
/// Seconds of arc in one micrometre for each metre: 648000 / pi / 1e6.
double arcsec_of_um_per_m(double um_per_m);

double squareness_against(const Squareness& squareness, LineReference reference); ///< rad

/// That of the least-squares lines first; it alone has a U.
std::vector<NamedSquareness> figures_of(const SquarenessResult& result);

/// How the error of the square was dealt with: "reversal" | "stated" | "not taken out".
std::string_view square_error_by(const SquarenessResult& result);

/// "Squareness of axis Y to axis X".
std::string squareness_title(const SquarenessResult& result);

/// "> 0 where the angle between +X and +Y is larger than 90 degrees".
std::string sign_of_squareness(const SquarenessResult& result);

} // namespace axiscal

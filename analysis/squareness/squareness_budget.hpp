#pragma once
// Uncertainty of a squareness (GUM, first order). Pure.
//
// No annex of ISO 230-1 gives a budget; distributions as in straightness_budget.hpp, all terms are
// derived here (status R). What does not count, and why: dead path, expansion and the laser's own
// uncertainty per length, as of a straightness; the offsets of both lines.

#include "analysis/quantity/result.hpp"
#include "analysis/record/squareness_setup.hpp"
#include "analysis/squareness/squareness_figures.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class SquarenessTerm : std::uint8_t {
    factor,      ///< of the displacement factor: of the slopes, that of both set-ups alike
    mirror,      ///< form of the bisecting mirror, in each slope
    square,      ///< of the square's error; 0 by reversal
    mount,       ///< what mirror and square turned between the two lines
    resolution,  ///< least step of a reading, in each slope
    environment, ///< E_VE, or the scatter of the readings where that is larger, in each slope
};
std::string_view name_of(SquarenessTerm term);

struct SquarenessContribution {
    SquarenessTerm term = SquarenessTerm::factor;
    double u_rad = 0; ///< of the squareness
    std::string formula;
};

struct SquarenessBudget {
    double coverage = 2;
    std::vector<SquarenessContribution> contributions;
    /// Present where every term is: with one left out, U would be too small. For the least-squares
    /// lines; by the other two references see SquarenessFigures::squareness.method_spread.
    std::optional<double> u_rad, expanded_rad; ///< U = 2 u
    std::vector<std::string> not_stated;       ///< names of terms
    bool by_scatter = false; ///< the environment term is the readings' own scatter
};

/// Of the least-squares slopes. With x the positions of a line, Q = sum (x - mean)^2, L its length,
/// N the readings in each mean, F the factor, w = 1 the weight of a line, by reversal 1/2 of each
/// of the four (a line of the first axis that stands in both positions of the square is one run,
/// and w = 1):
///   u_factor      = |sum of the apparent angle| u(F) / F: |apparent|, by reversal the mean of both
///   u_mirror      = sqrt(sum over the axes of (sum of w a L^2 sum |x - mean| / Q)^2) / sqrt 3: one
///                   mirror shows the same form to both lines of an axis, which reversal of the
///                   square does not part
///   u_square      = U / k or limit / sqrt 3; by reversal 0
///   u_mount       = limit / sqrt 3, by reversal / sqrt 2
///   u_resolution  = q / (2 sqrt 3) sqrt(sum of w^2 / Q)
///   u_environment = sqrt(sum of w^2 e^2 / (N Q)), e = max(E_VE / (2 sqrt 3), s of that line)
/// Accuracy: a few units in the last place.
/// @param readings_a_mean, scatter_um  of the mean line of this run
/// @errors Fault::bad_case with the field for what is negative or not finite, and for no readings.
Result<SquarenessBudget> make_squareness_budget(const SquarenessFigures& figures,
                                                const SquarenessSetup& setup,
                                                int readings_a_mean,
                                                double scatter_um);

} // namespace axiscal

#pragma once
// Straightness under random errors of its readings, by trials (JCGM 101): the check of the budget
// where the closed form is none. Pure: a seed gives the same bits on every CPU and compiler.

#include "analysis/quantity/result.hpp"
#include "analysis/straightness/straightness_figures.hpp"

#include <array>
#include <cstdint>

namespace axiscal {

/// Normal errors, drawn anew in each trial.
struct StraightnessErrors {
    double reading_u_um = 0; ///< of each mean by itself
    double step_u_um = 0;    ///< of each step by itself: base times angle; it shifts all behind it
};

struct TriedFigure {
    double mean_um = 0; ///< above the evaluated figure: extremes of noisy values lie further out
    double u_um = 0;    ///< standard deviation of the trials
};

struct TriedStraightness {
    int trials = 0;
    std::uint64_t seed = 0;
    std::array<TriedFigure, 3> by_reference; ///< in the order of LineReference
};

/// Adds the errors to the mean line and evaluates it anew. The budget's first order holds while the
/// same points stay the extremes: for errors far below the distance to the next point. For a line
/// as straight as its noise the figure is biased, and its u is smaller than the budget's. Sampling
/// error of u about u / sqrt(2 trials).
/// @param trials  1000 ... 1e6, rounded up to whole groups of eight
/// @errors Fault::bad_case "trials", "reading_u_um", "step_u_um"; those of straightness_of().
Result<TriedStraightness> try_straightness(const MeasuredLine& line,
                                           const StraightnessErrors& errors,
                                           int trials,
                                           std::uint64_t seed);

} // namespace axiscal

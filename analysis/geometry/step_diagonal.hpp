#pragma once
// The step-diagonal (vector) test: an estimation under stated assumptions. Pure.

#include "analysis/geometry/diagonals.hpp"

#include <array>
#include <string>
#include <vector>

namespace axiscal {

/// One body diagonal walked in n zig-zags: from the corner where every axis of sign +1 stands at 0
/// and every axis of sign -1 at its far end, axis by axis in `order`. Readings: deviation of the
/// displacement along the diagonal from its nominal value after each of the 3 n moves, zero at the
/// start.
struct StepDiagonalRun {
    std::array<int, 3> signs{};
    std::vector<double> deviations;
};

struct StepDiagonal {
    std::size_t steps = 0; ///< n; node i of an axis stands at i / n of its side
    /// error[direction][moving axis][node], zero at node 0, over + travel.
    std::array<std::array<std::vector<double>, 3>, 3> error;
    /// For each moving axis the part of the readings that no such error explains, largest over
    /// the steps: 0 where the assumptions hold, but 0 does not prove that they hold.
    std::array<double, 3> closure{};
    /// xy, xz, yz from the end points of the curves, > 0 where the angle opens.
    std::array<double, 3> squareness_rad{};
};

/// What the estimation takes for granted, sentence by sentence; belongs beside every result.
std::vector<std::string> step_diagonal_assumptions();

/// Step i of axis a moves the reflector by s_a (D e_a + d), d the error vector of that step; the
/// reading changes by its part along the diagonal. Four diagonals give four equations for the
/// three parts of d; their columns are orthogonal, the fourth combination is the closure.
/// Estimation only: an angle between beam and diagonal enters d at first order (Chapman 2003).
/// @errors Fault::bad_case: not the four body diagonals, not 3 n readings each, order no
/// permutation of the axes, box sides not positive, numbers not finite.
Result<StepDiagonal> evaluate_step_diagonal(const Box& box,
                                            const std::array<std::size_t, 3>& order,
                                            const std::vector<StepDiagonalRun>& runs);

} // namespace axiscal

#pragma once
// ISO 230-6: positioning along the body and face diagonals of a working volume, and the squareness
// values that their lengths give away. Pure; lengths in one unit.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/quantity/result.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Sides of the volume; index 0, 1, 2 is x, y, z.
using Box = std::array<double, 3>;

/// One diagonal: the direction in which each axis moves from the start point, -1, 0 or 1; the
/// targets are coordinates along it, 0 at its start corner, in a table of ISO 230-2.
struct DiagonalRun {
    std::array<int, 3> signs{};
    DeviationTable table;
};

struct DiagonalResult {
    std::array<int, 3> signs{};
    double length = 0;              ///< of the diagonal of the box
    PositioningResult positioning;  ///< zero at the start point: mean there is 0
    double slope_least_squares = 0; ///< of the means over the coordinate
    double slope_end_points = 0;    ///< (last - first mean) / (last - first target)
    double length_error = 0;        ///< slope_least_squares * length
};

/// Worst of the diagonals of one kind; R_d only with repetition, B_d only with both directions. A
/// test from one side counts by its E and R of that side.
struct DiagonalMachine {
    double E_d = 0;
    std::optional<double> B_d, R_d;
    double slope_spread = 0; ///< largest minus smallest least-squares slope
};

/// Squareness beta_ij > 0: the angle between the + directions of axes i and j is larger than 90
/// deg; rad.
struct DiagonalSquareness {
    std::map<std::string, double> squareness_rad; ///< "xy", "xz", "yz" as far as solvable
    /// sum e_i L_i^2 / sum L_i^2 over the axes of the diagonal: the one number that the lengths
    /// tell about the scales e_i.
    double common_scale = 0;
};

struct Diagonals {
    std::vector<DiagonalResult> diagonals;
    std::optional<DiagonalMachine> body, faces;
    std::optional<DiagonalSquareness> from_body;          ///< all four body diagonals
    std::map<std::string, DiagonalSquareness> from_faces; ///< "xy": both of that face
    std::map<std::string, std::string> not_evaluated;     ///< what, and why
};

/// E, B, R of each diagonal as ISO 230-2 on the diagonal coordinate, zero at its start point; the
/// machine's figures are the largest. Squareness by the linear model of a rigid, straight machine
/// (reconstructed from geometry), L_d the diagonal's length and s its signs:
///   dL = (sum e_i L_i^2 - sum_{i<j} s_i s_j beta_ij L_i L_j) / L_d
/// which four body diagonals determine for beta_xy, beta_xz, beta_yz and one common scale; terms of
/// second order (about dL * beta) are left out. A diagonal measured from its other end is the same.
/// @errors Fault::bad_case: box sides not positive, signs other than -1, 0, 1 or with two zeros, a
/// diagonal twice, targets outside 0..L_d (1 % beyond is allowed) or fewer than two, table errors
/// with "diagonals[i]." before the field.
Result<Diagonals> evaluate_diagonals(const Box& box, std::vector<DiagonalRun> runs);

/// Length of the diagonal of the axes that move.
double diagonal_length(const Box& box, const std::array<int, 3>& signs);

/// Signs up to the direction of travel: the first axis that moves moves forward.
std::array<int, 3> same_diagonal_forward(const std::array<int, 3>& signs);

} // namespace axiscal

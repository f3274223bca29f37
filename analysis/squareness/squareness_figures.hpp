#pragma once
// Squareness of two linear axes from two straightness runs, and the error of the optical square
// from two more (ISO 230-1:2012, squareness between two axes of linear motion). Pure.

#include "analysis/geometry/squareness.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/squareness_setup.hpp"
#include "analysis/straightness/straightness_figures.hpp"

#include <optional>

namespace axiscal {

/// What the two axes gave with the square in one position: the bidirectional mean lines, in the
/// order first axis, second axis; deviations in um, positive towards + of the other axis.
struct SquareLines {
    StraightnessLine first, second;
    /// The angle between the + directions minus 90 degrees as it seems, rad: -atan of both slopes,
    /// the error of the square still in it.
    Squareness apparent;
};

struct SquarenessFigures {
    SquareLines lines;                ///< of this run
    std::optional<SquareLines> other; ///< with the square in the other position
    /// Error of the square that was taken out, as in SquarePosition::normal, rad: by reversal from
    /// the least-squares lines, or as stated; 0 where neither.
    double square_error_rad = 0;
    bool by_reversal = false;
    /// > 0 where the angle between the + directions is larger than 90 degrees, rad; its
    /// method_spread is that of the three.
    Squareness squareness;
};

/// The mean line of a run that was kept: both directions' mean, or the one.
/// @errors those of straightness_of().
Result<StraightnessLine> line_of(const RecordedLine& recorded);

/// With a_i the slopes of both lines against one reference and e the error of the square (its angle
/// minus 90 degrees in the normal position, s = +1 there and -1 where it is turned):
///   apparent = -atan a_1 - atan a_2                    = S - s e
///   S        = apparent + s e                           with e as stated, or 0
///   S        = (apparent + apparent of the other position) / 2, by reversal
///   e        = half of their difference, turned minus normal
/// by each of the three references alike (derived here, status R). Accuracy: 1e-15 rad.
/// @param second  the mean line of this run
/// @errors those of straightness_of().
Result<SquarenessFigures> evaluate_squareness(const StraightnessLine& second,
                                              const SquarenessSetup& setup);

} // namespace axiscal

#pragma once
// Parts the form of the straightness optics from the motion of the axis by two runs. Pure.

#include "analysis/geometry/straightness.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/recorded_line.hpp"
#include "analysis/record/straightness_setup.hpp"
#include "analysis/straightness/straightness_figures.hpp"

namespace axiscal {

/// A straightness from which the form of the mirror was taken.
struct PartedStraightness {
    StraightnessFigures axis; ///< the motion; scatter pooled of both runs, R of `run` alone
    StraightnessLine mirror;  ///< what the mirror adds in its normal position
};

/// Two runs of one axis, the bisecting mirror turned by 180 degrees about the beam between them,
/// both positive towards the same direction of the machine: the motion counts in both alike, the
/// form of the mirror with both signs, so that half the sum of two means is the motion and half
/// their difference the mirror. The set-ups have slopes and offsets of their own: each run first
/// loses the least-squares line of its own bidirectional mean, which keeps what parts the
/// directions; no slope is left to be told. B_i is the mean of both runs' B_i. The reversal is
/// known from makers' manuals ("the mean of the two"); ISO 230-1 names reversal for straightedges.
/// What does not turn with the mirror (prism, air) is not parted. Accuracy: a few 1e-16 of the
/// largest deviation.
/// @param run       with the mirror in position `stood`
/// @param other     of the other position
/// @errors Fault::bad_case "targets" for other targets or directions than those of `run`; those of
/// straightness_of().
Result<PartedStraightness>
part_straightness(const StraightnessFigures& run, MirrorPosition stood, const RecordedLine& other);

} // namespace axiscal

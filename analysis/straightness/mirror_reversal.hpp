#pragma once
// Parts the form of the straightness optics from the motion of the axis by two runs. Pure.

#include "analysis/geometry/straightness.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/recorded_line.hpp"
#include "analysis/record/straightness_setup.hpp"
#include "analysis/straightness/straightness_figures.hpp"

namespace axiscal {

/// Deviations of both about their least-squares line, at the positions of the runs.
struct PartedOptics {
    MeasuredLine axis;   ///< the motion of the axis: (normal + reversed) / 2
    MeasuredLine mirror; ///< what the mirror adds in its normal position: (normal - reversed) / 2
};

/// Two mean lines of one axis, the bisecting mirror turned by 180 degrees about the beam between
/// them, both positive towards the same direction of the machine: the motion counts in both alike,
/// the form of the mirror with both signs. The set-ups have slopes and offsets of their own, so
/// each line loses its least-squares line first; no slope is left to be told. The reversal is known
/// from makers' manuals ("the mean of the two"); ISO 230-1 names reversal for straightedges. What
/// does not turn with the mirror (prism, air) is not parted. Accuracy: a few 1e-16 of the largest
/// deviation.
/// @errors Fault::bad_case "targets" when the positions are not the same; those of
/// straightness_of().
Result<PartedOptics> part_optics(const MeasuredLine& normal, const MeasuredLine& reversed);

/// A straightness from which the form of the mirror was taken.
struct PartedStraightness {
    StraightnessFigures axis; ///< the motion; scatter pooled of both runs, R of `run` alone
    StraightnessLine mirror;  ///< what the mirror adds in its normal position
};

/// As part_optics(), of every mean: each run loses the least-squares line of its own bidirectional
/// mean, which keeps what parts the directions; B_i is the mean of both runs' B_i.
/// @param run       with the mirror in position `stood`
/// @param other     of the other position
/// @errors Fault::bad_case "targets" for other targets or directions than those of `run`; those of
/// straightness_of().
Result<PartedStraightness>
part_straightness(const StraightnessFigures& run, MirrorPosition stood, const RecordedLine& other);

} // namespace axiscal

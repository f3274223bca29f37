#pragma once
// Evaluations of a deviation table beside ISO 230-2: VDI/DGQ 3441, ranges of raw readings, and the
// labelled styles of older standards. Pure.
//
// Common to all: x_ij deviation of approach j at target i (actual - target), up and down the two
// directions; xm means, s standard deviations (n - 1), B_i = xm_i up - xm_i down.

#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/positioning/standards.hpp"

#include <map>
#include <string>
#include <vector>

namespace axiscal {

struct NamedFigure {
    std::string name;
    double value = 0;
};
using NamedFigures = std::vector<NamedFigure>;

/// All figures in the unit of the table, in the order they are printed.
struct StyleResult {
    NamedFigures parameters;
    std::vector<NamedFigures> positions;              ///< one list a target, `target` first
    std::map<std::string, std::string> not_evaluated; ///< parameter -> why the data do not allow it
    std::vector<std::string> notes;                   ///< what a reader must know
};

/// By any standard that is not ISO 230-2 itself (is_iso() false).
StyleResult evaluate_style(PositioningFigures figures, const RunAt20C& run);

/// VDI/DGQ 3441 (1977; structure certain): x_i = (xm_i up + xm_i down) / 2, U_i = |B_i|,
/// s_i = (s_i up + s_i down) / 2, Ps_i = 6 s_i;
///   Pa = max x_i - min x_i, U_max, U_mean, Ps_max, Ps_mean,
///   P  = max(x_i + (U_i + Ps_i)/2) - min(x_i - (U_i + Ps_i)/2).
/// One direction alone gives none of them; n = 1 gives Pa, U_max, U_mean.
StyleResult evaluate_vdi_3441(const RunAt20C& run);

/// Ranges of raw readings ("primed" parameters; names certain):
///   R_raw_forward = max_i (max_j x_ij up - min_j x_ij up), R_raw_backward likewise,
///   R_raw = max_i of the range of both directions' readings at target i (reconstructed: it holds
///   the reversal, as R does), A_raw_forward = max_ij - min_ij up, A_raw_backward, A_raw over all.
/// n = 1: no R_raw of any kind.
StyleResult evaluate_raw_ranges(const RunAt20C& run);

/// "ASME B5.54-1992 style" (doubtful): the raw ranges, and B = max |B_i|, B_mean = mean B_i.
StyleResult evaluate_asme_b554_1992(const RunAt20C& run);

/// "NMTBA style" (doubtful). Every figure is a half width, plus or minus about zero deviation:
///   repeatability_forward = 3 max s_i up, repeatability_backward likewise,
///   repeatability = max(3 s_i + |B_i|/2), accuracy_forward = max(|xm_i up| + 3 s_i up), ...,
///   accuracy = max(|xm_i| + 3 s_i + |B_i|/2); s_i is the larger of both directions (our reading).
/// Without offset: the mean of all xm of both directions is taken from every xm first.
StyleResult evaluate_nmtba(const RunAt20C& run, bool with_offset);

/// "JIS B 6330 style" (from memory): positioning = range of the deviations of the first forward
/// pass; at the lowest, the middle and the highest target: repeatability_forward (and _backward) =
/// half of the largest range of its n readings (plus or minus; the standard asks n = 7, fewer are
/// told in `notes`), repeatability the larger; lost_motion = max |B_i| at these three.
/// The middle is the target nearest to half the stroke, the lower of two. Fewer than three targets:
/// positioning alone.
StyleResult evaluate_jis_b_6330(const RunAt20C& run);

} // namespace axiscal

#pragma once
// What is wrong when the first targets are not where the laser sees the axis: sign, axis, unit,
// optics, diameter programming, scale or datum. Pure.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"

#include <span>

namespace axiscal {

struct ClaimedTarget {
    Length target;   ///< coordinate as planned
    Length measured; ///< coordinate as seen: live_position()
};

/// One sentence with the numbers; where the evidence fits several causes it names each of them.
/// `claims`: one or two, the last one is the target that was missed. A cause fits when it explains
/// every claim to within max(50 um, 0.5 %) of the displacement it predicts. Of one claim a scale
/// without a known ratio is named only where its factor lies between 0.5 and 1.5.
/// @return Fault::wrong_direction for a turned sign, wrong_target when nothing moved,
/// outside_window for everything else.
Error diagnose_first_targets(Length datum, std::span<const ClaimedTarget> claims);

} // namespace axiscal

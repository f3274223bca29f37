#pragma once
// What a reading across the axis says: how far the motion is beside the straight line, and nothing
// of where the axis stands. Pure.

#include "acquisition/run/reading_rule.hpp"
#include "analysis/record/straightness_setup.hpp"

#include <memory>

namespace axiscal {

/// The place is the one that the CNC claims, and so is the side from which it was reached. A
/// deviation is counted from the datum, in air as if it were vacuum: too large by less than 0.03 %.
/// @param range  deviation that the optics follow, to either side
/// @errors of position_of: Fault::outside_window for a deviation beyond it, with the way out.
std::shared_ptr<const ReadingRule> across_the_axis(const StraightnessSetup& setup, Length range);

} // namespace axiscal

#pragma once
// The principal positions of a rotary axis, 0, 90, 180 and 270 degrees, among targets that are
// drawn (ISO 230-2:2014, 4.3.4). Pure. One millimetre stands for one degree.

#include "analysis/quantity/quantity.hpp"

#include <string>
#include <vector>

namespace axiscal {

[[nodiscard]] bool is_principal_position(Length coordinate);

/// Where a grid of interval p may begin so that most principal positions of [low, high] lie within
/// 0.3 p of one of its places; the lowest such begin. A place that is principal itself takes no
/// random part, so it may lie at the very end. At least `least_places` places must fit, where the
/// usual begin, low + 0.3 p, leaves room for them.
Length first_for_principal_positions(Length low, Length high, Length interval, int least_places);

/// The place nearest to a principal position of [low, high] takes it in place of its random part,
/// if it lies within 0.3 p of it. `targets` were drawn about first + i p.
void take_principal_positions(
    std::vector<Length>& targets, Length first, Length interval, Length low, Length high);

/// "90, 270": those of [low, high] that are no targets, be it a turn further; empty: none.
std::string
missing_principal_positions(const std::vector<Length>& targets, Length low, Length high);

} // namespace axiscal

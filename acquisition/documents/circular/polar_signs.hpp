#pragma once
// The signs that a polar plot and its legend have in common.

#include "acquisition/documents/circular/polar_view.hpp"
#include "acquisition/documents/pdf/page.hpp"

namespace axiscal {

inline constexpr Colour zone_tint{0.55, 0.55, 0.2};
inline constexpr double zone_opacity = 0.16;

/// Blue counter-clockwise, vermilion clockwise.
Colour colour_of(Sense sense);
/// Of a control point: filled outer, open inner.
void draw_mark_sign(Canvas& canvas, PagePoint at, ZoneSide side);
void draw_cross(Canvas& canvas, PagePoint at, double size, Stroke stroke);

} // namespace axiscal

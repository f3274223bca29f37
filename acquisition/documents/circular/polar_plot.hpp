#pragma once
// The polar plot of a circle. It stays inside its box, labels included. Pure drawing.

#include "acquisition/documents/circular/polar_view.hpp"
#include "acquisition/documents/pdf/page.hpp"

namespace axiscal {

/// Where a view lies on the page.
struct PolarPlace {
    PagePoint centre;
    PolarScale scale;
    double base_mm = 0;
    [[nodiscard]] PagePoint at(const PolarPoint& point) const;
};

/// The largest plot that fits into the box beside the names of the axes. Pure but for the font.
PolarPlace polar_place(Canvas& canvas, PageBox box, const PolarView& view);

/// First axis to the right, second up. Rings a division apart, the heavy one is the nominal circle
/// (PolarView::base_mm); the zone tinted between its two circles; counter-clockwise solid blue,
/// clockwise dashed vermilion; control points numbered, outer filled, inner open; the least squares
/// centre a cross; at the rim of each trace a dot at its start, an arrow in its sense, a bar at its
/// end, thin the overshoot (30 deg of it at most).
void draw_polar_plot(Canvas& canvas, PageBox box, const PolarView& view);

/// What the signs mean and the magnification, below the plot's box and as wide. @returns its height
double draw_polar_legend(Canvas& canvas, PageBox box, const PolarView& view);

} // namespace axiscal

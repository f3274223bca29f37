#pragma once
// A straightness test as it is drawn. What is drawn stays inside its box, labels included. Pure.

#include "acquisition/documents/pdf/page.hpp"
#include "acquisition/documents/straightness/straightness_document.hpp"

namespace axiscal {

/// Deviation across the axis against target: means of each direction as measured, with the slope of
/// the set-up, and the three reference lines of the mean.
void draw_straightness_plot(Canvas& canvas, PageBox box, const StraightnessResult& result);

/// The same about the main reference line; the two extremes of the mean carried to the right, where
/// their distance is the straightness error.
void draw_straightness_residuals(Canvas& canvas, PageBox box, const StraightnessResult& result);

} // namespace axiscal

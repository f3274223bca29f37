#pragma once
// The pages of a straightness certificate, in the order in which they are bound; the last are those
// of across_pages.hpp.

#include "acquisition/documents/straightness/across_pages.hpp"
#include "acquisition/documents/straightness/straightness_document.hpp"

#include <vector>

namespace axiscal {

/// Page 1: who, what, with what, the figure with the other two references, the plots, the
/// signatures.
/// @returns stated fields that did not fit and must be printed in full by the condition pages.
std::vector<StatedField> draw_straightness_front_page(Sheet& sheet,
                                                      const StraightnessResult& result);

/// Every figure, means and residuals by target, every deviation.
void draw_straightness_targets(Sheet& sheet, const StraightnessResult& result);

/// Limits, the budget against each reference, the slopes of the lines.
void draw_straightness_uncertainty(Sheet& sheet, const StraightnessResult& result);

} // namespace axiscal

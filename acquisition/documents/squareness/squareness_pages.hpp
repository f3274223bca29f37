#pragma once
// The pages of a squareness certificate, in the order in which they are bound; the last are those
// of across_pages.hpp.

#include "acquisition/documents/squareness/squareness_document.hpp"
#include "acquisition/documents/straightness/across_pages.hpp"

#include <vector>

namespace axiscal {

/// Page 1: who, what, with what, the figure in um/m and seconds of arc, both lines, the signatures.
/// @returns stated fields that did not fit and must be printed in full by the condition pages.
std::vector<StatedField> draw_squareness_front_page(Sheet& sheet, const SquarenessResult& result);

/// Every figure, slopes and means of every line, every deviation of this run.
void draw_squareness_targets(Sheet& sheet, const SquarenessResult& result);

/// Limits and the budget.
void draw_squareness_uncertainty(Sheet& sheet, const SquarenessResult& result);

/// How the square stood and what is stated of it.
std::vector<StatedField> fields_of_square(const SquarenessResult& result);

} // namespace axiscal

#pragma once
// A squareness test as it is drawn. What is drawn stays inside its box, labels included. Pure.

#include "acquisition/documents/pdf/page.hpp"
#include "acquisition/documents/squareness/squareness_document.hpp"

namespace axiscal {

/// The lines of both axes by this run, one above the other: means about their own mean, and the
/// least-squares line, whose slopes the squareness is made of. Both as high as the steeper one, so
/// that slopes can be compared.
void draw_squareness_plot(Canvas& canvas, PageBox box, const SquarenessResult& result);

} // namespace axiscal

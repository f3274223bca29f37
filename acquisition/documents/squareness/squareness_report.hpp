#pragma once
// The certificate of a squareness test as PDF. Only the short-lived report process links this.

#include "acquisition/documents/squareness/squareness_document.hpp"

#include <string>

namespace axiscal {

/// The bytes of certificate.pdf: A4, page n of m, DejaVu Sans embedded. The same test gives the
/// same bytes: the creation date is that of its record. Not thread-safe (Pango's font map).
/// @errors Fault::not_found without the font; Fault::refused naming a text that the font cannot
/// print; Fault::io from Cairo.
Result<std::string> render_squareness_pdf(const SquarenessResult& result);

} // namespace axiscal

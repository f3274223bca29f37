#pragma once
// The report of a drift test as PDF. Only the short-lived report process links this.

#include "acquisition/documents/drift/drift_document.hpp"

#include <string>

namespace axiscal {

/// The bytes of certificate.pdf: A4, page n of m, DejaVu Sans embedded. The same test gives the
/// same bytes: the creation date is its end. Not thread-safe (Pango's font map).
/// @errors Fault::not_found without the font; Fault::refused naming a text that the font cannot
/// print; Fault::io from Cairo.
Result<std::string> render_drift_pdf(const DriftResult& document);

} // namespace axiscal

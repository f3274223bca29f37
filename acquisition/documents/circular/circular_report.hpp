#pragma once
// The certificate of a circular test as PDF. Only the short-lived report process links this.

#include "analysis/circular/circular_certificate.hpp"

#include <string>

namespace axiscal {

/// The bytes of certificate.pdf: A4, page n of m, DejaVu Sans embedded. The same certificate gives
/// the same bytes: the creation date is the end of the run, or the date that a case states; of a
/// case without one the document has none. Not thread-safe (Pango's font map).
/// @errors Fault::not_found without the font; Fault::refused naming a text that the font cannot
/// print; Fault::io from Cairo.
Result<std::string> render_circular_pdf(const CircularCertificate& certificate);

} // namespace axiscal

#pragma once
// The certificate as PDF. Only the short-lived report process links this: the daemon draws nothing.

#include "analysis/positioning/positioning_certificate.hpp"

#include <string>

namespace axiscal {

/// The bytes of certificate.pdf: A4, page n of m, DejaVu Sans embedded. The same certificate gives
/// the same bytes: the creation date is the end of the run. Not thread-safe (Pango's font map).
/// @errors Fault::not_found without the font; Fault::refused naming a text that the font cannot
/// print; Fault::bad_case without targets; Fault::io from Cairo.
Result<std::string> render_certificate_pdf(const Certificate& certificate);

} // namespace axiscal

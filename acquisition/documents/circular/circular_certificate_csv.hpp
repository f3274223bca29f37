#pragma once
// certificate.csv of a circular test: figures in comment lines, then every reading. Pure.

#include "analysis/circular/circular_certificate.hpp"

#include <string>

namespace axiscal {

/// Lines end in CR LF. Head and figures stand in lines that begin with "# "; then one line a
/// reading: sense, its number in the trace from 1, nominal angle, deviation as read from the
/// set-up centre, radius about the centre of the sense's own minimum zone minus the nominal one,
/// and "outer" or "inner" for a control point of that zone.
std::string circular_certificate_csv(const CircularCertificate& certificate);

} // namespace axiscal

#pragma once
// The certificate of a circular case: what `axiscal export CASE.json` draws.

#include "analysis/circular/circular_certificate.hpp"

#include <string>

namespace axiscal {

/// Reads and evaluates the case. Its name, which becomes a folder's, is the case's "id", else the
/// file's name; letters, digits, . _ - are kept, all else becomes '-'.
/// @errors Fault::io; Fault::bad_case with field for what is no circular case: other analyses, and
/// arrays of cases, have no certificate.
Result<CircularCertificate> circular_certificate_of_case(const std::string& case_file);

} // namespace axiscal

#pragma once
// A run file of imported readings, and its certificate.

#include "tools/axiscal/imports/import_file.hpp"

#include <string>

namespace axiscal {

/// Writes FOLDER/<run-id>.axiscal and, by axiscal-report, FOLDER/<run-id>/ with the certificate.
/// @returns an exit code; what is wrong is told on standard error. A run file that is there is
/// never overwritten.
int certify_import(const ImportedFile& file,
                   ImportedReadings from,
                   const std::string& folder,
                   bool json);

} // namespace axiscal

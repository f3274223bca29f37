#pragma once
// From the result of a test to the files that leave the station.

#include "acquisition/documents/test_result.hpp"

#include <string>

namespace axiscal {

/// Names inside the folder of a certificate; the run file keeps its own name.
inline constexpr const char* certificate_json_name = "certificate.json";
inline constexpr const char* certificate_csv_name = "certificate.csv";
inline constexpr const char* certificate_pdf_name = "certificate.pdf";

/// Writes certificate.json, .csv, .pdf and a copy of the run file or the case, whose SHA-256 must
/// be that of the result, into an existing folder. Each is synced; the folder is the caller's to
/// sync. The .csv of a drift test holds every reading, that of a probing test every touch.
/// @errors Fault::io; Fault::refused when the file changed meanwhile; those of drawing.
Result<void> write_certificate_files(const TestResult& result,
                                     const std::string& source_file,
                                     const std::string& folder);

} // namespace axiscal

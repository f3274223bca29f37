#pragma once
// From a closed run file to the files that leave the station.

#include "acquisition/documents/drift/drift_document.hpp"
#include "acquisition/documents/probing/probing_document.hpp"
#include "analysis/circular/circular_certificate.hpp"
#include "analysis/positioning/positioning_certificate.hpp"

#include <string>

namespace axiscal {

/// Names inside the folder of a certificate; the run file keeps its own name.
inline constexpr const char* certificate_json_name = "certificate.json";
inline constexpr const char* certificate_csv_name = "certificate.csv";
inline constexpr const char* certificate_pdf_name = "certificate.pdf";

/// Writes certificate.json, .csv, .pdf and a copy of the run file, whose SHA-256 must be the
/// certificate's, into an existing folder. Each is synced; the folder is the caller's to sync.
/// @errors Fault::io; Fault::refused when the run file changed meanwhile; render_certificate_pdf().
Result<void> write_certificate_files(const Certificate& certificate,
                                     const std::string& run_file,
                                     const std::string& folder);

/// The same of a circular test; `source_file` is the run file or the case.
/// @errors Fault::io; Fault::refused when the file changed meanwhile; render_circular_pdf().
Result<void> write_circular_files(const CircularCertificate& certificate,
                                  const std::string& source_file,
                                  const std::string& folder);
/// The same of a drift test; its .csv holds every reading.
/// @errors Fault::io; Fault::refused when the run file changed meanwhile; render_drift_pdf().
Result<void> write_drift_files(const DriftDocument& document,
                               const std::string& run_file,
                               const std::string& folder);
/// The same of a probing test; its .csv holds every touch.
/// @errors Fault::io; Fault::refused when the run file changed meanwhile; render_probing_pdf().
Result<void> write_probing_files(const ProbingDocument& document,
                                 const std::string& run_file,
                                 const std::string& folder);

} // namespace axiscal

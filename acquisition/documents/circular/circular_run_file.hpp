#pragma once
// From a run file to everything that it says of a circular test: the one road, for the certificate
// and for next year's recomputation.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/circular/circular_certificate.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// Cuts the circles of a run file that was read. Temperatures are means over the time from the
/// first evaluated circle to the last.
/// @errors Fault::refused for a run that is no circular test; Fault::incomplete_run as cut_circles.
Result<CircularRun> circular_run_of(const RunFileContents& contents);

/// With the digest of its figures, and without what the paper adds: number, hash of the file.
/// @errors Fault::incomplete_run naming `path` for an open run; those of circular_run_of() and
/// evaluate_measurement().
Result<CircularCertificate> circular_certificate_of(const std::string& path,
                                                    const RunFileContents& contents);

/// What is stored at the first evaluation.
nlohmann::ordered_json circular_figures(const CircularCertificate& certificate);

} // namespace axiscal

#pragma once
// From a closed run file to its certificate: the one road, for the daemon's report, for export and
// for next year's recomputation.

#include "analysis/certificate.hpp"

#include <string>

namespace axiscal {

/// Reads and verifies the run file and computes everything. Figures that differ in any bit from
/// the digest stored when the run was first evaluated are refused.
/// @errors Fault::incomplete_run for an open or incomplete run; Fault::bad_run_file,
/// Fault::not_found; what make_certificate() refuses.
Result<Certificate> certificate_of_run_file(const std::string& run_file);

/// The first evaluation: stores digest and result document in the closed run file, once.
/// A file that has a result keeps it.
Result<void> seal_result(const std::string& run_file);

} // namespace axiscal

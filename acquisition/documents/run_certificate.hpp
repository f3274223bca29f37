#pragma once
// From a closed run file to its certificate: the one road, for the daemon's report, for export and
// for next year's recomputation.

#include "acquisition/runfile/ed25519.hpp"
#include "analysis/positioning/positioning_certificate.hpp"
#include "analysis/circular/circular_certificate.hpp"

#include <string>

namespace axiscal {

/// What the station adds to a result when it first evaluates a run.
struct Issue {
    const SecretKey* key = nullptr; ///< signs it; null: nobody
    std::string state_directory;    ///< where numbers are kept; empty: the paper gets none
};

/// Reads and verifies the run file and computes everything. Figures that do not agree
/// (agreement_of) with those stored when the run was first evaluated are refused. Of a run that is
/// open, or was closed as incomplete, it is the partial result.
/// @errors Fault::refused for a drift or probing test; Fault::bad_run_file, Fault::not_found; what
/// make_certificate() refuses.
Result<Certificate> certificate_of_run_file(const std::string& run_file);

/// The same of a circular test: its circles are cut out of the stream anew.
/// @errors as above; those of read_run_file_contents(), circular_run_of() and evaluate_measurement().
Result<CircularCertificate> circular_certificate_of_run_file(const std::string& run_file);

/// The first evaluation: stores digest and result document in the closed run file, once.
/// A file that has a result keeps it. Of a circular test, too. The paper that is made of it gets its
/// number now, once.
/// @errors Fault::incomplete_run for a run that is open or was not closed as complete.
Result<void> seal_result(const std::string& run_file, const Issue& issue = {});

} // namespace axiscal

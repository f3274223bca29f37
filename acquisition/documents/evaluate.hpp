#pragma once
// From a run file to its result: the one road, for the station's own report, for `export`,
// `analyze` and `verify`, and for next year's recomputation.

#include "acquisition/documents/test_result.hpp"
#include "acquisition/runfile/ed25519.hpp"

#include <string>

namespace axiscal {

/// What the station adds to a result when it first evaluates a run.
struct Issue {
    const SecretKey* key = nullptr; ///< signs it; null: nobody
    std::string state_directory;    ///< where numbers are kept; empty: the paper gets none
};

/// Reads and verifies the run file once and computes everything once. Figures that do not agree
/// (agreement_of) with those that the file keeps of its first evaluation are refused. Of a
/// positioning test that is open, or was closed as incomplete, it is the partial result.
/// @param issue  stores digest and figures in a closed run file that keeps none since it was last
///               closed; the paper then gets its number. Null: the file is not touched.
/// @errors Fault::bad_run_file, Fault::not_found, Fault::incomplete_run; those of the kind's own
///         evaluation; with `issue` those of store_result() and take_certificate_number().
Result<TestResult> evaluate_run_file(const std::string& path, const Issue* issue = nullptr);

} // namespace axiscal

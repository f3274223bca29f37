#pragma once
// Earlier runs that a run is evaluated with. Blocking calls.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/record/test_kind.hpp"

#include <string>

namespace axiscal {

/// Which complete run is meant.
struct WantedRun {
    TestKind kind = TestKind::straightness;
    std::string which; ///< a run id, or "latest": the newest one
    std::string axis;  ///< as the run states it: "X"
    std::string key;   ///< that names it, for the refusal: "straightness.reversal_of"
};

/// Read and verified as read_run_file_contents().
/// @errors Fault::not_found, with the way out; Fault::bad_run_file.
Result<RunFileContents> find_complete_run(const std::string& folder, const WantedRun& wanted);

} // namespace axiscal

#pragma once
// From a run file to everything that it says of a circular test: the one road, for the certificate
// and for next year's recomputation.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/circular/circular_run.hpp"

#include <string>

namespace axiscal {

/// Cuts the circles of a run file that was read. Temperatures are means over the time from the
/// first evaluated circle to the last.
/// @errors Fault::refused for a run that is no circular test; Fault::incomplete_run as cut_circles.
Result<CircularRun> circular_run_of(const RunFileContents& contents);

} // namespace axiscal

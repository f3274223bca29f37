#pragma once
// What was measured before the run that is armed now: the line of the other axis, and the two lines
// with the square in the other position. Pure.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/recorded_line.hpp"
#include "analysis/record/squareness_setup.hpp"

#include <string>

namespace axiscal {

/// @param run    a complete straightness run of the axis `setup.optics.across`
/// @param setup  as this run is armed; its lines do not count yet
/// @param axis   letter of this axis
/// @errors Fault::bad_request with the way out where the run was measured in another direction, by
/// another method or factor, or with the mirror in the other position; Fault::bad_run_file without
/// a set-up; those of recorded_line_of().
Result<RecordedLine>
first_line_of(const RunFileContents& run, const SquarenessSetup& setup, const std::string& axis);

/// @param run  a complete squareness run of this axis
/// @errors Fault::bad_request with the way out where the other axis, the method or the factor is
/// another one, or the square stands alike; else as first_line_of().
Result<OtherSquare> other_square_of(const RunFileContents& run, const SquarenessSetup& setup);

} // namespace axiscal

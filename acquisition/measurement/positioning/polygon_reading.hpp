#pragma once
// A rotary axis before an autocollimator. Where the station file names it, a face is captured like
// any reading, in a still window; else a person reads the polygon's faces and types what is seen,
// and nothing proves that the axis stood still. From where it came neither shows; the points are
// those of the program's requests, or marked manual. Pure.

#include "acquisition/capture/capture.hpp"
#include "acquisition/capture/stillness.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"
#include "config/station_config.hpp"
#include "drivers/sample.hpp"

namespace axiscal {

/// One reading that a person typed, at one instant; a millimetre stands for a degree.
Capture typed_capture(double seconds_of_arc, MonotonicTime now);

/// What an autocollimator shows, as the history keeps it: a millimetre for a degree. It counts
/// nothing: neither without light nor by a line that was opened anew is a zero lost.
Sample in_degrees(const Sample& shown);

/// Why no still window was found in time, in seconds of arc.
Error no_still_face(const StillnessVerdict& seen, const CaptureConfig& limits);

} // namespace axiscal

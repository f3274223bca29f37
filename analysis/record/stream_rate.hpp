#pragma once
// How often a channel was sampled, for people. Pure.

#include "analysis/record/stream_record.hpp"

namespace axiscal {

/// `periods` in `span`, rounded to three digits: a nominal rate, not a calibration of the
/// instrument's clock. 0 (not known) unless both are positive.
double nominal_rate_hz(double periods, Duration span);

/// Of a recorded stream, samples that its numbering left out counted in; where a hole's samples
/// were not numbered it is too low by them. 0 below two samples.
double nominal_rate_hz(const StreamSamples& stream);

} // namespace axiscal

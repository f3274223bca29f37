#pragma once
// The table of a channel's certificate, applied to one value. Pure.

#include "analysis/record/run_record.hpp"

#include <optional>
#include <span>
#include <string>

namespace axiscal {

/// What is to be added to `reading`: straight lines between the points of the certificate. Beyond
/// the first and the last point that point's correction holds. 0 without points.
/// @param points  by reading, ascending, no reading twice
double correction_at(std::span<const CorrectionPoint> points, double reading);

/// True where the certificate says nothing: before the first or after the last of its points.
bool beyond_certificate(std::span<const CorrectionPoint> points, double reading);

/// The same for a value that bears its correction already, as a run file holds it.
bool beyond_corrected(std::span<const CorrectionPoint> points, double corrected);

/// The calibration of one channel of a run; null when its station file stated none.
const ChannelCalibration* calibration_of(const RunRecord& run, int channel);

} // namespace axiscal

#include "analysis/record/channel_correction.hpp"

#include <algorithm>

namespace axiscal {

double correction_at(std::span<const CorrectionPoint> points, double reading) {
    if (points.empty()) return 0;
    const auto right = std::ranges::lower_bound(points, reading, {}, &CorrectionPoint::reading);
    if (right == points.begin()) return points.front().correction;
    if (right == points.end()) return points.back().correction;
    const CorrectionPoint& left = *(right - 1);
    const double share = (reading - left.reading) / (right->reading - left.reading);
    return left.correction + share * (right->correction - left.correction);
}

bool beyond_certificate(std::span<const CorrectionPoint> points, double reading) {
    return !points.empty() && (reading < points.front().reading || reading > points.back().reading);
}

bool beyond_corrected(std::span<const CorrectionPoint> points, double corrected) {
    constexpr double rounding = 1e-9; // of a sum, in any stored unit
    if (points.empty()) return false;
    const CorrectionPoint &first = points.front(), &last = points.back();
    return corrected < first.reading + first.correction - rounding ||
           corrected > last.reading + last.correction + rounding;
}

const ChannelCalibration* calibration_of(const RunRecord& run, int channel) {
    const auto found = std::ranges::find(run.calibrations, channel, &ChannelCalibration::channel);
    return found == run.calibrations.end() ? nullptr : &*found;
}

} // namespace axiscal

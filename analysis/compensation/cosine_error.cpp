#include "analysis/compensation/cosine_error.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {

std::optional<CosineError> cosine_error_by_reading(const AlignmentRecord& alignment) {
    if (!alignment.far || !(alignment.far->distance > Length{})) return std::nullopt;
    const FarRest& far = *alignment.far;
    CosineError found;
    found.distance = far.distance;
    found.error = std::max(far.highest - far.last, Length{});
    if (far.passed_maximum) found.bound = found.error + far.scatter;
    const double share = std::min(found.error / (far.distance * 2), 1.0);
    found.angle = radian(2 * std::asin(std::sqrt(share)));
    return found;
}

std::optional<CosineError> cosine_error_by_spot(const AlignmentRecord& alignment) {
    const Length distance = alignment.reached;
    if (!alignment.spot_offset || !(distance > Length{})) return std::nullopt;
    const Length walk = abs(*alignment.spot_offset);
    const double angle = std::atan(walk / (distance * 2));
    const double half = std::sin(angle / 2); // 1 - cos = 2 sin^2 of the half: no digits are lost
    CosineError found;
    found.distance = distance;
    found.error = distance * (2 * half * half);
    found.bound = walk * (walk / (distance * 8));
    found.angle = radian(angle);
    return found;
}

} // namespace axiscal

#include "analysis/probing/probing_case.hpp"

#include <cmath>

namespace axiscal {

ProbingDelayCase case_of(const ProbingRecord& record) {
    ProbingDelayCase stated;
    stated.feed_mm_per_min = record.feed_mm_per_min;
    const ProbingTouch* before = nullptr;
    for (const ProbingTouch& touch : record.touches) {
        const bool same =
            before && before->direction == touch.direction && before->reference == touch.reference;
        before = &touch;
        if (!same) {
            ProbingSeries& series = stated.series.emplace_back();
            series.direction = touch.direction;
            series.reference = touch.reference;
        }
        double along_mm = 0, square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            along_mm += touch.direction[axis] * touch.latched[axis].in(mm);
            square += touch.direction[axis] * touch.direction[axis];
        }
        stated.series.back().approach_mm.push_back(touch.approach.in(mm));
        stated.series.back().trigger_mm.push_back(square > 0 ? along_mm / std::sqrt(square) : 0);
    }
    return stated;
}

} // namespace axiscal

#pragma once
// How far the compensation is from what was put into a simulated run.

#include "analysis/compensation/thermal_compensation.hpp"
#include "analysis/record/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace axiscal::test {

/// Largest |found - true| deviation over all points of `run`, in mm; `truth` tells the true ones.
template <typename Truth> double largest_error_mm(const RunRecord& run, const Truth& truth) {
    const auto found = compensate_to_20C(run);
    if (!found) return 1e9;
    double largest = 0;
    for (const PlannedPoint& point : run.plan.points) {
        const auto target = static_cast<std::size_t>(point.target_index);
        const auto& rows = point.direction == Direction::positive ? found->deviations.forward()
                                                                  : found->deviations.backward();
        const double expected = truth.deviation_mm(point, run.plan.targets[target].in(mm));
        const double error = rows[target][static_cast<std::size_t>(point.approach)] - expected;
        largest = std::max(largest, std::fabs(error));
    }
    return largest;
}

} // namespace axiscal::test

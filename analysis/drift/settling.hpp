#pragma once
// When a sensor has settled, and how fast it changes: soak detection and the gradient rule. Pure.

#include "analysis/drift/drift.hpp"

#include <optional>
#include <vector>

namespace axiscal {

/// Least-squares slopes over the windows of a series: one for each sample that has a whole window
/// behind it, over the samples within (time - window, time], both ends included as in
/// largest_window_range. O(n); the moments are merged, never subtracted, so that a slope does not
/// lose digits with the length of the record. Windows with fewer than two samples give none.
struct WindowSlope {
    std::size_t first = 0, last = 0; ///< samples of the window
    double slope = 0;                ///< reading per time
};
std::vector<WindowSlope> window_slopes(const DriftSeries& series, double window);

/// The window with the largest |slope|; empty without any whole window.
std::optional<WindowSlope> steepest_window(const DriftSeries& series, double window);

struct SettlingRule {
    std::optional<double> band;  ///< full width in which all later readings must lie
    std::optional<double> slope; ///< limit of |slope| of every later window
    double window = 0; ///< of the slopes; also the least time that the sensor must have stayed
};

/// Index of the sample from which on the rule holds to the end of the record, and has held for at
/// least one window; empty when it never does. The first sample that fulfils both conditions:
/// a slope counts from the first sample of its window.
std::optional<std::size_t> settled_from(const DriftSeries& series, const SettlingRule& rule);

} // namespace axiscal

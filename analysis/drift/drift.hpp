#pragma once
// Drift of a resting axis: environmental variation E_VE, and thermal distortion in the sense of
// ISO 230-3 as ranges over a shift of time. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace axiscal {

/// Readings of one sensor over time; times rise strictly, unit and time unit are the caller's.
struct DriftSeries {
    std::vector<double> times, readings;
};

/// Largest minus smallest reading of the samples first..last (indices into the series).
struct DriftRange {
    double range = 0;
    std::size_t first = 0, last = 0; ///< span of the window's samples
    double u_eve = 0;                ///< range / (2 sqrt 3): the range as full width of a rectangle
};

/// E_VE: the range over the whole record.
DriftRange total_range(const DriftSeries& series);

/// Largest range of the samples within any window of the given length, both ends included: exact
/// over the samples, O(n). Times that differ by the window's length up to 8 roundings of the
/// largest time count as inside, so that 0.1-steps are not lost to binary fractions. The earliest
/// of equal windows is given.
DriftRange largest_window_range(const DriftSeries& series, double window);

/// Slope of the least-squares line through all samples, reading per time; empty with fewer than
/// two. Sums are taken about the means, so that no digits go with a far origin.
std::optional<double> least_squares_slope(const DriftSeries& series);

/// Reading against the first one at a time: linear between the samples beside it. Empty outside
/// the record.
std::optional<double> change_at(const DriftSeries& series, double time);

/// Shape and content of a series: at least `fewest` samples of equal count, times rising.
/// @errors Fault::bad_case, fields `name`.time and `name`.readings
Result<void> check_series(const DriftSeries& series, const std::string& name, std::size_t fewest);

/// (d1 - d2) / l at every sample: the tilt between two sensors that lie l apart, in rad where d
/// and l share a unit.
/// @errors Fault::bad_case where the two have not the same times, or l is not positive.
Result<DriftSeries>
tilt_between(const DriftSeries& first, const DriftSeries& second, double distance);

} // namespace axiscal

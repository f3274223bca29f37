#pragma once
// The line under a cloud whose scatter has one side. Pure.

#include <deque>

namespace axiscal {

/// An arrival: the instrument's time, and how much later than that this computer read it.
struct ClockPoint {
    double device_s = 0, delay_s = 0;
    bool operator==(const ClockPoint&) const = default;
};

struct ClockLine {
    double delay_s = 0; ///< at device_s = 0
    double slope = 0;
    [[nodiscard]] double at(double device_s) const { return delay_s + slope * device_s; }
};

/// The line below all points with the least sum of distances: the edge of their lower convex hull
/// over the mean of their times. Its slope is at most `steepest`; then the line touches one point.
/// Exact; O(points). @pre at least one point, device_s rising
ClockLine line_below(const std::deque<ClockPoint>& points, double steepest);

/// How far the line may be off, from the least distance of the points in each fifth of their span:
/// 0 in all of them is a line on the floor all along. Root mean square; s.
double misfit_of(const ClockLine& line, const std::deque<ClockPoint>& points);

/// What a delay that wraps at `grain_s` shows above the line. Between two teeth it goes through all
/// of the grain; a host that stood still jumps over it.
struct SawTeeth {
    int begun = 0;       ///< that came down to the line
    int whole = 0;       ///< of these, not cut off by the window
    double misfit_s = 0; ///< root mean square of the least distances of the whole ones
};
SawTeeth teeth_on(const ClockLine& line, const std::deque<ClockPoint>& points, double grain_s);

} // namespace axiscal

#pragma once
// The command of two axes in time: straight ways and arcs with a trapezoid of speed along the path.
// Thread-safe.

#include "cnc/commanded_axis.hpp"

#include <array>

namespace axiscal::simulate {

using PlanePoint = std::array<double, 2>; ///< first and second axis, mm

/// One way in the plane of two axes.
struct PlaneMove {
    PlanePoint to{};
    bool arc = false, ccw = true;
    PlanePoint
        centre_offset{}; ///< of an arc: from its begin to its centre; end = begin: whole turn
    double feed_mm_per_min = 0;
    int turns = 1; ///< of an arc, the last one perhaps in part
};

class CommandedPlane {
public:
    CommandedPlane(PlanePoint start, double acceleration_mm_per_s2);
    /// Starts a way at this time, or where it has been shown; earlier ones have ended. It comes to
    /// rest at its end.
    /// @returns its end, seconds.
    double move(double now_s, const PlaneMove& way);
    [[nodiscard]] PlanePoint position(double seconds) const;
    [[nodiscard]] ShownPath shown() const;

private:
    struct Way {
        TrapezoidMove along; ///< path from 0 to its length
        PlanePoint from{}, to{}, centre{};
        double radius = 0, angle = 0, turned = 0; ///< of an arc; radius 0: straight
        [[nodiscard]] PlanePoint at(double path_mm) const;
    };
    [[nodiscard]] PlanePoint locked_position(double seconds) const;

    mutable std::mutex mutex_;
    mutable ShownPath shown_;
    std::deque<Way> ways_; ///< the latest, so that a late sampler still finds its past
    PlanePoint start_;
    double acceleration_mm_per_s2_;
};

} // namespace axiscal::simulate

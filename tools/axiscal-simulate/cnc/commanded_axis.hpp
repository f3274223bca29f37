#pragma once
// The drive's command in time: straight moves with a trapezoid of speed. Thread-safe.

#include <deque>
#include <mutex>

namespace axiscal::simulate {

/// One move: accelerate, run at feed, brake; a triangle where the way is too short. Pure.
struct TrapezoidMove {
    double start_s = 0, from_mm = 0, to_mm = 0, speed_mm_per_s = 1, acceleration_mm_per_s2 = 1;
    [[nodiscard]] double duration_s() const;
    [[nodiscard]] double position_mm(double seconds) const; ///< held before and after
};

class CommandedAxis {
public:
    CommandedAxis(double start_mm, double acceleration_mm_per_s2);
    /// Starts a move at this time; earlier moves have ended. @returns its end, seconds.
    double move(double now_s, double to_mm, double speed_mm_per_s);
    /// Stands still from now on, where the drive is now.
    void halt(double now_s);
    [[nodiscard]] double position_mm(double seconds) const;

private:
    [[nodiscard]] double locked_position_mm(double seconds) const;
    mutable std::mutex mutex_;
    std::deque<TrapezoidMove> moves_; ///< the latest, so that a late sampler still finds its past
    double start_mm_, acceleration_mm_per_s2_;
};

} // namespace axiscal::simulate

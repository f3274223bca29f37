#pragma once
// The drive's command in time: straight moves with a trapezoid of speed. Thread-safe.

#include <algorithm>
#include <deque>
#include <limits>
#include <mutex>

namespace axiscal::simulate {

/// One move: accelerate, run at feed, brake; a triangle where the way is too short. Pure.
struct TrapezoidMove {
    double start_s = 0, from_mm = 0, to_mm = 0, speed_mm_per_s = 1, acceleration_mm_per_s2 = 1;
    [[nodiscard]] double duration_s() const;
    [[nodiscard]] double position_mm(double seconds) const; ///< held before and after
};

/// Up to when a path has been shown. A busy computer may halt a program between its look at the
/// clock and its next move, while samplers go on: such a move begins where they are, or what they
/// have shown would never have been, and the machine would seem to jump.
class ShownPath {
public:
    void show(double seconds) { until_s_ = std::max(until_s_, seconds); }
    /// When a move of now begins.
    double begin(double now_s) {
        if (now_s < until_s_) ++late_;
        latest_s_ = std::max(latest_s_, until_s_ - now_s);
        return std::max(now_s, until_s_);
    }
    [[nodiscard]] int late() const { return late_; }            ///< moves
    [[nodiscard]] double latest_s() const { return latest_s_; } ///< at most

private:
    double until_s_ = std::numeric_limits<double>::lowest(), latest_s_ = 0;
    int late_ = 0;
};

class CommandedAxis {
public:
    CommandedAxis(double start_mm, double acceleration_mm_per_s2);
    /// Starts a move at this time, or where its way has been shown; earlier moves have ended.
    /// @returns its end, seconds.
    double move(double now_s, double to_mm, double speed_mm_per_s);
    /// Stands still from now on, where the drive is now.
    void halt(double now_s);
    [[nodiscard]] double position_mm(double seconds) const;
    [[nodiscard]] ShownPath shown() const;

private:
    [[nodiscard]] double locked_position_mm(double seconds) const;
    mutable std::mutex mutex_;
    mutable ShownPath shown_;
    std::deque<TrapezoidMove> moves_; ///< the latest, so that a late sampler still finds its past
    double start_mm_, acceleration_mm_per_s2_;
};

} // namespace axiscal::simulate

#include "cnc/commanded_axis.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal::simulate {

namespace {
/// Moves kept for samplers that run late; a move takes longer than 1 ms.
constexpr std::size_t remembered_moves = 64;

double peak_speed(const TrapezoidMove& m) {
    const double way = std::abs(m.to_mm - m.from_mm);
    return std::min(m.speed_mm_per_s, std::sqrt(way * m.acceleration_mm_per_s2));
}
} // namespace

double TrapezoidMove::duration_s() const {
    const double peak = peak_speed(*this);
    if (peak <= 0) return 0;
    return std::abs(to_mm - from_mm) / peak + peak / acceleration_mm_per_s2;
}

double TrapezoidMove::position_mm(double seconds) const {
    const double t = seconds - start_s, total = duration_s();
    if (t <= 0) return from_mm;
    if (t >= total) return to_mm;
    const double peak = peak_speed(*this), ramp = peak / acceleration_mm_per_s2;
    const double way = std::abs(to_mm - from_mm);
    const double direction = to_mm > from_mm ? 1.0 : -1.0;
    const double left = total - t;
    double gone = peak * (t - 0.5 * ramp);
    if (t < ramp) gone = 0.5 * acceleration_mm_per_s2 * t * t;
    if (left < ramp) gone = way - 0.5 * acceleration_mm_per_s2 * left * left;
    return from_mm + direction * gone;
}

CommandedAxis::CommandedAxis(double start_mm, double acceleration_mm_per_s2)
    : start_mm_{start_mm}
    , acceleration_mm_per_s2_{acceleration_mm_per_s2} {}

double CommandedAxis::locked_position_mm(double seconds) const {
    const auto after = std::find_if(moves_.rbegin(), moves_.rend(),
                                    [&](const TrapezoidMove& m) { return m.start_s <= seconds; });
    if (after != moves_.rend()) return after->position_mm(seconds);
    return moves_.empty() ? start_mm_ : moves_.front().from_mm;
}

double CommandedAxis::position_mm(double seconds) const {
    const std::lock_guard lock{mutex_};
    shown_.show(seconds);
    return locked_position_mm(seconds);
}

ShownPath CommandedAxis::shown() const {
    const std::lock_guard lock{mutex_};
    return shown_;
}

double CommandedAxis::move(double now_s, double to_mm, double speed_mm_per_s) {
    const std::lock_guard lock{mutex_};
    const double start_s = shown_.begin(now_s), from_mm = locked_position_mm(start_s);
    moves_.push_back({start_s, from_mm, to_mm, speed_mm_per_s, acceleration_mm_per_s2_});
    if (moves_.size() > remembered_moves) moves_.pop_front();
    return start_s + moves_.back().duration_s();
}

void CommandedAxis::halt(double now_s) {
    const std::lock_guard lock{mutex_};
    const double start_s = shown_.begin(now_s), here_mm = locked_position_mm(start_s);
    moves_.push_back({start_s, here_mm, here_mm, 1, acceleration_mm_per_s2_});
}

} // namespace axiscal::simulate

#include "cnc/commanded_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::simulate {

namespace {
constexpr std::size_t remembered_ways = 64; ///< for samplers that run late
constexpr double least_turn = 1e-6;         ///< rad; an arc of less is a whole turn
} // namespace

PlanePoint CommandedPlane::Way::at(double path_mm) const {
    if (radius > 0) {
        const double here = angle + turned * path_mm / along.to_mm;
        return {centre[0] + radius * std::cos(here), centre[1] + radius * std::sin(here)};
    }
    const double share = along.to_mm > 0 ? path_mm / along.to_mm : 1;
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
}

CommandedPlane::CommandedPlane(PlanePoint start, double acceleration_mm_per_s2)
    : start_{start}
    , acceleration_mm_per_s2_{acceleration_mm_per_s2} {}

PlanePoint CommandedPlane::locked_position(double seconds) const {
    const auto after = std::find_if(ways_.rbegin(), ways_.rend(),
                                    [&](const Way& way) { return way.along.start_s <= seconds; });
    if (after != ways_.rend()) return after->at(after->along.position_mm(seconds));
    return ways_.empty() ? start_ : ways_.front().from;
}

PlanePoint CommandedPlane::position(double seconds) const {
    const std::lock_guard lock{mutex_};
    shown_.show(seconds);
    return locked_position(seconds);
}

ShownPath CommandedPlane::shown() const {
    const std::lock_guard lock{mutex_};
    return shown_;
}

double CommandedPlane::move(double now_s, const PlaneMove& move) {
    const std::lock_guard lock{mutex_};
    const double start_s = shown_.begin(now_s);
    Way way;
    way.from = locked_position(start_s);
    way.to = move.to;
    double length = std::hypot(way.to[0] - way.from[0], way.to[1] - way.from[1]);
    if (move.arc) {
        way.centre = {way.from[0] + move.centre_offset[0], way.from[1] + move.centre_offset[1]};
        way.radius = std::hypot(move.centre_offset[0], move.centre_offset[1]);
        way.angle = std::atan2(-move.centre_offset[1], -move.centre_offset[0]);
        const double end = std::atan2(way.to[1] - way.centre[1], way.to[0] - way.centre[0]);
        double turned = std::fmod((move.ccw ? 1 : -1) * (end - way.angle) + 4 * std::numbers::pi,
                                  2 * std::numbers::pi);
        if (turned < least_turn || turned > 2 * std::numbers::pi - least_turn)
            turned = 2 * std::numbers::pi;
        turned += 2 * std::numbers::pi * (move.turns - 1);
        way.turned = move.ccw ? turned : -turned;
        length = turned * way.radius;
    }
    way.along = {start_s, 0, length, move.feed_mm_per_min / 60, acceleration_mm_per_s2_};
    ways_.push_back(way);
    if (ways_.size() > remembered_ways) ways_.pop_front();
    return start_s + way.along.duration_s();
}

} // namespace axiscal::simulate

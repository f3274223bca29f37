#pragma once
// Every instant inside the process is monotonic; wall time appears only on paper.

#include <chrono>
#include <cstdint>
#include <string>

namespace axiscal {

using Duration = std::chrono::nanoseconds;

/// Tag clock of CLOCK_BOOTTIME: monotonic, and it counts the time of a suspend. It has no now(): time comes from a Scheduler, real or virtual.
struct MonotonicClock {
    using duration = Duration;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<MonotonicClock>;
    static constexpr bool is_steady = true;
};
using MonotonicTime = MonotonicClock::time_point;

constexpr std::int64_t nanoseconds_of(MonotonicTime t) {
    return t.time_since_epoch().count();
}
constexpr MonotonicTime monotonic_from_ns(std::int64_t ns) {
    return MonotonicTime{Duration{ns}};
}
constexpr double seconds_of(Duration d) {
    return std::chrono::duration<double>(d).count();
}
constexpr Duration from_seconds(double seconds) {
    return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

/// The triple mono-real-mono that ties the two clocks; its width bounds the error of the tie.
struct ClockTie {
    MonotonicTime before;
    std::int64_t utc_ns = 0; ///< CLOCK_REALTIME, nanoseconds since 1970
    MonotonicTime after;
    [[nodiscard]] constexpr Duration width() const { return after - before; }
    [[nodiscard]] constexpr std::int64_t utc_ns_at(MonotonicTime t) const {
        return utc_ns + (t - (before + width() / 2)).count();
    }
};

/// "2026-11-21T09:30:05Z" of a UTC instant; pure arithmetic, no locale, no time-zone data.
std::string iso8601_utc(std::int64_t utc_ns);

} // namespace axiscal

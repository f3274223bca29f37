#include "analysis/record/run_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace axiscal {
namespace {

/// Empty where the tie does not reach, and where numbers of a strange file fit in no clock.
std::optional<std::int64_t> utc_by(const ClockTie& tie, MonotonicTime at) {
    std::int64_t width = 0, since = 0, utc_ns = 0;
    const std::int64_t before = nanoseconds_of(tie.before);
    if (at < tie.before || __builtin_sub_overflow(nanoseconds_of(tie.after), before, &width) ||
        __builtin_sub_overflow(nanoseconds_of(at), before, &since) ||
        __builtin_sub_overflow(since, width / 2, &since) ||
        __builtin_add_overflow(tie.utc_ns, since, &utc_ns))
        return std::nullopt;
    return utc_ns;
}

/// Puts one row on the clock of `tie`; `farthest` grows with what the row's own clock was off.
void put_on(const ClockTie& tie, MonotonicTime at, std::int64_t& utc_ns, Duration& farthest) {
    const auto utc = utc_by(tie, at);
    if (!utc) return;
    std::int64_t off = 0;
    const bool stated = utc_ns != 0 && !__builtin_sub_overflow(utc_ns, *utc, &off);
    if (stated && off != std::numeric_limits<std::int64_t>::min())
        farthest = std::max(farthest, Duration{std::abs(off)});
    utc_ns = *utc;
}

ClockTie tie_of(const EventRecord& event) {
    return {event.at, event.utc_ns, event.at};
}

} // namespace

bool begins_another_boot(const EventRecord& event) {
    const bool of_the_station = event.kind == EventKind::interrupted ||
                                event.kind == EventKind::note || event.kind == EventKind::closed;
    return of_the_station && event.utc_ns != 0 &&
           event.text.find(computer_restarted) != std::string::npos;
}

std::string restart_text(const BootId& earlier, const BootId& later) {
    const bool certain = earlier.known() && later.known();
    return std::string{certain ? "" : "nobody can tell whether "}.append(computer_restarted);
}

Duration tell_times_by_one_clock(const ClockTie& opened,
                                 std::vector<EventRecord>& events,
                                 std::vector<RetakeRecord>& retakes,
                                 ClockTie& closed) {
    Duration farthest{};
    const ClockTie of_points = tie_of_points(opened, events);
    ClockTie tie = opened;
    for (EventRecord& event : events) {
        if (begins_another_boot(event)) tie = tie_of(event);
        put_on(tie, event.at, event.utc_ns, farthest);
    }
    for (RetakeRecord& retake : retakes)
        put_on(of_points, retake.at, retake.utc_ns, farthest);
    put_on(tie, closed.before, closed.utc_ns, farthest);
    return farthest;
}

void tell_orders_by_one_clock(const ClockTie& opened,
                              const std::vector<EventRecord>& events,
                              std::vector<OrderRecord>& orders) {
    const ClockTie of_points = tie_of_points(opened, events);
    Duration ignored{}; // the events tell how far the clock was off
    for (OrderRecord& order : orders) {
        const bool at_the_opening =
            order.kind == "arm" || order.kind == "override" || order.kind == "drift";
        put_on(at_the_opening ? opened : of_points, order.at, order.utc_ns, ignored);
    }
}

ClockTie tie_of_points(const ClockTie& opened, const std::vector<EventRecord>& events) {
    ClockTie tie = opened;
    for (const EventRecord& event : events)
        if (event.kind == EventKind::interrupted && begins_another_boot(event)) tie = tie_of(event);
    return tie;
}

std::string remark_on_clock(Duration farthest) {
    constexpr Duration noticeable = std::chrono::seconds{2};
    if (farthest < noticeable) return {};
    return "The clock of the station's computer was set in mid-run, by up to " +
           std::to_string(std::llround(seconds_of(farthest))) +
           " s. The times stated here follow from its reading at the opening and from the "
           "monotonic "
           "clock, which nobody sets; the run file also keeps what the clock said.";
}

} // namespace axiscal

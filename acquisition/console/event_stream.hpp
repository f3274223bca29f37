#pragma once
// GET /v1/events as bytes: what a client asks for, and one event as text (HTML Living Standard, 9.2
// "Server-sent events"). Pure.

#include "analysis/quantity/result.hpp"

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

inline constexpr std::string_view events_path = "/v1/events";
inline constexpr std::string_view events_type = "text/event-stream";

/// How many points of which run a client has: "18c2f0a5b1d3e000-2-17". Only equal `daemon` and
/// `run` make two counts comparable: then the points counted are the same, too.
struct PointsId {
    std::uint64_t daemon = 0; ///< differs from start to start
    std::uint64_t run = 0;    ///< grows with each run that is shown, and where points changed
    std::uint64_t points = 0; ///< durable points of that run, in the order they were taken
    friend bool operator==(const PointsId&, const PointsId&) = default;
};
std::string text_of(const PointsId& id);
/// Nothing for any other text, as of another daemon's version.
std::optional<PointsId> points_id_of(std::string_view text);

/// What one client wants to hear.
struct EventsAsked {
    std::size_t stream_points = 0; ///< at most so many stretches of the stream; 0: not asked for
    std::optional<PointsId> has;   ///< what reached it before the connection was lost
};
/// Of "/v1/events" or "/v1/events?stream=200", and of the header Last-Event-ID, where any text may
/// stand. @errors Fault::bad_request for another query, or a number that is not 1 to 4096.
Result<EventsAsked> events_asked_of(std::string_view target, std::string_view last_event_id);

/// One event; each line of `data` becomes one of its lines. What would end a line of `name` or `id`
/// is left out. An empty `id` leaves the client's last one as it is.
std::string event_text(std::string_view name, std::string_view data, std::string_view id = {});
/// How long a client waits before it connects again.
std::string retry_text(std::chrono::milliseconds pause);
/// Head of the answer; behind it come events until the connection ends.
std::string events_head();

} // namespace axiscal

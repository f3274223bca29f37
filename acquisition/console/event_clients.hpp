#pragma once
// Who listens to GET /v1/events, and whose turn it is for what. No I/O and no clock: time comes in.

#include "analysis/quantity/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace axiscal {

enum class EventTopic : std::uint8_t { status, points, stream, heartbeat };

/// Nothing is queued: of each topic a client knows only whether there is news. It gets the newest
/// state when it can take it, and what came in between is dropped. Where more than one topic has
/// news, the one that it has gone without for longest comes first. Loop-bound.
class EventClients {
public:
    static constexpr std::size_t places = 32;
    static constexpr Duration pace =
        std::chrono::milliseconds{50};                             ///< between two frames, at least
    static constexpr Duration patience = std::chrono::seconds{30}; ///< for one frame to be taken

    /// Everything but a heartbeat is news to it. @param stretches  of the stream, 0: wants none
    /// @returns its place; nothing where all are taken.
    std::optional<std::size_t> enter(std::size_t stretches);
    void leave(std::size_t place);

    void news(EventTopic topic); ///< for all, but of the stream
    void news_of_stream(std::size_t stretches);
    void no_news(std::size_t place, EventTopic topic);

    struct Turn {
        std::optional<EventTopic> topic; ///< it may be sent now
        std::optional<MonotonicTime> at; ///< else when to ask again; nothing: once there is news
    };
    [[nodiscard]] Turn turn(std::size_t place, MonotonicTime now) const;
    /// A frame of `topic` is handed over; until taken() none else is.
    void hand_over(std::size_t place, EventTopic topic, MonotonicTime now);
    void taken(std::size_t place);

    [[nodiscard]] bool empty() const;
    [[nodiscard]] std::set<std::size_t> stretches() const; ///< asked for, each once
    /// Those that something waits for, and that nothing is under way to.
    [[nodiscard]] std::vector<std::size_t> waiting() const;
    /// Those that have not taken a frame for longer than patience.
    [[nodiscard]] std::vector<std::size_t> overdue(MonotonicTime now) const;

private:
    static constexpr std::size_t topics = 4;
    struct Client {
        std::size_t stretches = 0;
        std::array<bool, topics> has_news{};
        std::array<std::optional<MonotonicTime>, topics> sent; ///< empty: never
        std::optional<MonotonicTime> last;                     ///< of any topic
        bool under_way = false;
    };
    std::array<std::optional<Client>, places> clients_;
};

} // namespace axiscal

#pragma once
// GET /v1/events on the loop: looks at the station while somebody listens, and sends to each client
// what EventClients says. Private to the console.

#include "acquisition/console/event_clients.hpp"
#include "acquisition/console/event_frames.hpp"
#include "acquisition/console/event_stream.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/loop/scheduler.hpp"

#include <boost/asio/generic/stream_protocol.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>

namespace axiscal {

class EventHub;

/// One of the places; given back when it ends.
class EventSeat {
public:
    EventSeat(std::shared_ptr<EventHub> hub, std::size_t place);
    EventSeat(EventSeat&& other) noexcept = default;
    EventSeat& operator=(EventSeat&&) = delete;
    ~EventSeat();
    [[nodiscard]] std::size_t place() const { return place_; }

private:
    std::shared_ptr<EventHub> hub_; ///< null: moved from
    std::size_t place_ = 0;
};

/// Loop-bound. Sleeps without a timer while nobody listens.
class EventHub : public std::enable_shared_from_this<EventHub> {
public:
    using Socket = boost::asio::generic::stream_protocol::socket;

    /// @param status  as GET /v1/status shows it. Both are asked until end(), and not after it.
    EventHub(Scheduler& scheduler,
             const StationInterface& station,
             std::function<StationStatus()> status);

    /// The newest of everything is ready then. @errors Fault::busy with what to do, where all
    /// places are taken or the station is about to end.
    Result<EventSeat> take_seat(const EventsAsked& asked);
    /// Until the client hangs up, does not read for EventClients::patience, or end().
    Task<void> serve(Socket socket, EventSeat seat);
    /// Hangs up on everybody; nobody is taken from now on.
    void end();

private:
    friend class EventSeat;
    struct Listener {
        Listener(Socket with, Scheduler& scheduler)
            : socket{std::move(with)}
            , bell{scheduler.executor()} {}
        Socket socket;
        Doorbell bell;
    };
    struct Place {
        Listener* listener = nullptr; ///< null until serve()
        std::size_t stretches = 0;
        std::optional<PointsId> has;
    };

    Task<void> look_while_somebody_listens();
    void look();
    void look_at_points();
    void look_at_stream();
    void beat();
    void hang_up(std::size_t place);
    void hang_up_on_all();
    void leave(std::size_t place);
    [[nodiscard]] bool is_due(std::optional<MonotonicTime>& last, Duration pause) const;
    [[nodiscard]] EventFrames::Frame frame_for(std::size_t place, EventTopic topic);

    Scheduler& scheduler_;
    const StationInterface& station_;
    std::function<StationStatus()> status_;
    EventFrames frames_;
    EventClients clients_;
    std::array<Place, EventClients::places> places_{};
    std::optional<MonotonicTime> status_seen_, stream_seen_, last_beat_;
    bool looking_ = false, ended_ = false;
};

} // namespace axiscal

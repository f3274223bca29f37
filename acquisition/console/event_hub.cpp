#include "acquisition/console/event_hub.hpp"

#include "acquisition/console/peer.hpp"
#include "drivers/loop/spawn.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <spdlog/spdlog.h>

#include <exception>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <utility>

namespace axiscal {
namespace {

constexpr auto status_pause = std::chrono::milliseconds{200}; // 5 a second
constexpr auto stream_pause = EventClients::pace;
constexpr auto beat_pause = std::chrono::seconds{1};
constexpr auto come_again_after = std::chrono::milliseconds{1000};

/// The kernel is a queue, too: it takes a frame only when the one before is on its way. A socket
/// that lets nothing of this be set serves all the same.
void keep_little_under_way(int descriptor) {
    int domain = 0;
    socklen_t size = sizeof domain;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &domain, &size) != 0) return;
    const int one = 1, few_bytes = 8 * 1024;
    if (domain == AF_UNIX) {
        ::setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &few_bytes, sizeof few_bytes);
        return;
    }
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &one, sizeof one);
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
}

} // namespace

EventSeat::EventSeat(std::shared_ptr<EventHub> hub, std::size_t place)
    : hub_{std::move(hub)}
    , place_{place} {}

EventSeat::~EventSeat() {
    if (hub_) hub_->leave(place_);
}

EventHub::EventHub(Scheduler& scheduler,
                   const StationInterface& station,
                   std::function<StationStatus()> status)
    : scheduler_{scheduler}
    , station_{station}
    , status_{std::move(status)}
    , frames_{static_cast<std::uint64_t>(scheduler.clock_tie().utc_ns)} {}

Result<EventSeat> EventHub::take_seat(const EventsAsked& asked) {
    if (ended_) return fail(Fault::busy, "The station is about to end; connect again later.");
    const auto place = clients_.enter(asked.stream_points);
    if (!place)
        return fail(Fault::busy,
                    "All " + std::to_string(EventClients::places) +
                        " places of GET /v1/events are taken. Close a page or program that "
                        "listens, or read GET /v1/status meanwhile.");
    EventSeat seat{shared_from_this(), *place};
    places_[*place] = Place{nullptr, asked.stream_points, asked.has};
    look();
    if (asked.has == frames_.points_id()) clients_.no_news(*place, EventTopic::points);
    if (!std::exchange(looking_, true)) spawn(scheduler_, look_while_somebody_listens());
    return seat;
}

Task<void> EventHub::serve(Socket socket, EventSeat seat) {
    Listener listener{std::move(socket), scheduler_};
    const std::size_t place = seat.place();
    places_[place].listener = &listener;
    keep_little_under_way(listener.socket.native_handle());
    std::string head = events_head() + retry_text(come_again_after);
    while (!ended_ && listener.socket.is_open()) {
        const EventClients::Turn turn = clients_.turn(place, scheduler_.now());
        if (!turn.topic) {
            co_await listener.bell.wait(scheduler_, turn.at);
            continue;
        }
        EventFrames::Frame frame = frame_for(place, *turn.topic);
        if (!frame) {
            clients_.no_news(place, *turn.topic);
            continue;
        }
        if (!head.empty())
            frame = std::make_shared<const std::string>(std::exchange(head, {}) + *frame);
        clients_.hand_over(place, *turn.topic, scheduler_.now());
        const auto [error, sent] =
            co_await boost::asio::async_write(listener.socket, boost::asio::buffer(*frame),
                                              boost::asio::as_tuple(boost::asio::use_awaitable));
        if (error) break;
        clients_.taken(place);
    }
}

EventFrames::Frame EventHub::frame_for(std::size_t place, EventTopic topic) {
    Place& client = places_[place];
    switch (topic) {
    case EventTopic::status: return frames_.status();
    case EventTopic::heartbeat: return frames_.heartbeat();
    case EventTopic::stream: return frames_.stream(client.stretches);
    case EventTopic::points: break;
    }
    return frames_.points(std::exchange(client.has, frames_.points_id()));
}

void EventHub::end() {
    ended_ = true;
    hang_up_on_all();
}

void EventHub::leave(std::size_t place) {
    clients_.leave(place);
    places_[place] = {};
}

void EventHub::hang_up(std::size_t place) {
    Listener* const listener = places_[place].listener;
    if (!listener) return;
    boost::system::error_code ignored;
    listener->socket.close(ignored);
    listener->bell.ring();
}

void EventHub::hang_up_on_all() {
    for (std::size_t place = 0; place < places_.size(); ++place)
        hang_up(place);
}

/// What goes wrong with a look ends the events that are shown, as it ends one request elsewhere.
Task<void> EventHub::look_while_somebody_listens() {
    const auto self = shared_from_this();
    for (;;) {
        const bool fast = !clients_.stretches().empty();
        co_await scheduler_.sleep_for(fast ? Duration{stream_pause} : Duration{status_pause});
        if (ended_ || clients_.empty()) break;
        try {
            look();
        } catch (const std::exception& bug) {
            spdlog::error("GET /v1/events ended with: {}", bug.what());
            hang_up_on_all();
        }
    }
    looking_ = false;
    frames_.forget();
    status_seen_ = stream_seen_ = last_beat_ = std::nullopt;
}

void EventHub::look() {
    const bool due = is_due(status_seen_, status_pause) || !frames_.status();
    if (due && frames_.keep(status_())) clients_.news(EventTopic::status);
    look_at_points();
    look_at_stream();
    beat();
    for (const std::size_t place : clients_.overdue(scheduler_.now()))
        hang_up(place);
    for (const std::size_t place : clients_.waiting())
        if (Listener* const listener = places_[place].listener) listener->bell.ring();
}

void EventHub::look_at_points() {
    PointsView shown = station_.points(frames_.points_known());
    if (frames_.begins_anew(shown)) shown = station_.points(0);
    if (frames_.keep(shown)) clients_.news(EventTopic::points);
}

/// A client that has come in between asks for a number of stretches that nobody asked for before.
void EventHub::look_at_stream() {
    const bool due = is_due(stream_seen_, stream_pause);
    const auto asked = clients_.stretches();
    frames_.forget_streams_but(asked);
    for (const std::size_t stretches : asked)
        if ((due || !frames_.stream(stretches)) &&
            frames_.keep(stretches, station_.stream(stretches)))
            clients_.news_of_stream(stretches);
}

/// The first one comes a second after the first client: until then all is new. A client that has
/// gone leaves its place at the next one.
void EventHub::beat() {
    if (!last_beat_) last_beat_ = scheduler_.now();
    if (!is_due(last_beat_, beat_pause)) return;
    frames_.beat(iso8601_utc(scheduler_.clock_tie().utc_ns));
    clients_.news(EventTopic::heartbeat);
    for (std::size_t place = 0; place < places_.size(); ++place)
        if (Listener* const listener = places_[place].listener;
            listener && has_hung_up(listener->socket.native_handle()))
            hang_up(place);
}

bool EventHub::is_due(std::optional<MonotonicTime>& last, Duration pause) const {
    const MonotonicTime now = scheduler_.now();
    if (last && now - *last < pause) return false;
    last = now;
    return true;
}

} // namespace axiscal

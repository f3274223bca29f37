#include "acquisition/console/http_server.hpp"

#include "acquisition/console/access.hpp"
#include "acquisition/console/alignment_json.hpp"
#include "acquisition/console/api_json.hpp"
#include "acquisition/console/drift_json.hpp"
#include "acquisition/console/event_hub.hpp"
#include "acquisition/console/http_answer.hpp"
#include "acquisition/console/http_orders.hpp"
#include "acquisition/console/http_page.hpp"
#include "acquisition/console/http_pairing.hpp"
#include "acquisition/console/http_reading.hpp"
#include "acquisition/console/http_runs.hpp"
#include "acquisition/console/listening.hpp"
#include "acquisition/console/metrics_text.hpp"
#include "acquisition/console/metrics_writer.hpp"
#include "acquisition/console/peer.hpp"
#include "acquisition/console/stream_json.hpp"
#include "acquisition/console/tls_entrance.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/turned_away.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <array>
#include <exception>
#include <optional>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Request = HttpRequest;
using Response = HttpResponse;

constexpr auto quiet = asio::as_tuple(asio::use_awaitable);
constexpr auto idle_limit =
    std::chrono::seconds{30}; // a client that neither asks nor reads is let go
constexpr auto try_again = std::chrono::seconds{1}; // for an address that is not there yet
constexpr std::size_t client_limit = 64; // of each door: who fills one leaves the other open

constexpr std::size_t seat_of(Door door) {
    return door == Door::unix_socket ? 0 : 1;
}

/// One of the clients that a door may have.
struct ClientSeat {
    explicit ClientSeat(std::size_t& of)
        : taken{of} {
        ++taken;
    }
    ClientSeat(const ClientSeat&) = delete;
    ClientSeat& operator=(const ClientSeat&) = delete;
    ~ClientSeat() { --taken; }
    std::size_t& taken;
};

/// Who asks. A request for the events leaves its place with them here, a large answer its own.
struct Caller {
    Door door = Door::tcp;
    int descriptor = -1;
    std::optional<EventSeat> events;
    LargeAnswerSeat large; ///< until the answer is sent
};

} // namespace

struct HttpServer::Impl : std::enable_shared_from_this<HttpServer::Impl> {
    Impl(Scheduler& on,
         StationInterface& of,
         ConsoleConfig with,
         std::string secret,
         std::string paired_file)
        : scheduler{on}
        , station{of}
        , config{std::move(with)}
        , tcp{on.executor()}
        , local{on.executor()}
        , pairing{on, std::move(paired_file)}
        , runs{on, of} {
        rules.token = std::move(secret);
        events = std::make_shared<EventHub>(on, of, [this] { return shown_status(); });
    }

    Task<void> open_tcp_later();
    void serve_tcp();
    template <class Acceptor> Task<void> accept(Acceptor& acceptor, Door door);
    void begin(asio::local::stream_protocol::socket client);
    void begin(asio::ip::tcp::socket client);
    template <class Socket> Task<void> serve(Socket socket, Door door);
    bool is_stranger(const asio::local::stream_protocol::socket& socket);
    bool is_stranger(const asio::ip::tcp::socket& socket);
    Task<Response> respond_or_tell(Request request, Caller& caller);
    Task<Response> respond(Request request, Caller& caller);
    Response seat_for_events(const Request& request, Caller& caller);
    [[nodiscard]] StationStatus shown_status() const;
    Orderer orderer_of(const RequestHead& head, const AccessVerdict& verdict, const Caller& caller);
    Task<Response> order(Request request, RequestHead head, AccessVerdict verdict, Caller& caller);
    Task<Response> change(Request request, Orderer by, int descriptor);
    Task<Response> remove(Request request);
    [[nodiscard]] std::string why_no_page() const;

    Scheduler& scheduler;
    StationInterface& station;
    ConsoleConfig config;
    AccessRules rules;
    asio::ip::tcp::acceptor tcp;
    asio::local::stream_protocol::acceptor local;
    PairingDoor pairing;
    RunsDoor runs;
    SocketFile socket_file;
    PageFiles page;
    bool bound = false, ended = false;
    std::shared_ptr<TlsEntrance> tls;     ///< null: TCP speaks HTTP as it is
    std::array<std::size_t, 2> clients{}; ///< by door
    std::shared_ptr<EventHub> events;
    TurnedAway strangers;
    std::string no_tcp; ///< why nobody is heard over TCP now
};

bool HttpServer::Impl::is_stranger(const asio::local::stream_protocol::socket& /*socket*/) {
    return false; // the socket's mode and group have judged
}

bool HttpServer::Impl::is_stranger(const asio::ip::tcp::socket& socket) {
    if (config.allowed_clients.empty()) return false;
    boost::system::error_code gone;
    const auto remote = socket.remote_endpoint(gone);
    const std::string from = gone ? "" : remote.address().to_string();
    if (any_covers(config.allowed_clients, from)) return false;
    if (const auto words = strangers.take(from, scheduler.now()))
        spdlog::warn("The console turned {}: console.allowed_clients does not name it.", *words);
    return true;
}

template <class Acceptor> Task<void> HttpServer::Impl::accept(Acceptor& acceptor, Door door) {
    const auto self = shared_from_this();
    for (;;) {
        auto [error, socket] = co_await acceptor.async_accept(quiet);
        if (error == asio::error::operation_aborted || error == asio::error::bad_descriptor)
            co_return;
        if (error) { // out of descriptors: wait instead of spinning
            co_await scheduler.sleep_for(std::chrono::milliseconds{200});
            continue;
        }
        if (is_stranger(socket)) continue; // the socket closes here
        if (clients[seat_of(door)] < client_limit) begin(std::move(socket));
    }
}

void HttpServer::Impl::begin(asio::local::stream_protocol::socket client) {
    spawn(scheduler, serve(std::move(client), Door::unix_socket));
}

/// A place is taken before the handshake: one that stalls ends as a slow client does.
void HttpServer::Impl::begin(asio::ip::tcp::socket client) {
    if (!tls) return spawn(scheduler, serve(std::move(client), Door::tcp));
    auto plain = tls->take(std::move(client));
    if (plain) spawn(scheduler, serve(*std::move(plain), Door::tcp));
}

template <class Socket> Task<void> HttpServer::Impl::serve(Socket socket, Door door) {
    const auto self = shared_from_this();
    const ClientSeat seat{clients[seat_of(door)]};
    Caller caller{door, socket.native_handle(), {}, {}};
    beast::basic_stream<typename Socket::protocol_type> stream{std::move(socket)};
    beast::flat_buffer buffer;
    for (bool alive = true; alive;) {
        stream.expires_after(idle_limit);
        HttpAsked asked = co_await read_request(stream, buffer);
        if (!asked.request && !asked.refusal) break;
        Response response = asked.refusal ? *std::move(asked.refusal) : Response{};
        if (asked.request) {
            Request request = *std::move(asked.request);
            response = co_await respond_or_tell(std::move(request), caller);
        }
        if (caller.events) { // its place among the requests is free again
            spawn(scheduler, events->serve(stream.release_socket(), *std::move(caller.events)));
            co_return;
        }
        alive = response.keep_alive();
        stream.expires_after(idle_limit);
        const auto [write_error, sent] = co_await http::async_write(stream, response, quiet);
        caller.large.reset();
        if (write_error) break;
        if (!alive) co_await end_gently(stream);
    }
}

/// What one request throws ends that request: the station goes on.
Task<Response> HttpServer::Impl::respond_or_tell(Request request, Caller& caller) {
    std::string what;
    Request asked = request;
    try {
        co_return co_await respond(std::move(asked), caller);
    } catch (const std::exception& bug) {
        what = bug.what();
    }
    co_return answer(request, Error{Fault::internal, "This request ended with: " + what, {}, {}});
}

Task<Response> HttpServer::Impl::respond(Request request, Caller& caller) {
    RequestHead head = head_of(request, caller.door);
    if (head.changes_state) head.page = pairing.name_of(head.cookies);
    AccessVerdict verdict = judge_access(head, rules);
    if (verdict.status != 200)
        co_return answer_in_words(request, static_cast<http::status>(verdict.status),
                                  verdict.sentence);
    if (request.method() == http::verb::post)
        co_return co_await order(std::move(request), std::move(head), std::move(verdict), caller);
    if (request.method() == http::verb::delete_) co_return co_await remove(std::move(request));
    if (request.method() != http::verb::get)
        co_return answer_in_words(request, http::status::method_not_allowed,
                                  "GET reads, POST changes");
    const std::string path = asked_path(request);
    if (is_page_path(path)) co_return answer_page(request, page, path);
    if (path == session_path) co_return pairing.show_session(request);
    if (path == pair_path) co_return pairing.list(request);
    const std::string_view of_runs = runs_call_of(path);
    if (of_runs == runs_path) co_return co_await runs.list(std::move(request));
    if (of_runs == one_run_path) co_return co_await runs.show_one(std::move(request), caller.large);
    if (of_runs == run_paper_path)
        co_return co_await runs.give_paper(std::move(request), caller.large);
    if (path == "/v1/alignment")
        co_return answer(request, http::status::ok, to_json(station.alignment()));
    if (path == events_path) co_return seat_for_events(request, caller);
    if (path == stream_path) {
        const auto points = stream_points_of({request.target().data(), request.target().size()});
        if (!points) co_return answer(request, points.error());
        co_return answer(request, http::status::ok, to_json(station.stream(*points)));
    }
    if (path == "/metrics")
        co_return answer_as(request, metrics_content_type, metrics_text(station.status()));
    if (path == "/v1/status") co_return answer(request, http::status::ok, to_json(shown_status()));
    if (path == "/v1/instruments")
        co_return answer(request, http::status::ok, to_json(shown_status())["instruments"]);
    if (path == "/v1/preflight") {
        ArmRequest as_configured;
        const auto checks = co_await station.preflight(std::move(as_configured));
        if (!checks) co_return answer(request, checks.error());
        co_return answer(request, http::status::ok, {{"checks", to_json(*checks)}});
    }
    co_return answer_in_words(
        request, http::status::not_found,
        "known are GET /v1/status, GET /v1/instruments, GET "
        "/v1/preflight, GET /v1/alignment, GET /v1/stream, GET /v1/events, GET /v1/runs, GET "
        "/v1/runs/ID, GET /v1/runs/ID/PAPER, GET /metrics, POST "
        "/v1/run, POST /v1/run/trigger, POST /v1/run/reading, POST /v1/run/abort, POST "
        "/v1/run/retake, POST "
        "/v1/run/exclude, POST /v1/run/answer, POST /v1/preflight, POST /v1/alignment, POST "
        "/v1/drift, GET, POST and DELETE /v1/session, GET and POST /v1/pair, POST /v1/pair/end");
}

/// The answer counts only where the caller gets no place.
Response HttpServer::Impl::seat_for_events(const Request& request, Caller& caller) {
    const auto asked = events_asked_of({request.target().data(), request.target().size()},
                                       last_event_id_of(request));
    if (!asked) return answer(request, asked.error());
    auto seat = events->take_seat(*asked);
    if (!seat)
        return answer_in_words(request, http::status::service_unavailable, seat.error().detail);
    caller.events.emplace(*std::move(seat));
    return {};
}

StationStatus HttpServer::Impl::shown_status() const {
    StationStatus status = station.status();
    if (!no_tcp.empty()) status.notes.push_back(no_tcp);
    return status;
}

/// Who orders, as the door knows him.
Orderer HttpServer::Impl::orderer_of(const RequestHead& head,
                                     const AccessVerdict& verdict,
                                     const Caller& caller) {
    if (caller.door == Door::unix_socket) return peer_of_socket(caller.descriptor);
    Orderer by;
    by.door = verdict.by_page ? "page" : "token";
    if (verdict.by_page) by.user = head.page;
    return by;
}

/// What is ordered from a page stands in the log with its name, whatever came of it; a run file
/// keeps the orders that decide about its run.
Task<Response>
HttpServer::Impl::order(Request request, RequestHead head, AccessVerdict verdict, Caller& caller) {
    Orderer by = orderer_of(head, verdict, caller);
    if (!verdict.by_page || head.matter != Matter::station)
        co_return co_await change(std::move(request), std::move(by), caller.descriptor);
    pairing.note_order(head.cookies);
    const std::string told = name_of(by) + ": POST " + valid_text(asked_path(request));
    Response response = co_await change(std::move(request), std::move(by), caller.descriptor);
    spdlog::info("{}, answered by {}", told, response.result_int());
    co_return response;
}

Task<Response> HttpServer::Impl::remove(Request request) {
    const std::string target = asked_path(request);
    if (target == session_path)
        co_return co_await pairing.close_session(std::move(request), config.speaks_tls());
    co_return answer_in_words(
        request, http::status::method_not_allowed,
        "GET reads, POST changes, DELETE ends the session of a browser alone");
}

/// Why a browser that is paired now would find no page; empty: nothing is known.
std::string HttpServer::Impl::why_no_page() const {
    if (!no_tcp.empty()) return no_tcp;
    if (tcp.is_open()) return {};
    return "No browser gets in: the door for them is shut by port = 0 in [console] of the station "
           "file.";
}

Task<Response> HttpServer::Impl::change(Request request, Orderer by, int descriptor) {
    const std::string target = asked_path(request);
    if (target == pair_path) co_return pairing.offer(request, config, why_no_page());
    if (target == pair_end_path) co_return co_await pairing.end(std::move(request));
    if (target == session_path)
        co_return co_await pairing.open_session(std::move(request), config.speaks_tls());
    if (target == "/v1/run")
        co_return co_await arm_by_request(station, std::move(request), std::move(by), descriptor);
    if (target == "/v1/preflight") {
        auto wanted = arm_request_from_json(request.body());
        if (!wanted) co_return answer(request, wanted.error());
        ArmRequest order = *std::move(wanted);
        const auto checks = co_await station.preflight(std::move(order));
        if (!checks) co_return answer(request, checks.error());
        co_return answer(request, http::status::ok, {{"checks", to_json(*checks)}});
    }
    if (target == "/v1/run/retake" || target == "/v1/run/exclude")
        co_return co_await revise_by_request(station, std::move(request), std::move(by));
    if (target == "/v1/run/answer")
        co_return co_await answer_by_request(station, std::move(request), std::move(by));
    if (target == "/v1/run/trigger") {
        const auto done = station.trigger();
        if (!done) co_return answer(request, done.error());
        co_return answer(request, http::status::accepted, {{"trigger", "accepted"}});
    }
    if (target == "/v1/run/reading") {
        const auto seconds_of_arc = typed_reading_from_json(request.body());
        if (!seconds_of_arc) co_return answer(request, seconds_of_arc.error());
        const auto done = station.type_reading(*seconds_of_arc);
        if (!done) co_return answer(request, done.error());
        co_return answer(request, http::status::accepted, {{"reading", "accepted"}});
    }
    if (target == "/v1/run/abort") {
        auto order = abort_request_from_json(request.body());
        if (!order) co_return answer(request, order.error());
        by.name = order->by;
        const auto done = co_await station.abort(std::move(order->reason), std::move(by));
        if (!done) co_return answer(request, done.error());
        co_return answer(
            request, http::status::ok,
            {{"run", done->complete ? "complete" : "aborted"}, {"reason", done->reason}});
    }
    if (target == "/v1/drift") {
        auto wanted = drift_request_from_json(request.body());
        if (!wanted) co_return answer(request, wanted.error());
        DriftRequest order = *std::move(wanted);
        by.name = order.by.name;
        order.by = std::move(by);
        const auto run = co_await station.drift(std::move(order));
        if (!run) co_return answer(request, run.error());
        co_return answer(request, http::status::created, {{"run", *run}});
    }
    if (target == "/v1/alignment") {
        const auto order = alignment_order_from_json(request.body());
        if (!order) co_return answer(request, order.error());
        const auto done = station.align(*order);
        if (!done) co_return answer(request, done.error());
        co_return answer(request, http::status::ok, to_json(station.alignment()));
    }
    co_return answer_in_words(
        request, http::status::not_found,
        "known are POST /v1/run, /v1/run/trigger, /v1/run/reading, /v1/run/abort, "
        "/v1/run/retake, /v1/run/exclude, /v1/run/answer, /v1/preflight, "
        "/v1/alignment, /v1/drift, /v1/session, /v1/pair, /v1/pair/end");
}

HttpServer::HttpServer(Scheduler& scheduler,
                       StationInterface& station,
                       ConsoleConfig config,
                       std::string token,
                       std::string paired_file)
    : impl_{std::make_shared<Impl>(
          scheduler, station, std::move(config), std::move(token), std::move(paired_file))} {}

HttpServer::~HttpServer() {
    impl_->ended = true;
    impl_->events->end();
    impl_->pairing.stop();
    impl_->runs.stop();
    boost::system::error_code ignored;
    impl_->tcp.close(ignored);
    impl_->local.close(ignored);
    impl_->tls = nullptr;
    impl_->socket_file = {};
}

Result<void> HttpServer::bind() {
    if (std::exchange(impl_->bound, true)) return {};
    AXISCAL_TRY(impl_->socket_file, listen(impl_->local, impl_->config));
    return {};
}

void HttpServer::show_page(PageFiles page) {
    impl_->page = std::move(page);
}

void HttpServer::show_runs(std::string state_directory) {
    impl_->runs.show(std::move(state_directory));
}

Result<void> HttpServer::start() {
    AXISCAL_CHECK(bind());
    if (impl_->config.speaks_tls()) {
        AXISCAL_TRY(impl_->tls, TlsEntrance::open(impl_->scheduler, impl_->config));
    }
    const Result<void> tcp = listen(impl_->tcp, impl_->config);
    if (!tcp && tcp.error().fault != Fault::io) return tcp;
    if (impl_->local.is_open())
        spawn(impl_->scheduler, impl_->accept(impl_->local, Door::unix_socket));
    if (tcp) {
        impl_->serve_tcp();
        return {};
    }
    impl_->no_tcp = "The console: " + describe(tcp.error()) + ". It is tried again each second.";
    spdlog::warn("{}", impl_->no_tcp);
    spawn(impl_->scheduler, impl_->open_tcp_later());
    return {};
}

void HttpServer::Impl::serve_tcp() {
    rules.known_hosts = known_hosts_of(config.host, config.port, config.allowed_hosts);
    rules.page_hosts =
        page_hosts_of(config.host, config.port, config.allowed_hosts, config.speaks_tls());
    rules.tls = config.speaks_tls();
    if (tcp.is_open()) spawn(scheduler, accept(tcp, Door::tcp));
}

/// An address comes with its network, perhaps long after the daemon's start. Who only looks over
/// TCP holds up neither trigger nor run meanwhile.
Task<void> HttpServer::Impl::open_tcp_later() {
    const auto self = shared_from_this();
    Result<void> opened = fail(Fault::io, "");
    while (!opened) {
        co_await scheduler.sleep_for(try_again);
        if (ended) co_return;
        opened = listen(tcp, config);
    }
    no_tcp.clear();
    spdlog::info("The console listens on {}:{} now.", config.host, config.port);
    serve_tcp();
}

void HttpServer::end_events() {
    impl_->events->end();
}

int HttpServer::port() const {
    return impl_->config.port;
}

} // namespace axiscal

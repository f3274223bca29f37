#include "acquisition/console/http_face.hpp"

#include "acquisition/console/access.hpp"
#include "acquisition/console/alignment_json.hpp"
#include "acquisition/console/api_json.hpp"
#include "acquisition/console/drift_json.hpp"
#include "acquisition/console/http_answer.hpp"
#include "acquisition/console/listening.hpp"
#include "acquisition/console/peer.hpp"
#include "acquisition/console/stream_json.hpp"
#include "drivers/spawn.hpp"

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
constexpr std::uint64_t body_limit = std::uint64_t{64} * 1024;
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

/// Arming met checks that do not hold: all of them at once.
Response answer_with_checks(const Request& request,
                            const Error& error,
                            const Result<std::vector<PreflightRecord>>& checks) {
    auto body = to_json(error);
    if (checks) body["checks"] = to_json(*checks);
    return answer(request, http::status::conflict, body);
}

} // namespace

struct HttpFace::Impl : std::enable_shared_from_this<HttpFace::Impl> {
    Impl(Scheduler& on, StationFace& of, ConsoleConfig with, std::string secret)
        : scheduler{on}
        , station{of}
        , config{std::move(with)}
        , tcp{on.executor()}
        , local{on.executor()} {
        rules.token = std::move(secret);
    }

    template <class Acceptor> Task<void> accept(Acceptor& acceptor, Door door);
    template <class Socket> Task<void> serve(Socket socket, Door door);
    bool is_stranger(const asio::local::stream_protocol::socket& socket);
    bool is_stranger(const asio::ip::tcp::socket& socket);
    Task<Response> respond_or_tell(Request request, Door door, int descriptor);
    Task<Response> respond(Request request, Door door, int descriptor);
    Task<Response> change(Request request, Orderer by);
    Task<Response> arm(Request request, Orderer by);
    Task<Response> revise(Request request, Orderer by);

    Scheduler& scheduler;
    StationFace& station;
    ConsoleConfig config;
    AccessRules rules;
    asio::ip::tcp::acceptor tcp;
    asio::local::stream_protocol::acceptor local;
    std::array<std::size_t, 2> clients{}; ///< by door
    std::string last_stranger;
};

bool HttpFace::Impl::is_stranger(const asio::local::stream_protocol::socket& /*socket*/) {
    return false; // the socket's mode and group have judged
}

/// Told once for each address that is not followed by another one.
bool HttpFace::Impl::is_stranger(const asio::ip::tcp::socket& socket) {
    if (config.allowed_clients.empty()) return false;
    boost::system::error_code gone;
    const auto remote = socket.remote_endpoint(gone);
    const std::string from = gone ? "" : remote.address().to_string();
    if (any_covers(config.allowed_clients, from)) return false;
    if (!from.empty() && std::exchange(last_stranger, from) != from)
        spdlog::warn("The console turned {} away: console.allowed_clients does not name it.", from);
    return true;
}

template <class Acceptor> Task<void> HttpFace::Impl::accept(Acceptor& acceptor, Door door) {
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
        if (clients[seat_of(door)] < client_limit) spawn(scheduler, serve(std::move(socket), door));
    }
}

template <class Socket> Task<void> HttpFace::Impl::serve(Socket socket, Door door) {
    const auto self = shared_from_this();
    const ClientSeat seat{clients[seat_of(door)]};
    const int descriptor = socket.native_handle();
    beast::basic_stream<typename Socket::protocol_type> stream{std::move(socket)};
    beast::flat_buffer buffer;
    for (bool alive = true; alive;) {
        http::request_parser<http::string_body> parser;
        parser.body_limit(body_limit);
        stream.expires_after(idle_limit);
        const auto [read_error, got] = co_await http::async_read(stream, buffer, parser, quiet);
        if (read_error) break;
        Response response = co_await respond_or_tell(parser.release(), door, descriptor);
        alive = response.keep_alive();
        stream.expires_after(idle_limit);
        const auto [write_error, sent] = co_await http::async_write(stream, response, quiet);
        if (write_error) break;
    }
}

/// What one request throws ends that request: the station goes on.
Task<Response> HttpFace::Impl::respond_or_tell(Request request, Door door, int descriptor) {
    std::string what;
    Request asked = request;
    try {
        co_return co_await respond(std::move(asked), door, descriptor);
    } catch (const std::exception& bug) {
        what = bug.what();
    }
    co_return answer(request, Error{Fault::internal, "This request ended with: " + what, {}, {}});
}

Task<Response> HttpFace::Impl::respond(Request request, Door door, int descriptor) {
    const AccessVerdict verdict = judge_access(head_of(request, door), rules);
    if (verdict.status != 200)
        co_return answer_in_words(request, static_cast<http::status>(verdict.status),
                                  verdict.sentence);
    if (request.method() == http::verb::post) {
        Orderer by;
        by.door = "token";
        if (door == Door::unix_socket) by = peer_of_socket(descriptor);
        co_return co_await change(std::move(request), std::move(by));
    }
    if (request.method() != http::verb::get)
        co_return answer_in_words(request, http::status::method_not_allowed,
                                  "GET reads, POST changes");
    if (request.target() == "/v1/alignment")
        co_return answer(request, http::status::ok, to_json(station.alignment()));
    const std::string_view target{request.target().data(), request.target().size()};
    if (target.substr(0, target.find('?')) == stream_path) {
        const auto points = stream_points_of(target);
        if (!points) co_return answer(request, points.error());
        co_return answer(request, http::status::ok, to_json(station.stream(*points)));
    }
    const StationStatus status = station.status();
    if (request.target() == "/v1/status")
        co_return answer(request, http::status::ok, to_json(status));
    if (request.target() == "/v1/instruments")
        co_return answer(request, http::status::ok, to_json(status)["instruments"]);
    if (request.target() == "/v1/preflight") {
        const auto checks = station.preflight({});
        if (!checks) co_return answer(request, checks.error());
        co_return answer(request, http::status::ok, {{"checks", to_json(*checks)}});
    }
    co_return answer_in_words(
        request, http::status::not_found,
        "known are GET /v1/status, GET /v1/instruments, GET "
        "/v1/preflight, GET /v1/alignment, GET /v1/stream, POST /v1/run, POST "
        "/v1/run/trigger, POST /v1/run/reading, POST /v1/run/abort, POST /v1/run/retake, POST "
        "/v1/run/exclude, POST /v1/preflight, POST /v1/alignment, POST "
        "/v1/drift");
}

Task<Response> HttpFace::Impl::change(Request request, Orderer by) {
    const std::string target{request.target()};
    if (target == "/v1/run") co_return co_await arm(std::move(request), std::move(by));
    if (target == "/v1/preflight") {
        const auto wanted = arm_request_from_json(request.body());
        if (!wanted) co_return answer(request, wanted.error());
        const auto checks = station.preflight(*wanted);
        if (!checks) co_return answer(request, checks.error());
        co_return answer(request, http::status::ok, {{"checks", to_json(*checks)}});
    }
    if (target == "/v1/run/retake" || target == "/v1/run/exclude")
        co_return co_await revise(std::move(request), std::move(by));
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
        co_return answer(request, http::status::ok, {{"run", "aborted"}});
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
        "/v1/run/retake, /v1/run/exclude, /v1/preflight, "
        "/v1/alignment, /v1/drift");
}

Task<Response> HttpFace::Impl::arm(Request request, Orderer by) {
    auto wanted = arm_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    ArmRequest order = *std::move(wanted);
    by.name = order.by.name;
    order.by = std::move(by);
    ArmRequest asked = order;
    const auto run = co_await station.arm(std::move(asked));
    if (!run && run.error().field == "preflight")
        co_return answer_with_checks(request, run.error(), station.preflight(order));
    if (!run) co_return answer(request, run.error());
    co_return answer(request, http::status::created, {{"run", *run}});
}

Task<Response> HttpFace::Impl::revise(Request request, Orderer by) {
    auto wanted = revision_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    RevisionRequest order = *std::move(wanted);
    by.name = order.by.name;
    order.by = std::move(by);
    if (request.target() == "/v1/run/retake") {
        const auto retake = co_await station.retake(std::move(order));
        if (!retake) co_return answer(request, retake.error());
        co_return answer(request, http::status::ok, to_json(*retake));
    }
    const auto excluded = co_await station.exclude(std::move(order));
    if (!excluded) co_return answer(request, excluded.error());
    co_return answer(request, http::status::ok, {{"excluded", *excluded}});
}

HttpFace::HttpFace(Scheduler& scheduler,
                   StationFace& station,
                   ConsoleConfig config,
                   std::string token)
    : impl_{std::make_shared<Impl>(scheduler, station, std::move(config), std::move(token))} {}

HttpFace::~HttpFace() {
    boost::system::error_code ignored;
    impl_->tcp.close(ignored);
    impl_->local.close(ignored);
    if (!impl_->config.socket_path.empty()) ::unlink(impl_->config.socket_path.c_str());
}

Result<void> HttpFace::start() {
    AXISCAL_CHECK(listen(impl_->local, impl_->config));
    AXISCAL_CHECK(listen(impl_->tcp, impl_->config));
    impl_->rules.known_hosts =
        known_hosts_of(impl_->config.host, impl_->config.port, impl_->config.allowed_hosts);
    if (impl_->local.is_open())
        spawn(impl_->scheduler, impl_->accept(impl_->local, Door::unix_socket));
    if (impl_->tcp.is_open()) spawn(impl_->scheduler, impl_->accept(impl_->tcp, Door::tcp));
    return {};
}

int HttpFace::port() const {
    return impl_->config.port;
}

} // namespace axiscal

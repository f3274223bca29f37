// Beast is heavy: this is the only file that includes it on the daemon's side.
#include "acquisition/console/http_face.hpp"

#include "acquisition/console/access.hpp"
#include "acquisition/console/alignment_json.hpp"
#include "acquisition/console/api_json.hpp"
#include "acquisition/console/drift_json.hpp"
#include "acquisition/console/listening.hpp"
#include "acquisition/console/stream_json.hpp"
#include "drivers/spawn.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>

#include <unistd.h>

namespace axiscal {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr auto quiet = asio::as_tuple(asio::use_awaitable);
constexpr auto idle_limit =
    std::chrono::seconds{30}; // a client that neither asks nor reads is let go
constexpr std::uint64_t body_limit = std::uint64_t{64} * 1024;
constexpr std::size_t client_limit = 64;

http::status status_of(Fault fault) {
    switch (fault) {
    case Fault::bad_request:
    case Fault::bad_configuration: return http::status::bad_request;
    case Fault::not_found: return http::status::not_found;
    case Fault::refused: return http::status::forbidden;
    case Fault::internal:
    case Fault::io:
    case Fault::not_durable: return http::status::internal_server_error;
    default: return http::status::conflict;
    }
}

Response answer(const Request& request, http::status status, const nlohmann::ordered_json& body) {
    Response response{status, request.version()};
    response.set(http::field::content_type, "application/json; charset=utf-8");
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(request.keep_alive());
    response.body() = body.dump() + "\n";
    response.prepare_payload();
    return response;
}

Response answer(const Request& request, const Error& error) {
    return answer(request, status_of(error.fault), to_json(error));
}

/// Arming met checks that do not hold: all of them at once.
Response answer_with_checks(const Request& request,
                            const Error& error,
                            const Result<std::vector<PreflightRecord>>& checks) {
    auto body = to_json(error);
    if (checks) body["checks"] = to_json(*checks);
    return answer(request, http::status::conflict, body);
}

nlohmann::ordered_json sentence(unsigned status, const std::string& text) {
    return {{"error",
             {{"fault", status == 404 || status == 405 ? "not_found" : "refused"},
              {"sentence", text}}}};
}

std::string field(const Request& request, http::field name) {
    const auto found = request.find(name);
    return found == request.end() ? std::string{} : std::string{found->value()};
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
    Task<Response> respond(Request request, Door door);
    Task<Response> change(Request request);
    Task<Response> arm(Request request);
    Task<Response> revise(Request request);

    Scheduler& scheduler;
    StationFace& station;
    ConsoleConfig config;
    AccessRules rules;
    asio::ip::tcp::acceptor tcp;
    asio::local::stream_protocol::acceptor local;
    std::size_t clients = 0;
};

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
        if (clients < client_limit) spawn(scheduler, serve(std::move(socket), door));
    }
}

template <class Socket> Task<void> HttpFace::Impl::serve(Socket socket, Door door) {
    const auto self = shared_from_this();
    ++clients;
    beast::basic_stream<typename Socket::protocol_type> stream{std::move(socket)};
    beast::flat_buffer buffer;
    for (bool alive = true; alive;) {
        http::request_parser<http::string_body> parser;
        parser.body_limit(body_limit);
        stream.expires_after(idle_limit);
        const auto [read_error, got] = co_await http::async_read(stream, buffer, parser, quiet);
        if (read_error) break;
        Response response = co_await respond(parser.release(), door);
        alive = response.keep_alive();
        stream.expires_after(idle_limit);
        const auto [write_error, sent] = co_await http::async_write(stream, response, quiet);
        if (write_error) break;
    }
    --clients;
}

Task<Response> HttpFace::Impl::respond(Request request, Door door) {
    RequestHead head;
    head.door = door;
    head.changes_state =
        request.method() != http::verb::get && request.method() != http::verb::head;
    head.host = field(request, http::field::host);
    head.origin = field(request, http::field::origin);
    head.authorization = field(request, http::field::authorization);
    const AccessVerdict verdict = judge_access(head, rules);
    if (verdict.status != 200)
        co_return answer(request, static_cast<http::status>(verdict.status),
                         sentence(verdict.status, verdict.sentence));
    if (request.method() == http::verb::post) co_return co_await change(std::move(request));
    if (request.method() != http::verb::get)
        co_return answer(request, http::status::method_not_allowed,
                         sentence(405, "GET reads, POST changes"));
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
    co_return answer(
        request, http::status::not_found,
        sentence(
            404,
            "known are GET /v1/status, GET /v1/instruments, GET "
            "/v1/preflight, GET /v1/alignment, GET /v1/stream, POST /v1/run, POST "
            "/v1/run/trigger, POST /v1/run/reading, POST /v1/run/abort, POST /v1/run/retake, POST "
            "/v1/run/exclude, POST /v1/preflight, POST /v1/alignment, POST "
            "/v1/drift"));
}

Task<Response> HttpFace::Impl::change(Request request) {
    const std::string target{request.target()};
    if (target == "/v1/run") co_return co_await arm(std::move(request));
    if (target == "/v1/preflight") {
        const auto wanted = arm_request_from_json(request.body());
        if (!wanted) co_return answer(request, wanted.error());
        const auto checks = station.preflight(*wanted);
        if (!checks) co_return answer(request, checks.error());
        co_return answer(request, http::status::ok, {{"checks", to_json(*checks)}});
    }
    if (target == "/v1/run/retake" || target == "/v1/run/exclude")
        co_return co_await revise(std::move(request));
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
        const auto reason = abort_reason_from_json(request.body());
        if (!reason) co_return answer(request, reason.error());
        const auto done = station.abort(*reason);
        if (!done) co_return answer(request, done.error());
        co_return answer(request, http::status::ok, {{"run", "aborted"}});
    }
    if (target == "/v1/drift") {
        auto wanted = drift_request_from_json(request.body());
        if (!wanted) co_return answer(request, wanted.error());
        DriftRequest order = *std::move(wanted);
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
    co_return answer(
        request, http::status::not_found,
        sentence(404, "known are POST /v1/run, /v1/run/trigger, /v1/run/reading, /v1/run/abort, "
                      "/v1/run/retake, /v1/run/exclude, /v1/preflight, "
                      "/v1/alignment, /v1/drift"));
}

Task<Response> HttpFace::Impl::arm(Request request) {
    auto wanted = arm_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    ArmRequest order = *std::move(wanted);
    ArmRequest asked = order;
    const auto run = co_await station.arm(std::move(asked));
    if (!run && run.error().field == "preflight")
        co_return answer_with_checks(request, run.error(), station.preflight(order));
    if (!run) co_return answer(request, run.error());
    co_return answer(request, http::status::created, {{"run", *run}});
}

Task<Response> HttpFace::Impl::revise(Request request) {
    auto wanted = revision_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    RevisionRequest order = *std::move(wanted);
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

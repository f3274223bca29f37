// Beast is heavy: this is the only file of the command line that includes it.
#include "tools/axiscal/station_client.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

namespace axiscal {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Request = http::request<http::string_body>;

constexpr auto longest_answer = std::chrono::seconds{60}; // arming waits for stillness and the disk

/// One question, one answer; every step shares one deadline.
template <class Protocol>
Result<Reply> exchange(const typename Protocol::endpoint& where, Request request) {
    asio::io_context loop;
    beast::basic_stream<Protocol> stream{loop};
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    beast::error_code failed = asio::error::timed_out;
    stream.expires_after(longest_answer);
    stream.async_connect(where, [&](beast::error_code connected) {
        if ((failed = connected)) return;
        http::async_write(stream, request, [&](beast::error_code written, std::size_t) {
            if ((failed = written)) return;
            http::async_read(stream, buffer, response,
                             [&](beast::error_code read, std::size_t) { failed = read; });
        });
    });
    loop.run();
    if (failed) return fail(Fault::io, "", failed);
    return Reply{response.result_int(), response.body()};
}

Result<asio::ip::tcp::endpoint> resolve(const std::string& host) {
    const auto colon = host.rfind(':');
    if (colon == std::string::npos)
        return fail(Fault::bad_request, "--host needs ADDRESS:PORT, as in 127.0.0.1:8470");
    asio::io_context loop;
    boost::system::error_code error;
    const auto found =
        asio::ip::tcp::resolver{loop}.resolve(host.substr(0, colon), host.substr(colon + 1), error);
    if (error || found.empty()) return fail(Fault::io, "cannot resolve " + host, error);
    return found.begin()->endpoint();
}

} // namespace

Result<Reply> StationClient::get(const std::string& target) const {
    return ask("GET", target, "");
}
Result<Reply> StationClient::post(const std::string& target, const std::string& body) const {
    return ask("POST", target, body);
}

Result<Reply> StationClient::ask(const std::string& method,
                                 const std::string& target,
                                 const std::string& body) const {
    Request request{http::string_to_verb(method), target, 11};
    request.set(http::field::host, address_.host.empty() ? "localhost" : address_.host);
    request.set(http::field::connection, "close");
    if (!address_.token.empty())
        request.set(http::field::authorization, "Bearer " + address_.token);
    request.body() = body;
    request.prepare_payload();
    Result<Reply> reply = fail(Fault::internal, "");
    std::string door = address_.socket_path;
    if (address_.host.empty()) {
        if (door.size() >= 108)
            return fail(Fault::bad_request, "the socket path " + door +
                                                " is longer than a socket allows (107 letters)");
        reply = exchange<asio::local::stream_protocol>(asio::local::stream_protocol::endpoint{door},
                                                       std::move(request));
    } else {
        door = address_.host;
        AXISCAL_TRY(const auto where, resolve(door));
        reply = exchange<asio::ip::tcp>(where, std::move(request));
    }
    if (reply) return reply;
    const std::error_code cause = reply.error().cause;
    const bool rights = cause == std::errc::permission_denied;
    return fail(
        Fault::io,
        rights ? "no right to open " + door +
                     "; is this user in the group axiscal? (sudo usermod -aG axiscal \"$USER\", "
                     "then log in again)"
               : "axiscald does not answer at " + door +
                     "; start it (sudo systemctl start axiscald) or name its door with --socket",
        cause);
}

} // namespace axiscal

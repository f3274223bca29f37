// Beast is heavy: this is the only file of the command line that includes it.
#include "tools/axiscal/station_client.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <iostream>
#include <vector>

namespace axiscal {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Request = http::request<http::string_body>;

using std::chrono::seconds;

constexpr seconds longest_connecting{10}; // of each address
constexpr seconds before_a_word{10};      // a person begins to wonder
/// A question is answered from what the station knows. An order to arm is answered once the axis
/// stands still and the disk has it: capture.timeout is at most 10 min.
constexpr seconds longest_question{60}, longest_order{11 * 60};

struct HostPort {
    std::string host, port;
};

/// "HOST:PORT" and "[IPV6]:PORT".
Result<HostPort> split_host(const std::string& written) {
    const auto colon = written.rfind(':');
    const bool bracketed = written.starts_with('[');
    if (bracketed && colon != std::string::npos && colon > 1 && written[colon - 1] == ']')
        return HostPort{written.substr(1, colon - 2), written.substr(colon + 1)};
    if (bracketed || colon == std::string::npos)
        return fail(Fault::bad_request, "--host " + written +
                                            ": it needs ADDRESS:PORT, as in 127.0.0.1:8470 or "
                                            "[::1]:8470");
    const std::string host = written.substr(0, colon), port = written.substr(colon + 1);
    if (host.find(':') == std::string::npos) return HostPort{host, port};
    boost::system::error_code none;
    asio::ip::make_address_v6(host, none);
    return fail(Fault::bad_request,
                "--host " + written + ": an IPv6 address stands in brackets; write it as " +
                    (none ? "[ADDRESS]:PORT, as in [::1]:8470" : "[" + host + "]:" + port));
}

/// How far a question came.
struct Exchange {
    bool connected = false;
    beast::error_code failed = beast::error::timeout;
    Reply reply;
};

/// One question, one answer. Who ends the program closes the connection: the station drops an order
/// that is not carried out yet.
template <class Protocol>
Exchange
exchange(const typename Protocol::endpoint& where, const Request& request, seconds patience) {
    asio::io_context loop;
    beast::basic_stream<Protocol> stream{loop};
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    Exchange talk;
    stream.expires_after(longest_connecting);
    stream.async_connect(where, [&](beast::error_code connected) {
        if ((talk.failed = connected)) return;
        talk.connected = true;
        stream.expires_after(patience);
        http::async_write(stream, request, [&](beast::error_code written, std::size_t) {
            if ((talk.failed = written)) return;
            talk.failed = beast::error::timeout;
            http::async_read(stream, buffer, response,
                             [&](beast::error_code read, std::size_t) { talk.failed = read; });
        });
    });
    loop.run_for(before_a_word);
    if (!loop.stopped() && talk.connected && request.method() == http::verb::post)
        std::cerr << "The station is still at work on this order; Ctrl-C gives it up.\n";
    loop.run();
    talk.reply = {response.result_int(), response.body()};
    return talk;
}

/// What a name stands for, in the order in which the system would have it tried.
Result<std::vector<asio::ip::tcp::endpoint>> resolve(const std::string& written) {
    AXISCAL_TRY(const HostPort parts, split_host(written));
    asio::io_context loop;
    boost::system::error_code error;
    std::vector<asio::ip::tcp::endpoint> ends;
    for (const auto& found : asio::ip::tcp::resolver{loop}.resolve(parts.host, parts.port, error))
        ends.push_back(found.endpoint());
    if (!error && !ends.empty()) return ends;
    return fail(Fault::io, "cannot resolve " + parts.host + " of --host " + written, error);
}

std::string shown(const asio::ip::tcp::endpoint& end) {
    const std::string address = end.address().to_string();
    return (end.address().is_v6() ? "[" + address + "]" : address) + ":" +
           std::to_string(end.port());
}

/// The question went out, and no answer came of it.
Error unanswered(const Exchange& talk,
                 const std::string& door,
                 const Request& request,
                 seconds patience) {
    const bool order = request.method() == http::verb::post;
    const std::string look =
        request.target() == "/v1/run" ? "the station may still be arming; axiscal watch shows it"
        : order ? "the station may still be at work on it; axiscal status shows it"
                : "it runs and is hung or very busy: journalctl -u axiscald";
    if (talk.failed != beast::error::timeout)
        return {Fault::io,
                "the connection to axiscald at " + door + " ended without an answer: " + look,
                talk.failed};
    return {Fault::io, "no answer after " + std::to_string(patience.count()) +
                           " s from axiscald at " + door + ": " + look};
}

Result<Reply> ask_socket(const std::string& path, const Request& request, seconds patience) {
    if (path.size() >= 108)
        return fail(Fault::bad_request,
                    "the socket path " + path + " is longer than a socket allows (107 letters)");
    const Exchange talk = exchange<asio::local::stream_protocol>(
        asio::local::stream_protocol::endpoint{path}, request, patience);
    if (!talk.failed) return talk.reply;
    if (talk.connected) return tl::unexpected<Error>(unanswered(talk, path, request, patience));
    const std::error_code cause = talk.failed;
    if (cause == std::errc::permission_denied)
        return fail(Fault::io,
                    "no right to open " + path +
                        "; is this user in the group axiscal? (sudo usermod -aG axiscal \"$USER\", "
                        "then log in again)",
                    cause);
    return fail(Fault::io,
                "axiscald does not answer at " + path +
                    "; start it (sudo systemctl start axiscald) or name its door with --socket",
                cause);
}

/// Tries one address after the other; an order is sent once, to the first that takes a connection.
Result<Reply> ask_host(const std::string& host, const Request& request, seconds patience) {
    AXISCAL_TRY(const auto ends, resolve(host));
    std::string tried;
    for (const auto& end : ends) {
        const Exchange talk = exchange<asio::ip::tcp>(end, request, patience);
        if (!talk.failed) return talk.reply;
        if (talk.connected) return tl::unexpected<Error>(unanswered(talk, host, request, patience));
        tried += (tried.empty() ? "" : ", ") + shown(end) + " (" + talk.failed.message() + ")";
    }
    return fail(Fault::io, "axiscald does not answer at " + host + ": tried " + tried +
                               "; start it there (sudo systemctl start axiscald), and see that "
                               "[console] host and port of its station file are these");
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
    const seconds usual = request.method() == http::verb::post ? longest_order : longest_question;
    const seconds patience = address_.patience.value_or(usual);
    return address_.host.empty() ? ask_socket(address_.socket_path, request, patience)
                                 : ask_host(address_.host, request, patience);
}

} // namespace axiscal

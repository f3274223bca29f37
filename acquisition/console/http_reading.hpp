#pragma once
// From bytes to one request, or to the answer that says why there is none (RFC 9110, 15.5).
// Private to the console.

#include "acquisition/console/http_answer.hpp"
#include "drivers/loop/scheduler.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace axiscal {

inline constexpr std::uint64_t body_limit = std::uint64_t{64} * 1024;
inline constexpr std::uint32_t head_limit = 8 * 1024;

/// One of them, or neither where the client has gone.
struct HttpAsked {
    std::optional<HttpRequest> request;
    std::optional<HttpResponse> refusal; ///< then the connection ends
};

enum class Beginning : std::uint8_t { too_short, request_line, none };
/// Whether bytes can begin a request: "GET /v1/status HTTP/1.1". Lets a client that speaks another
/// protocol hear so at once, instead of when its time is over. Pure.
Beginning judge_beginning(std::string_view bytes);

/// 400, 413, 417 or 431 for what the parser found; nothing where only the client ended.
std::optional<HttpResponse> refusal_of(const boost::system::error_code& error);
HttpResponse refuse_request(boost::beast::http::status status, const std::string& sentence);

/// Reads one request, also of a client that waits for "100 Continue" before it sends the body.
/// The stream's own time limit holds.
template <class Stream>
Task<HttpAsked> read_request(Stream& stream, boost::beast::flat_buffer& buffer) {
    namespace asio = boost::asio;
    namespace http = boost::beast::http;
    constexpr auto quietly = asio::as_tuple(asio::use_awaitable);
    const auto seen = [&buffer] {
        return judge_beginning({static_cast<const char*>(buffer.data().data()), buffer.size()});
    };
    while (seen() == Beginning::too_short) {
        const auto [error, got] = co_await stream.async_read_some(buffer.prepare(1024), quietly);
        buffer.commit(got);
        if (!error) continue;
        if (error == asio::error::eof && buffer.size() > 0)
            co_return HttpAsked{{}, refusal_of(http::error::partial_message)};
        co_return HttpAsked{};
    }
    if (seen() == Beginning::none) co_return HttpAsked{{}, refusal_of(http::error::bad_method)};
    http::request_parser<http::string_body> parser;
    parser.body_limit(body_limit);
    parser.header_limit(head_limit);
    const auto [head_error, head] =
        co_await http::async_read_header(stream, buffer, parser, quietly);
    if (head_error) co_return HttpAsked{{}, refusal_of(head_error)};
    const auto expected = parser.get()[http::field::expect];
    if (!expected.empty() && !boost::beast::iequals(expected, "100-continue"))
        co_return HttpAsked{{}, refuse_request(http::status::expectation_failed,
                                               "the station expects nothing but 100-continue")};
    if (!expected.empty() && !parser.is_done()) {
        http::response<http::empty_body> go_on{http::status::continue_, 11};
        const auto [error, sent] = co_await http::async_write(stream, go_on, quietly);
        if (error) co_return HttpAsked{};
    }
    const auto [body_error, body] = co_await http::async_read(stream, buffer, parser, quietly);
    if (body_error) co_return HttpAsked{{}, refusal_of(body_error)};
    co_return HttpAsked{parser.release(), {}};
}

/// Ends a connection so that the last answer arrives: what a client is still sending is read and
/// thrown away for a while. A close with unread bytes would reset, and the answer were lost.
template <class Stream> Task<void> end_gently(Stream& stream) {
    namespace asio = boost::asio;
    constexpr auto quietly = asio::as_tuple(asio::use_awaitable);
    constexpr std::size_t most = std::size_t{4} * 1024 * 1024;
    boost::system::error_code gone;
    stream.socket().shutdown(asio::socket_base::shutdown_send, gone);
    stream.expires_after(std::chrono::seconds{2});
    std::array<char, 4096> unwanted{};
    for (std::size_t thrown_away = 0; !gone && thrown_away < most;) {
        const auto [error, got] = co_await stream.async_read_some(asio::buffer(unwanted), quietly);
        if (error) co_return;
        thrown_away += got;
    }
}

} // namespace axiscal

#include "acquisition/tls/module/carried_client.hpp"

#include "acquisition/tls/module/first_byte.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <utility>

namespace axiscal::tls {
namespace {

namespace asio = boost::asio;

constexpr auto silent = asio::as_tuple(asio::use_awaitable);
constexpr std::size_t most_thrown_away = std::size_t{4} * 1024 * 1024;

/// The kernel is a queue, too: events must not grow old in it (event_hub.cpp). A socket that lets
/// nothing of this be set serves all the same.
void keep_little_on_the_way(int descriptor) {
    const int one = 1;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &one, sizeof one);
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
}

} // namespace

CarriedClient::CarriedClient(Socket client,
                             Plain plain,
                             std::shared_ptr<asio::ssl::context> certificate,
                             const TlsLimits& limits)
    : certificate_{std::move(certificate)}
    , tls_{std::move(client), *certificate_}
    , plain_{std::move(plain)}
    , limit_{plain_.get_executor()}
    , limits_{limits} {}

void CarriedClient::close() {
    boost::system::error_code ignored;
    tls_.next_layer().close(ignored);
    plain_.close(ignored);
}

/// Takes the place of an earlier limit.
void CarriedClient::close_after(std::chrono::milliseconds limit) {
    limit_.expires_after(limit);
    limit_.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
        const auto self = weak.lock();
        if (error || !self) return;
        self->late_ = true;
        self->close();
    });
}

asio::awaitable<std::string> CarriedClient::carry() {
    const auto self = shared_from_this();
    close_after(limits_.handshake);
    std::string complaint = co_await greet();
    if (complaint.empty() && tls_.next_layer().is_open()) {
        limit_.cancel();
        keep_little_on_the_way(tls_.next_layer().native_handle());
        asio::co_spawn(tls_.get_executor(), carry_in(self), asio::detached);
        co_await carry_out();
    }
    limit_.cancel();
    close();
    co_return complaint;
}

/// A connection without a byte is no complaint: so looks who watches whether the port is open.
asio::awaitable<std::string> CarriedClient::greet() {
    Socket& client = tls_.next_layer();
    const auto [error] = co_await client.async_wait(Socket::wait_read, silent);
    unsigned char byte = 0;
    if (error || ::recv(client.native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) != 1) {
        close();
        co_return std::string{};
    }
    const FirstByte first = judge_first_byte(byte);
    if (first == FirstByte::handshake) co_return co_await shake_hands();
    if (first == FirstByte::http) co_await answer_in_clear();
    co_return std::string{first == FirstByte::http ? "it spoke HTTP without TLS"
                                                   : "what it sent was no TLS"};
}

asio::awaitable<std::string> CarriedClient::shake_hands() {
    const auto [error] = co_await tls_.async_handshake(asio::ssl::stream_base::server, silent);
    if (!error) co_return std::string{};
    // The alert that says why is on its way; a close with unread bytes would take it back.
    const bool too_late = late_; // the farewell has a limit, too
    if (!too_late) co_await throw_away_the_rest();
    if (too_late) co_return std::string{"its TLS handshake took too long"};
    if (error == asio::error::eof || error == asio::ssl::error::stream_truncated ||
        error == asio::error::connection_reset)
        co_return std::string{"it ended its TLS handshake without a reason"};
    co_return "its TLS handshake failed: " + error.message();
}

asio::awaitable<void> CarriedClient::answer_in_clear() {
    const std::string words = answer_without_tls();
    const auto [error, sent] =
        co_await asio::async_write(tls_.next_layer(), asio::buffer(words), silent);
    if (!error) co_await throw_away_the_rest();
}

/// From the client to the program, until either has ended that.
asio::awaitable<void> CarriedClient::carry_in(std::shared_ptr<CarriedClient> /*self*/) {
    while (!leaving_) {
        const auto [error, got] = co_await tls_.async_read_some(asio::buffer(in_), silent);
        const bool over = error == asio::error::eof ||
                          error == asio::ssl::error::stream_truncated; // half of it, or all
        if (error && !over && !leaving_) close();
        if (error) break;
        const auto [gone, sent] =
            co_await asio::async_write(plain_, asio::buffer(in_.data(), got), silent);
        if (gone) co_return;
    }
    boost::system::error_code ignored;
    plain_.shutdown(Plain::shutdown_send, ignored); // the program sees that the client has gone
}

/// From the program to the client, until the program ends it.
asio::awaitable<void> CarriedClient::carry_out() {
    for (;;) {
        const auto [end, got] = co_await plain_.async_read_some(asio::buffer(out_), silent);
        if (end) break;
        close_after(limits_.taking);
        const auto [gone, sent] =
            co_await asio::async_write(tls_, asio::buffer(out_.data(), got), silent);
        limit_.cancel();
        if (gone) co_return;
    }
    if (tls_.next_layer().is_open()) co_await say_farewell();
}

/// So that the last answer arrives, as end_gently() of the console. async_shutdown() sends the
/// alert "close_notify" and then waits for that of the client; where more of a request comes
/// instead it is at its end, and the rest is thrown away unread.
asio::awaitable<void> CarriedClient::say_farewell() {
    leaving_ = true;
    close_after(limits_.farewell);
    boost::system::error_code ignored;
    tls_.next_layer().cancel(ignored); // carry_in() reads no longer
    const auto [error] = co_await tls_.async_shutdown(silent);
    if (error && !late_) co_await throw_away_the_rest();
}

asio::awaitable<void> CarriedClient::throw_away_the_rest() {
    Socket& client = tls_.next_layer();
    boost::system::error_code gone;
    client.shutdown(Socket::shutdown_send, gone);
    close_after(limits_.farewell);
    for (std::size_t thrown_away = 0; !gone && thrown_away < most_thrown_away;) {
        const auto [error, got] = co_await client.async_read_some(asio::buffer(in_), silent);
        if (error) break;
        thrown_away += got;
    }
}

} // namespace axiscal::tls

#pragma once
// One client: TLS on its side, clear bytes on the program's. On the loop of the module.

#include "acquisition/tls/tls_interface.hpp"

#include <boost/asio/awaitable.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/steady_timer.hpp>

#include <array>
#include <memory>
#include <string>

namespace axiscal::tls {

class CarriedClient : public std::enable_shared_from_this<CarriedClient> {
public:
    using Socket = boost::asio::generic::stream_protocol::socket;
    using Plain = boost::asio::local::stream_protocol::socket;
    using Tell = std::function<void(TlsTold)>;

    CarriedClient(Socket client,
                  Plain plain,
                  std::shared_ptr<boost::asio::ssl::context> certificate,
                  const TlsLimits& limits);

    /// To the end of the connection. @returns why it was turned away; empty: it spoke TLS, or came
    /// and went without a byte
    boost::asio::awaitable<std::string> carry();

private:
    template <class T> using Awaitable = boost::asio::awaitable<T>;
    using Buffer = std::array<char, std::size_t{8} * 1024>;

    Awaitable<std::string> greet();
    Awaitable<std::string> shake_hands();
    Awaitable<void> answer_in_clear();
    Awaitable<void> carry_in(std::shared_ptr<CarriedClient> self); // runs beside, and may outlast
    Awaitable<void> carry_out();
    Awaitable<void> say_farewell();
    Awaitable<void> throw_away_the_rest();
    void close_after(std::chrono::milliseconds limit);
    void close();

    std::shared_ptr<boost::asio::ssl::context> certificate_;
    boost::asio::ssl::stream<Socket> tls_;
    Plain plain_;
    boost::asio::steady_timer limit_;
    const TlsLimits& limits_;
    Buffer in_{}, out_{};
    bool late_ = false;    ///< a limit has ended it
    bool leaving_ = false; ///< the program has said all; nothing more is taken from the client
};

} // namespace axiscal::tls

#pragma once
// A client of TLS that trusts one certificate, and plain sockets beside it. Each call blocks, for
// ten seconds at most.

#include "tests/unit/tls/made_certificate.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/write.hpp>

#include <array>
#include <memory>
#include <string>
#include <sys/socket.h>
#include <utility>

namespace axiscal::test {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp::socket;

inline void bound(Tcp& socket) {
    timeval limit{10, 0}; // only bounds a failing test
    ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
}

/// What comes until `text` has come, or the connection ends.
template <class Stream> std::string heard_until(Stream& stream, const std::string& text) {
    std::string heard;
    std::array<char, 4096> bytes{};
    boost::system::error_code error;
    while (!error && heard.find(text) == std::string::npos)
        heard.append(bytes.data(), stream.read_some(asio::buffer(bytes), error));
    return heard;
}
inline constexpr const char* to_the_end = "\n\n\n never";

class TlsClient {
public:
    /// @param at  of 127.0.0.1. Throws where it does not trust what it finds.
    TlsClient(unsigned short at, const std::string& trusted)
        : stream_{loop_, context_of(trusted)} {
        stream_.next_layer().connect({asio::ip::make_address("127.0.0.1"), at});
        bound(stream_.next_layer());
        stream_.set_verify_callback(asio::ssl::host_name_verification("localhost"));
        stream_.handshake(asio::ssl::stream_base::client);
    }
    void say(const std::string& words) { asio::write(stream_, asio::buffer(words)); }
    std::string until(const std::string& text) { return heard_until(stream_, text); }
    std::string protocol() { return SSL_get_version(stream_.native_handle()); }
    boost::system::error_code next_error() {
        char byte = 0;
        boost::system::error_code error;
        stream_.read_some(asio::buffer(&byte, 1), error);
        return error;
    }
    Tcp& socket() { return stream_.next_layer(); }

private:
    asio::ssl::context& context_of(const std::string& trusted) {
        context_.set_verify_mode(asio::ssl::verify_peer);
        context_.add_certificate_authority(asio::buffer(trusted));
        return context_;
    }
    asio::io_context loop_;
    asio::ssl::context context_{asio::ssl::context::tls_client};
    asio::ssl::stream<Tcp> stream_;
};

/// The greeting of a client that knows nothing newer than TLS 1.1.
inline std::string hello_of_tls_1_1() {
    std::string body{"\x03\x02", 2};
    body += std::string(32, 'r') + std::string{"\0\0\x04\xc0\x13\x00\x2f\x01\0", 9};
    const auto size = static_cast<char>(body.size());
    const auto whole = static_cast<char>(body.size() + 4);
    return std::string{"\x16\x03\x01\0", 4} + whole + std::string{"\x01\0\0", 3} + size + body;
}

} // namespace axiscal::test

#pragma once
// Client and server of a row on loopback, by system calls alone. Benchmarks only.

#include "tests/support/raw_modbus_client.hpp"

#include <arpa/inet.h>
#include <array>
#include <cstdlib>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace axiscal::bench {

inline int listening_socket(int& port) {
    const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        ::listen(listener, 1) != 0)
        std::abort();
    ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    port = ntohs(address.sin_port);
    return listener;
}

inline void send_at_once(int connection) {
    const int yes = 1;
    ::setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

/// Servers live to the end of the program: what waits costs nothing.
template <class Server> int start(Server server) {
    int port = 0;
    const int listener = listening_socket(port);
    std::thread{std::move(server), listener}.detach();
    return port;
}

/// Waits in recv like a controller, and spins on nothing.
class Client {
public:
    explicit Client(int port)
        : connection_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (::connect(connection_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
            std::abort();
        send_at_once(connection_);
    }
    /// @returns the reply, which has `reply_size` bytes.
    std::array<std::uint8_t, 256> ask(const testing::Bytes& request, std::size_t reply_size) const {
        ::send(connection_, request.data(), request.size(), MSG_NOSIGNAL);
        std::array<std::uint8_t, 256> reply{};
        for (std::size_t taken = 0; taken < reply_size;) {
            const auto count = ::recv(connection_, reply.data() + taken, reply.size() - taken, 0);
            if (count <= 0) std::abort();
            taken += static_cast<std::size_t>(count);
        }
        return reply;
    }

private:
    int connection_;
};

} // namespace axiscal::bench

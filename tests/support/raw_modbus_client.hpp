#pragma once
// A Modbus client that can misbehave: bytes go out as given. Loopback only. Tests only.

#include <array>
#include <cerrno>
#include <cstdint>
#include <netinet/in.h>
#include <span>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace axiscal::testing {

using Bytes = std::vector<std::uint8_t>;

/// MBAP header before a PDU, unit 1.
inline Bytes framed(std::uint16_t transaction, const Bytes& pdu) {
    const auto length = static_cast<std::uint16_t>(pdu.size() + 1);
    Bytes frame{
        static_cast<std::uint8_t>(transaction >> 8), static_cast<std::uint8_t>(transaction), 0, 0,
        static_cast<std::uint8_t>(length >> 8),      static_cast<std::uint8_t>(length),      1};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    return frame;
}

class RawModbusClient {
public:
    explicit RawModbusClient(int port, int receive_buffer = 0)
        : socket_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
        if (receive_buffer > 0)
            ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("cannot connect to the port under test");
    }
    RawModbusClient(RawModbusClient&& other) noexcept
        : received{std::move(other.received)}
        , hung_up{other.hung_up}
        , socket_{std::exchange(other.socket_, -1)} {}
    RawModbusClient& operator=(RawModbusClient&&) = delete;
    ~RawModbusClient() {
        if (socket_ >= 0) ::close(socket_);
    }

    /// @returns bytes taken by the kernel: fewer when its buffers are full
    std::size_t send(std::span<const std::uint8_t> bytes) {
        const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        return sent < 0 ? 0 : static_cast<std::size_t>(sent);
    }
    /// Moves what has arrived into `received`; notices the end of the connection.
    void receive() {
        std::array<std::uint8_t, 4096> buffer{};
        for (;;) {
            const auto length = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
            if (length == 0 || (length < 0 && errno != EAGAIN)) hung_up = true;
            if (length <= 0) return;
            received.insert(received.end(), buffer.begin(), buffer.begin() + length);
        }
    }
    Bytes received;
    bool hung_up = false;

private:
    int socket_;
};

} // namespace axiscal::testing

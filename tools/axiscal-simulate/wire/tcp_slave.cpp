#include "wire/tcp_slave.hpp"

#include "wire/client_poll.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal::simulate {

namespace {
constexpr std::size_t header_bytes = 7;
/// MBAP length: unit and PDU of at most 253 bytes.
constexpr std::size_t longest = 254;
} // namespace

TcpSlave::TcpSlave(int listener, int port, Answer answer)
    : listener_{listener}
    , port_{port}
    , answer_{std::move(answer)} {}

TcpSlave::~TcpSlave() {
    for (const auto& [socket, pending] : clients_)
        ::close(socket);
    ::close(listener_);
}

Result<std::unique_ptr<TcpSlave>> TcpSlave::listen(int port, Answer answer) {
    const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const int yes = 1;
    ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    if (listener < 0 || ::bind(listener, plain, size) != 0 || ::listen(listener, 8) != 0 ||
        ::getsockname(listener, plain, &size) != 0) {
        const std::error_code cause{errno, std::generic_category()};
        if (listener >= 0) ::close(listener);
        return fail(Fault::io, "can not listen on 127.0.0.1:" + std::to_string(port), cause);
    }
    return std::unique_ptr<TcpSlave>{
        new TcpSlave{listener, ntohs(address.sin_port), std::move(answer)}};
}

void TcpSlave::accept_one() {
    const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket >= 0) clients_.try_emplace(socket);
}

void TcpSlave::close_client(int socket) {
    ::close(socket);
    clients_.erase(socket);
}

/// Reads what is there and answers each whole frame; false: the client is gone or speaks nonsense.
bool TcpSlave::serve(int socket, Bytes& pending) {
    std::uint8_t chunk[512];
    const ssize_t n = ::recv(socket, chunk, sizeof chunk, 0);
    if (n == 0 || (n < 0 && errno != EAGAIN)) return false;
    if (n > 0) pending.insert(pending.end(), chunk, chunk + n);
    while (pending.size() >= header_bytes) {
        const std::size_t length = pending[4] * 256U + pending[5];
        if (length < 2 || length > longest || pending[2] != 0 || pending[3] != 0) return false;
        if (pending.size() < 6 + length) break;
        const auto transaction = static_cast<std::uint16_t>(pending[0] * 256 + pending[1]);
        const auto pdu = std::span{pending}.subspan(header_bytes, length - 1);
        const int unit = pending[6];
        const Bytes answer = answer_(unit, pdu);
        if (!answer.empty()) {
            const Bytes frame = tcp_frame(transaction, unit, answer);
            if (::send(socket, frame.data(), frame.size(), MSG_NOSIGNAL) < 0) return false;
        }
        pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(6 + length));
    }
    return true;
}

void TcpSlave::run(const std::stop_token& stop, const std::function<void()>& idle) {
    while (!stop.stop_requested()) {
        std::vector<pollfd> waits{{listener_, POLLIN, 0}};
        for (const auto& [socket, pending] : clients_)
            waits.push_back({socket, POLLIN, 0});
        ::poll(waits.data(), waits.size(), client_poll_ms);
        if (idle) idle();
        if (waits[0].revents != 0) accept_one();
        for (std::size_t i = 1; i < waits.size(); ++i)
            if (waits[i].revents != 0 && !serve(waits[i].fd, clients_[waits[i].fd]))
                close_client(waits[i].fd);
    }
}

} // namespace axiscal::simulate

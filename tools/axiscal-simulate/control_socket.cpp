#include "control_socket.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace axiscal::simulate {

namespace {
constexpr int look_ms = 50;

/// Takes what has come and answers each whole line; false: the client is gone.
bool serve_client(int socket, std::string& typed, const ControlSocket::Obey& obey) {
    char chunk[1024];
    const ssize_t n = ::recv(socket, chunk, sizeof chunk, 0);
    if (n <= 0) return false;
    typed.append(chunk, static_cast<std::size_t>(n));
    for (auto end = typed.find('\n'); end != std::string::npos; end = typed.find('\n')) {
        const std::string answer = obey(typed.substr(0, end)) + "\n";
        typed.erase(0, end + 1);
        if (::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0)
            return false;
    }
    return true;
}
} // namespace

Result<ControlSocket> ControlSocket::listen(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path)
        return fail(Fault::refused, "the control socket's path is too long: " + path);
    std::memcpy(address.sun_path, path.c_str(), path.size());
    std::error_code ignored;
    if (std::filesystem::is_socket(path, ignored)) std::filesystem::remove(path, ignored);
    const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ControlSocket socket{listener, path};
    if (listener < 0 ||
        ::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listener, 4) != 0) {
        socket.path_.clear(); // what stands there is not ours
        return fail(Fault::io, "the control socket " + path + " can not be made",
                    {errno, std::generic_category()});
    }
    return socket;
}

ControlSocket::ControlSocket(ControlSocket&& other) noexcept
    : listener_{std::exchange(other.listener_, -1)}
    , path_{std::exchange(other.path_, "")} {}

ControlSocket::~ControlSocket() {
    if (listener_ >= 0) ::close(listener_);
    if (!path_.empty()) ::unlink(path_.c_str());
}

void ControlSocket::serve(const std::stop_token& stop, const Obey& obey) const {
    std::map<int, std::string> clients;
    while (!stop.stop_requested()) {
        std::vector<pollfd> waits{{listener_, POLLIN, 0}};
        for (const auto& [socket, typed] : clients)
            waits.push_back({socket, POLLIN, 0});
        if (::poll(waits.data(), waits.size(), look_ms) <= 0) continue;
        for (std::size_t i = 1; i < waits.size(); ++i)
            if (waits[i].revents != 0 && !serve_client(waits[i].fd, clients[waits[i].fd], obey)) {
                ::close(waits[i].fd);
                clients.erase(waits[i].fd);
            }
        if (waits[0].revents == 0) continue;
        const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
        if (socket >= 0) clients.try_emplace(socket);
    }
    for (const auto& [socket, typed] : clients)
        ::close(socket);
}

} // namespace axiscal::simulate

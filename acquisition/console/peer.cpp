#include "acquisition/console/peer.hpp"

#include <cstdio>
#include <memory>
#include <poll.h>
#include <pwd.h>
#include <sys/socket.h>

namespace axiscal {

std::string user_name_of(std::int64_t uid, const std::string& passwd) {
    const auto close = [](std::FILE* file) { std::fclose(file); };
    const std::unique_ptr<std::FILE, decltype(close)> file{std::fopen(passwd.c_str(), "re"), close};
    if (!file) return {};
    ::passwd entry{};
    ::passwd* found = nullptr;
    std::string texts(4096, '\0'); // of one line; a longer one ends the search
    while (::fgetpwent_r(file.get(), &entry, texts.data(), texts.size(), &found) == 0)
        if (found->pw_uid == uid) return found->pw_name;
    return {};
}

Orderer peer_of_socket(int descriptor) {
    Orderer by;
    by.door = "socket";
    ucred peer{};
    socklen_t size = sizeof peer;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return by;
    by.uid = peer.uid;
    by.user = user_name_of(peer.uid);
    return by;
}

bool has_hung_up(int descriptor) {
    pollfd look{descriptor, POLLRDHUP, 0}; // errors and a full hang-up are told unasked
    return ::poll(&look, 1, 0) > 0;
}

} // namespace axiscal

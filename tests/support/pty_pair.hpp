#pragma once
// A pseudo-terminal: the test holds the master, the code under test opens `path`.

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <string_view>
#include <termios.h>
#include <unistd.h>

namespace axiscal::testing {

class PtyPair {
public:
    PtyPair()
        : master_{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)} {
        ::grantpt(master_);
        ::unlockpt(master_);
        char name[128] = {};
        ::ptsname_r(master_, name, sizeof name);
        path = name;
        make_raw();
    }
    ~PtyPair() { unplug(); }
    PtyPair(const PtyPair&) = delete;
    PtyPair& operator=(const PtyPair&) = delete;

    void send(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t count = ::write(master_, bytes.data(), bytes.size());
            if (count <= 0) return;
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    /// Exactly `size` bytes, or fewer when nothing comes for `patience_ms`.
    std::string receive(std::size_t size, int patience_ms = 5000) {
        std::string bytes;
        while (bytes.size() < size) {
            pollfd readable{master_, POLLIN, 0};
            if (::poll(&readable, 1, patience_ms) != 1) break;
            char buffer[256];
            const ssize_t count =
                ::read(master_, buffer, std::min(sizeof buffer, size - bytes.size()));
            if (count <= 0) break;
            bytes.append(buffer, static_cast<std::size_t>(count));
        }
        return bytes;
    }
    void unplug() {
        if (master_ >= 0) ::close(master_);
        master_ = -1;
    }
    [[nodiscard]] int master() const { return master_; }

    std::string path;

private:
    /// Without this the line discipline would echo and translate until somebody opens the slave.
    void make_raw() const {
        termios line{};
        ::tcgetattr(master_, &line);
        ::cfmakeraw(&line);
        ::tcsetattr(master_, TCSANOW, &line);
    }
    int master_;
};

} // namespace axiscal::testing

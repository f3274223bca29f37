#include "wire/pty.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace axiscal::simulate {

namespace {

/// 64 KiB are about as much of a laser at 1 kHz.
constexpr auto patience = std::chrono::milliseconds{1500};

std::error_code last_error() {
    return {errno, std::generic_category()};
}

Result<void> link_to(const std::string& target, const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::symlink_status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_symlink(status))
        return fail(Fault::refused, path + " exists and is no symlink; choose another path");
    std::filesystem::remove(path, error);
    std::filesystem::create_symlink(target, path, error);
    if (error) return fail(Fault::io, "the symlink " + path + " can not be made", error);
    return {};
}

} // namespace

Result<Pty> Pty::open(const std::string& link_path) {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (master < 0) return fail(Fault::io, "no pseudo terminal for " + link_path, last_error());
    char name[128] = {};
    const bool ready = ::grantpt(master) == 0 && ::unlockpt(master) == 0 &&
                       ::ptsname_r(master, name, sizeof name) == 0;
    const int slave = ready ? ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC) : -1;
    Pty pty{master, slave, ""}; // closes both on the way out
    termios mode{};
    if (slave < 0 || ::tcgetattr(slave, &mode) != 0)
        return fail(Fault::io, "no slave of the pseudo terminal for " + link_path, last_error());
    ::cfmakeraw(&mode);
    ::tcsetattr(slave, TCSANOW, &mode);
    auto linked = link_to(name, link_path);
    if (!linked) return tl::unexpected<Error>(linked.error());
    pty.link_ = link_path;
    return pty;
}

Pty::Pty(Pty&& other) noexcept
    : master_{std::exchange(other.master_, -1)}
    , slave_{std::exchange(other.slave_, -1)}
    , link_{std::exchange(other.link_, "")}
    , rest_{std::move(other.rest_)}
    , gone_{other.gone_}
    , largest_rest_{other.largest_rest_}
    , dropped_{other.dropped_}
    , lines_dropped_{other.lines_dropped_}
    , stuck_since_{other.stuck_since_} {}

Pty::~Pty() {
    if (slave_ >= 0) ::close(slave_);
    if (master_ >= 0) ::close(master_);
    if (!link_.empty()) ::unlink(link_.c_str());
}

/// Writes as much as the line takes; false when it takes nothing. What was written is not cut off
/// each time: of megabytes that wait for a late reader that would cost more than the reader takes.
bool Pty::flush_rest() {
    bool took = false;
    for (ssize_t n = 1; n > 0 && !rest().empty();) {
        n = ::write(master_, rest().data(), rest().size());
        if (n <= 0) break;
        gone_ += static_cast<std::size_t>(n);
        took = true;
    }
    if (gone_ >= rest_.size() / 2) {
        rest_.erase(0, gone_);
        gone_ = 0;
    }
    return took;
}

void Pty::drop() {
    ++dropped_;
    lines_dropped_ += static_cast<std::uint64_t>(std::ranges::count(rest(), '\n'));
    ::tcflush(slave_, TCIFLUSH);
    rest_.clear();
    gone_ = 0;
    stuck_since_.reset();
}

void Pty::write(std::string_view record) {
    rest_ += record;
    if (flush_rest()) return stuck_since_.reset();
    const auto now = std::chrono::steady_clock::now();
    if (!stuck_since_) stuck_since_ = now;
    if (rest().size() > largest_rest_ || now - *stuck_since_ >= patience) drop();
}

std::string Pty::read(std::chrono::milliseconds wait) {
    pollfd poll{master_, POLLIN, 0};
    if (::poll(&poll, 1, static_cast<int>(wait.count())) <= 0) return {};
    std::string bytes(4096, '\0');
    const ssize_t n = ::read(master_, bytes.data(), bytes.size());
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return bytes;
}

} // namespace axiscal::simulate

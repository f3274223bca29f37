#include "drivers/wire/descriptor_link.hpp"

#include "drivers/loop/deadline.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <cerrno>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// A pty hands over at most 4 KiB a read; a socket may have more.
constexpr std::size_t largest_read = 16384;

bool means_try_again(int error_number) {
    return error_number == EAGAIN || error_number == EINTR;
}

} // namespace

DescriptorLink::DescriptorLink(Scheduler& scheduler, int descriptor, DescriptorKind kind)
    : scheduler_{scheduler}
    , kind_{std::move(kind)}
    , buffer_(largest_read)
    , descriptor_{scheduler.executor(), descriptor}
    , reading_{scheduler, [this] { descriptor_.cancel(); }} {}

DescriptorLink::~DescriptorLink() {
    // A pty that somebody else keeps open would stay exclusive.
    if (!kind_.is_socket) ::ioctl(descriptor_.native_handle(), TIOCNXCL);
    if (kind_.close) kind_.close(descriptor_.release());
}

Task<boost::system::error_code> DescriptorLink::readiness(WaitType what) {
    const auto [error] =
        co_await descriptor_.async_wait(what, boost::asio::as_tuple(boost::asio::use_awaitable));
    co_return error;
}

Task<Result<void>> DescriptorLink::writable(MonotonicTime deadline) {
    const auto error = co_await before(scheduler_, readiness(WaitType::wait_write), deadline);
    if (!error) co_return silent();
    if (*error) co_return fail(Fault::link_closed, kind_.name, *error);
    co_return Result<void>{};
}

tl::unexpected<Error> DescriptorLink::silent() const {
    return fail(Fault::link_timeout, "nothing moved on " + kind_.name);
}

tl::unexpected<Error> DescriptorLink::closed(int error_number) const {
    return fail(Fault::link_closed, kind_.name,
                error_number ? std::error_code{error_number, std::generic_category()}
                             : std::error_code{});
}

Task<Result<TimedBytes>> DescriptorLink::read_some(MonotonicTime deadline) {
    for (;;) {
        reading_.begin(deadline);
        const auto error = co_await readiness(WaitType::wait_read);
        // What came while the host stalled is read, however late it is.
        const bool late = reading_.end();
        if (error && !late) co_return fail(Fault::link_closed, kind_.name, error);
        const ssize_t count = ::read(descriptor_.native_handle(), buffer_.data(), buffer_.size());
        const int error_number = errno;
        const MonotonicTime read_at = scheduler_.now();
        if (count > 0) {
            const std::span read{buffer_.data(), static_cast<std::size_t>(count)};
            TimedBytes arrived{kind_.parity_is_marked ? marks_.undo(read)
                                                      : std::vector(read.begin(), read.end()),
                               read_at};
            if (arrived.bytes.empty()) continue; // a mark has begun
            co_return arrived;
        }
        // End of file, and EIO of a tty whose other end is gone, are one thing: unplugged.
        if (count == 0) co_return closed(0);
        if (!means_try_again(error_number)) co_return closed(error_number);
        if (late) co_return silent();
    }
}

Task<Result<void>> DescriptorLink::write_all(std::vector<std::byte> bytes, MonotonicTime deadline) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const int handle = descriptor_.native_handle();
        const std::size_t rest = bytes.size() - done;
        const ssize_t count = kind_.is_socket
                                  ? ::send(handle, bytes.data() + done, rest, MSG_NOSIGNAL)
                                  : ::write(handle, bytes.data() + done, rest);
        if (count >= 0) {
            done += static_cast<std::size_t>(count);
            continue;
        }
        if (!means_try_again(errno)) co_return closed(errno);
        const auto ready = co_await writable(deadline);
        if (!ready) co_return ready;
    }
    co_return Result<void>{};
}

} // namespace axiscal

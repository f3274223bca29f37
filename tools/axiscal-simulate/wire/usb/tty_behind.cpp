#include "wire/usb/tty_behind.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace axiscal::simulate {

Result<TtyBehind> TtyBehind::open(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return fail(Fault::io, "nothing stands behind the adapter at " + path,
                    {errno, std::generic_category()});
    termios line{};
    if (::tcgetattr(descriptor, &line) == 0) {
        ::cfmakeraw(&line);
        ::tcsetattr(descriptor, TCSANOW, &line);
    }
    return TtyBehind{descriptor};
}

TtyBehind::TtyBehind(TtyBehind&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)} {}

TtyBehind::~TtyBehind() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool TtyBehind::has_bytes() const {
    int count = 0;
    return ::ioctl(descriptor_, FIONREAD, &count) == 0 && count > 0;
}

Bytes TtyBehind::read(std::size_t most) const {
    Bytes bytes(most);
    const ssize_t n = ::read(descriptor_, bytes.data(), bytes.size());
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return bytes;
}

void TtyBehind::write(std::span<const std::uint8_t> bytes) const {
    // A face that does not listen loses what is said to it, as a wire would.
    [[maybe_unused]] const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
}

void TtyBehind::flush() const {
    ::tcflush(descriptor_, TCIFLUSH);
}

} // namespace axiscal::simulate

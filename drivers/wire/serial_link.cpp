#include "drivers/wire/serial_link.hpp"

#include "drivers/wire/descriptor_link.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

namespace axiscal {
namespace {

struct BaudRow {
    int baud;
    speed_t code;
};
constexpr std::array baud_rows{
    BaudRow{1200, B1200},       BaudRow{2400, B2400},       BaudRow{4800, B4800},
    BaudRow{9600, B9600},       BaudRow{19200, B19200},     BaudRow{38400, B38400},
    BaudRow{57600, B57600},     BaudRow{115200, B115200},   BaudRow{230400, B230400},
    BaudRow{460800, B460800},   BaudRow{500000, B500000},   BaudRow{921600, B921600},
    BaudRow{1000000, B1000000}, BaudRow{2000000, B2000000}, BaudRow{3000000, B3000000},
};

/// Closes the descriptor unless it was handed on.
class OwnedDescriptor {
public:
    explicit OwnedDescriptor(int descriptor)
        : descriptor_{descriptor} {}
    ~OwnedDescriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    OwnedDescriptor(const OwnedDescriptor&) = delete;
    OwnedDescriptor& operator=(const OwnedDescriptor&) = delete;
    [[nodiscard]] int get() const { return descriptor_; }
    int release() { return std::exchange(descriptor_, -1); }

private:
    int descriptor_;
};

std::error_code last_error() {
    return {errno, std::generic_category()};
}

tcflag_t character_size(int data_bits) {
    switch (data_bits) {
    case 5: return CS5;
    case 6: return CS6;
    case 7: return CS7;
    default: return CS8;
    }
}

/// Raw: no echo, no translation, no flow control, no signals from bytes. VMIN 1 keeps "nothing
/// there" apart from end of file on a non-blocking descriptor. Where there is a parity it is
/// checked: for a text without a checksum it is the only check.
bool make_raw(int descriptor, const LinkSettings& settings, speed_t speed) {
    termios line{};
    if (::tcgetattr(descriptor, &line) != 0) return false;
    ::cfmakeraw(&line);
    line.c_cflag &= ~static_cast<tcflag_t>(CSIZE | PARENB | PARODD | CSTOPB | CRTSCTS);
    line.c_cflag |= character_size(settings.data_bits) | CLOCAL | CREAD;
    if (settings.parity != 'N') line.c_cflag |= PARENB;
    if (settings.parity != 'N') line.c_iflag |= INPCK | PARMRK;
    if (settings.parity == 'O') line.c_cflag |= PARODD;
    if (settings.stop_bits == 2) line.c_cflag |= CSTOPB;
    line.c_iflag &= ~static_cast<tcflag_t>(IXOFF | IXANY | IGNPAR);
    line.c_cc[VMIN] = 1;
    line.c_cc[VTIME] = 0;
    if (::cfsetispeed(&line, speed) != 0 || ::cfsetospeed(&line, speed) != 0) return false;
    return ::tcsetattr(descriptor, TCSANOW, &line) == 0;
}

/// Some interfaces take their power from the modem lines. A pty has none: nothing to set there.
bool set_modem_line(int descriptor, int line, std::optional<bool> high) {
    if (!high) return true;
    const bool set = ::ioctl(descriptor, *high ? TIOCMBIS : TIOCMBIC, &line) == 0;
    return set || errno == ENOTTY || errno == EINVAL;
}

/// A pty lives on with its other end: where a program that was killed had made it exclusive, nobody
/// but root opens it again. A serial port forgets that when it is closed.
bool is_pty(int tty) {
    constexpr unsigned first_major = 136, majors = 8; // UNIX98_PTY_SLAVE_MAJOR on
    struct stat status {};
    return ::fstat(tty, &status) == 0 && major(status.st_rdev) - first_major < majors;
}

DescriptorKind kind_of(const LinkSettings& settings) {
    DescriptorKind kind;
    kind.name = settings.describe();
    kind.parity_is_marked = settings.parity != 'N';
    const auto timer_ms = usb_latency_timer_ms(settings.path);
    if (!timer_ms || *timer_ms <= 1) return kind;
    kind.latency_uncertainty = std::chrono::milliseconds{*timer_ms - 1};
    kind.remark = settings.path + ": the USB adapter holds bytes back for up to " +
                  std::to_string(*timer_ms) +
                  " ms instead of 1 ms; install the udev rule, or write 1 to its latency_timer";
    return kind;
}

} // namespace

std::optional<int> usb_latency_timer_ms(const std::string& tty_path, const std::string& sysfs) {
    std::error_code error;
    const auto device = std::filesystem::canonical(tty_path, error);
    if (error) return std::nullopt;
    const std::string name = device.filename().string();
    std::ifstream file{sysfs + "/bus/usb-serial/devices/" + name + "/latency_timer"};
    int timer_ms = 0;
    if (!(file >> timer_ms)) return std::nullopt;
    return timer_ms;
}

Result<int> open_tty(const LinkSettings& settings) {
    const std::string name = settings.describe();
    const auto speed = std::ranges::find(baud_rows, settings.baud, &BaudRow::baud);
    if (speed == baud_rows.end())
        return fail(Fault::bad_configuration, name + ": this baud rate is not known here");
    OwnedDescriptor tty{::open(settings.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    if (tty.get() < 0) return fail(Fault::link_closed, "cannot open " + name, last_error());
    if (::isatty(tty.get()) != 1) return fail(Fault::link_closed, name + " is not a serial line");
    if (::flock(tty.get(), LOCK_EX | LOCK_NB) != 0)
        return fail(Fault::link_closed,
                    name + " is in use by another program, or its adapter has not let go of it yet",
                    last_error());
    if (!is_pty(tty.get())) ::ioctl(tty.get(), TIOCEXCL); // best effort: root passes it anyway
    if (!make_raw(tty.get(), settings, speed->code))
        return fail(Fault::link_closed, name + " refuses these line settings", last_error());
    const bool powered = set_modem_line(tty.get(), TIOCM_DTR, settings.dtr) &&
                         set_modem_line(tty.get(), TIOCM_RTS, settings.rts);
    if (!powered && errno == EIO) // the transfer failed: of its lines that says nothing
        return fail(Fault::link_timeout, name + ": the adapter does not take its settings");
    if (!powered)
        return fail(Fault::link_closed, name + " has no modem lines to power it", last_error());
    // What waited in the kernel before has no honest arrival time.
    ::tcflush(tty.get(), TCIFLUSH);
    return tty.release();
}

Task<Result<std::unique_ptr<ByteLink>>> open_serial(Scheduler& scheduler,
                                                    std::shared_ptr<SerialOpener> serial_opener,
                                                    LinkSettings settings,
                                                    MonotonicTime deadline) {
    TtyOpener opener = [settings] { return open_tty(settings); };
    const auto tty = co_await serial_opener->open(scheduler, std::move(opener), deadline);
    if (!tty) co_return tl::unexpected<Error>(tty.error());
    DescriptorKind kind = kind_of(settings);
    kind.close = [serial_opener](int descriptor) { serial_opener->close(descriptor); };
    co_return std::make_unique<DescriptorLink>(scheduler, *tty, std::move(kind));
}

} // namespace axiscal

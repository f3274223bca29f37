#include "wire/usb/vhci_port.hpp"

#include "wire/usb/urb_server.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal::simulate {

namespace {

/// Writes one line to an attribute of the virtual controller; 0 or errno.
int tell_controller(const std::string& attribute, const std::string& line) {
    const std::string path = "/sys/devices/platform/vhci_hcd.0/" + attribute;
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const int failed = ::write(file, line.data(), line.size()) < 0 ? errno : 0;
    ::close(file);
    return failed;
}

/// The kernel frees a socket some 0.5 s after detaching.
int attach_with_patience(const std::string& line) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{5};
    int failed = tell_controller("attach", line);
    while (failed == EBUSY && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
        failed = tell_controller("attach", line);
    }
    return failed;
}

} // namespace

VhciPort::VhciPort(int port, std::string name, std::unique_ptr<UsbDevice> device)
    : UsbCarrier{std::move(name), std::move(device)}
    , port_{port} {}

Result<void> VhciPort::plug() {
    if (plugged()) unplug();
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return fail(Fault::io, "no socket pair", {errno, std::generic_category()});
    constexpr int any_bus = 0x10001; // a device number of the far side, never 0
    const int speed = static_cast<int>(device().descriptors().speed);
    const std::string line = std::to_string(port_) + " " + std::to_string(ends[0]) + " " +
                             std::to_string(any_bus + port_) + " " + std::to_string(speed);
    const int failed = attach_with_patience(line);
    ::close(ends[0]); // the kernel holds its own reference
    if (failed != 0) {
        ::close(ends[1]);
        return fail(Fault::io,
                    name() + " can not be plugged into socket " + std::to_string(port_) +
                        " of vhci_hcd; is the module loaded, and is this root?",
                    {failed, std::generic_category()});
    }
    start_pump(std::jthread{[this, socket = ends[1]](const std::stop_token& stop) {
        UrbServer{device(), faults()}.serve(socket, stop);
        ::close(socket);
    }});
    return {};
}

void VhciPort::unplug() {
    if (!plugged()) return;
    tell_controller("detach", std::to_string(port_));
    stop_pump();
}

} // namespace axiscal::simulate

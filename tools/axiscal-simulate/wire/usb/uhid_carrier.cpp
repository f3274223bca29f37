// Source: Linux 6.1, Documentation/hid/uhid.rst and <linux/uhid.h>.
#include "wire/usb/uhid_carrier.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

namespace axiscal::simulate {

namespace {

bool tell(int channel, const uhid_event& event) {
    return ::write(channel, &event, sizeof event) == static_cast<ssize_t>(sizeof event);
}

template <std::size_t size> void put_text(std::uint8_t (&field)[size], const std::string& text) {
    std::memcpy(field, text.data(), std::min(text.size(), size - 1));
}

uhid_event creation(const UsbDescriptors& device, const HidInterface& interface) {
    uhid_event event{};
    event.type = UHID_CREATE2;
    uhid_create2_req& made = event.u.create2;
    put_text(made.name, device.name.empty() ? "axiscal-simulate" : device.name);
    put_text(made.uniq, device.serial);
    made.bus = BUS_USB;
    made.vendor = device.vendor;
    made.product = device.product;
    made.version = device.release;
    const std::size_t size = std::min(interface.report_descriptor.size(), sizeof made.rd_data);
    made.rd_size = static_cast<std::uint16_t>(size);
    std::memcpy(made.rd_data, interface.report_descriptor.data(), size);
    return event;
}

/// An output report comes with its number before it, which is 0 where reports have none.
std::span<const std::uint8_t> without_number(const std::uint8_t* data, std::size_t size) {
    const std::span report{data, size};
    return !report.empty() && report[0] == 0 ? report.subspan(1) : report;
}

/// Reports that the host asks for by a request: there are none.
void refuse(int channel, std::uint32_t type, std::uint32_t id) {
    uhid_event reply{};
    reply.type = type;
    if (type == UHID_GET_REPORT_REPLY) {
        reply.u.get_report_reply.id = id;
        reply.u.get_report_reply.err = EIO;
    } else {
        reply.u.set_report_reply.id = id;
        reply.u.set_report_reply.err = EIO;
    }
    tell(channel, reply);
}

} // namespace

void UhidCarrier::listen(const HidInterface& interface, int channel) {
    uhid_event event{};
    if (::read(channel, &event, sizeof event) <= 0) return;
    if (event.type == UHID_OUTPUT && faults().fault() != UsbFault::mute)
        give_report(device(), interface, without_number(event.u.output.data, event.u.output.size));
    if (event.type == UHID_GET_REPORT)
        refuse(channel, UHID_GET_REPORT_REPLY, event.u.get_report.id);
    if (event.type == UHID_SET_REPORT)
        refuse(channel, UHID_SET_REPORT_REPLY, event.u.set_report.id);
}

void UhidCarrier::serve(const HidInterface& interface, int channel, const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        pollfd wait{channel, POLLIN, 0};
        ::poll(&wait, 1, static_cast<int>(device().pace().count()));
        if ((wait.revents & POLLIN) != 0) listen(interface, channel);
        for (;;) {
            const Bytes report = next_report(device(), faults(), interface);
            if (report.empty()) break;
            uhid_event said{};
            said.type = UHID_INPUT2;
            said.u.input2.size = static_cast<std::uint16_t>(report.size());
            std::memcpy(said.u.input2.data, report.data(), report.size());
            tell(channel, said);
        }
    }
}

Result<void> UhidCarrier::plug() {
    unplug();
    const auto interfaces = hid_interfaces(device());
    if (interfaces.empty()) return fail(Fault::bad_request, name() + " is no HID device");
    const int channel = ::open("/dev/uhid", O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (channel < 0 || !tell(channel, creation(device().descriptors(), interfaces.back()))) {
        const std::error_code why{errno, std::generic_category()};
        if (channel >= 0) ::close(channel);
        return fail(Fault::io,
                    name() + " can not be made by /dev/uhid; is the module uhid loaded, "
                             "and is this root?",
                    why);
    }
    device().plugged();
    start_pump(
        std::jthread{[this, interface = interfaces.back(), channel](const std::stop_token& stop) {
            serve(interface, channel, stop);
            ::close(channel); // the kernel takes the device away
        }});
    return {};
}

} // namespace axiscal::simulate

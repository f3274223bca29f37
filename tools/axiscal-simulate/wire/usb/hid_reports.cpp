#include "wire/usb/hid_reports.hpp"

namespace axiscal::simulate {

namespace {

constexpr std::uint8_t hid_class = 3, in_bit = 0x80;

} // namespace

std::vector<HidInterface> hid_interfaces(UsbDevice& device) {
    constexpr std::uint8_t from_interface = 0x81, get_descriptor = 6;
    constexpr std::uint16_t report_type = 0x2200, longest = 4096;
    std::vector<HidInterface> found;
    std::uint8_t number = 0;
    for (const UsbInterface& interface : device.descriptors().interfaces) {
        if (interface.its_class == hid_class && !interface.endpoints.empty()) {
            const UsbEndpoint& endpoint = interface.endpoints.front();
            HidInterface one;
            one.number = number;
            one.endpoint = static_cast<std::uint8_t>(endpoint.address & ~in_bit);
            one.subclass = interface.subclass;
            one.protocol = interface.protocol;
            one.longest_report = endpoint.largest_packet;
            const UsbSetup asked{from_interface, get_descriptor, report_type, number, longest};
            one.report_descriptor = device.control(asked, {}).bytes;
            found.push_back(std::move(one));
        }
        ++number;
    }
    return found;
}

void give_report(UsbDevice& device,
                 const HidInterface& interface,
                 std::span<const std::uint8_t> report) {
    constexpr std::uint8_t class_to_interface = 0x21, set_report = 9;
    constexpr std::uint16_t output_report = 0x0200;
    const auto length = static_cast<std::uint16_t>(report.size());
    device.control({class_to_interface, set_report, output_report, interface.number, length},
                   report);
}

Bytes next_report(UsbDevice& device, const UsbFaults& faults, const HidInterface& interface) {
    if (faults.fault() == UsbFault::mute || faults.fault() == UsbFault::stall) return {};
    UsbAnswer answer = device.in(interface.endpoint, interface.longest_report);
    if (answer.how != UsbAnswer::How::done) return {};
    return faults.spoil(std::move(answer)).bytes;
}

} // namespace axiscal::simulate

#pragma once
// The HID interfaces of a model, where the kernel carries reports and not transfers.

#include "wire/usb/usb_faults.hpp"

namespace axiscal::simulate {

/// One interface (HID 1.11): the model answers to SET_REPORT, and on its interrupt endpoint.
struct HidInterface {
    std::uint8_t number = 0, endpoint = 0, subclass = 0, protocol = 0;
    std::uint16_t longest_report = 0; ///< bytes
    Bytes report_descriptor = {};
};

/// In their order; none for a model of another class.
std::vector<HidInterface> hid_interfaces(UsbDevice& device);
/// An output report of the host, without a number before it.
void give_report(UsbDevice& device,
                 const HidInterface& interface,
                 std::span<const std::uint8_t> report);
/// The next input report as the faults leave it; empty while there is none. A device that is mute
/// or stalls has none.
Bytes next_report(UsbDevice& device, const UsbFaults& faults, const HidInterface& interface);

} // namespace axiscal::simulate

#pragma once
// Which USB device is meant, and which of those plugged in it is. Reads sysfs only: the kernel
// asked the devices when they were plugged in, so a silent one holds nothing up for long.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

/// One way in which a kind of instrument shows itself on USB.
struct UsbId {
    std::uint16_t vendor = 0, product = 0; ///< product 0: any
    std::string name = {};                 ///< product string; empty: any
    int device_class = -1;                 ///< bDeviceClass; -1: any
};

struct UsbPlace {
    std::vector<UsbId> ids;  ///< one of them fits
    std::string serial = {}; ///< as the device tells it to the kernel; empty: any
    std::string port = {};   ///< socket as the kernel names it ("1-2.4"); empty: any
    int interface = 0;       ///< the one to be used; -1: the last
    int nth = -1;            ///< of several that fit, by port, from 0; -1: there may be only one
    [[nodiscard]] std::string describe() const; ///< "USB 0cd5:0006 serial number 470012345"
    /// Fault::link_closed in the one sentence that a missing device has, however it was missed: a
    /// log then tells it once.
    [[nodiscard]] tl::unexpected<Error> absence() const;
};

/// What the kernel knows of one device that is plugged in.
struct UsbEntry {
    std::uint16_t vendor = 0, product = 0;
    int device_class = 0, bus = 0, address = 0;
    std::string port, name, serial;
    [[nodiscard]] std::string describe() const; ///< "USB 0cd5:0006 port 1-2.4"
};

/// By port. `sysfs` is another folder in tests.
std::vector<UsbEntry> list_usb(const std::string& sysfs = "/sys");

/// This very device, not plugged in anew, is there.
bool is_plugged(const UsbEntry& entry);

/// The one device that is meant.
/// @errors Fault::link_closed when none fits (or fewer than `nth` + 1); bad_configuration when
/// several do and none is chosen, naming each with what tells it apart.
Result<UsbEntry> choose_usb(const UsbPlace& place, const std::vector<UsbEntry>& plugged);

} // namespace axiscal

#pragma once
// HID devices: those on USB, and those whose reports a program carries (/dev/uhid). Reads sysfs
// only.

#include "drivers/wire/usb_place.hpp"

namespace axiscal {

/// As list_usb, and the HID devices behind which there is no USB socket. The port of such a one is
/// the kernel's own name for it, "0003:413D:2107.0005", of which the last part is new each time.
/// `sysfs` is another folder in tests.
std::vector<UsbEntry> list_hid(const std::string& sysfs = "/sys");

/// The highest number among the interfaces of the device in this USB socket that call themselves
/// HID, whether the kernel serves them or not; -1 where there is none, and where there is no USB.
int last_hid_interface(const std::string& port, const std::string& sysfs = "/sys");

/// This very device, not plugged in anew, is there.
bool is_hid_plugged(const UsbEntry& entry);

} // namespace axiscal

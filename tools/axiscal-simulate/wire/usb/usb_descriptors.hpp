#pragma once
// Standard requests of USB 2.0, chapter 9: what every device answers in the same way. Pure.

#include "wire/usb/usb_device.hpp"

#include <optional>

namespace axiscal::simulate {

/// 18 bytes (clause 9.6.1); max packet of endpoint 0 is 64.
Bytes device_descriptor(const UsbDescriptors& device);
/// Configuration 1 with all its interfaces (9.6.3, 9.6.5, 9.6.6); bus-powered, 100 mA.
Bytes configuration_descriptor(const UsbDescriptors& device);
/// String `index` in UTF-16LE (9.6.7): 0 the languages, 1 maker, 2 name, 3 serial number.
Bytes string_descriptor(const std::string& ascii);

/// The answer to a standard request; empty where the request is the device's own.
std::optional<UsbAnswer> standard_answer(const UsbDescriptors& device, const UsbSetup& setup);

} // namespace axiscal::simulate

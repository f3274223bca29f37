#pragma once
// A serial port by USB's own class for it: the kernel's cdc_acm makes /dev/ttyACMn of it. So speak
// the µMD2 counter (a Teensy) and the Dracal VCP sticks.

#include "wire/usb/usb_kinds.hpp"

namespace axiscal::simulate {

/// Settings: behind (the terminal of a wire face), vendor and product (hexadecimal), maker, name,
/// serial. Default: the Teensy of a µMD2, 16c0:0483.
Result<std::unique_ptr<UsbDevice>> make_cdc_acm(const UsbWish& wish, const UsbWorld& world);

} // namespace axiscal::simulate

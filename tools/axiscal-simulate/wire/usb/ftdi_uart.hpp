#pragma once
// FTDI's FT232R, the chip of most RS-232 and RS-485 adapters: the kernel's ftdi_sio makes
// /dev/ttyUSBn of it. It holds bytes back until 62 are there or its latency timer (16 ms unless the
// host sets another) runs out.

#include "wire/usb/usb_kinds.hpp"

namespace axiscal::simulate {

/// Settings: behind (the terminal of a wire face), serial.
Result<std::unique_ptr<UsbDevice>> make_ftdi_uart(const UsbWish& wish, const UsbWorld& world);

} // namespace axiscal::simulate

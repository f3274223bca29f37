#pragma once
// Opening a serial line: raw, exclusive, as the station file says. Works on ptys. Loop-bound.

#include "drivers/link/byte_link.hpp"

#include <optional>

namespace axiscal {

/// @errors Fault::link_closed when the device is missing, in use elsewhere, no tty, or cannot have
/// these line settings.
Result<std::unique_ptr<ByteLink>> open_serial(Scheduler& scheduler, const LinkSettings& settings);

/// How long the USB adapter of `tty_path` holds bytes back, in ms, as sysfs tells for FTDI chips;
/// empty for other adapters. `sysfs` is a parameter for tests only.
std::optional<int> usb_latency_timer_ms(const std::string& tty_path,
                                        const std::string& sysfs = "/sys");

} // namespace axiscal

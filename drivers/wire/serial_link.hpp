#pragma once
// Opening a serial line: raw, held alone, as the station file says. Works on ptys.

#include "drivers/wire/serial_opener.hpp"

#include <optional>

namespace axiscal {

/// Opens the line and sets it up. Blocks as long as its adapter makes the kernel wait: not for the
/// loop.
/// @errors Fault::link_closed when the device is missing, in use elsewhere, no tty, or cannot have
/// these line settings.
Result<int> open_tty(const LinkSettings& settings);

/// The same on the thread of the serial opener, as a link that closes there, too. Loop-bound.
/// @errors of open_tty; Fault::link_timeout when the kernel is not done at the deadline.
Task<Result<std::unique_ptr<ByteLink>>> open_serial(Scheduler& scheduler,
                                                    std::shared_ptr<SerialOpener> serial_opener,
                                                    LinkSettings settings,
                                                    MonotonicTime deadline);

/// How long the USB adapter of `tty_path` holds bytes back, in ms, as sysfs tells for FTDI chips;
/// empty for other adapters. `sysfs` is a parameter for tests only.
std::optional<int> usb_latency_timer_ms(const std::string& tty_path,
                                        const std::string& sysfs = "/sys");

} // namespace axiscal

#pragma once
// A HID device as a link of reports: one read gives one input report, one write sends one output
// report. By hidapi. Loop-bound; calls that block happen on a thread of `threads`.

#include "drivers/loop/work_thread.hpp"
#include "drivers/wire/byte_link.hpp"

namespace axiscal {

/// The device of `settings.usb` (kind hid) whose HID interface is `usb.interface`.
/// Unnumbered reports: the bytes are the payload, in both directions.
/// `scheduler` is borrowed and must outlive the link.
/// @errors as `choose_usb`; Fault::io without the right to open it, or where the kernel serves no
/// such interface.
Task<Result<std::unique_ptr<ByteLink>>>
open_hid(Scheduler& scheduler, WorkThreads& threads, UsbPlace place, MonotonicTime deadline);

} // namespace axiscal

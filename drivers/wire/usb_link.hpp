#pragma once
// A USB device by its transfers: control requests and bulk endpoints, each with a deadline and with
// the time of arrival. Loop-bound.

#include "drivers/loop/work_thread.hpp"
#include "drivers/wire/byte_link.hpp"

namespace axiscal {

/// The setup packet of a control transfer (USB 2.0, clause 9.3).
struct UsbRequest {
    int request_type = 0xC0; ///< 0xC0: vendor, device, to the host
    int request = 0, value = 0, index = 0, length = 0;
};

class UsbLink {
public:
    virtual ~UsbLink() = default;
    /// Whatever the device answers, perhaps nothing, at most `length` bytes.
    /// @errors, of all transfers: Fault::link_timeout at the deadline (the device says NAK or is
    /// silent), link_closed when it is gone, refused when it answers with STALL, bad_frame when it
    /// sends more than was asked for, io for anything else.
    virtual Task<Result<TimedBytes>> control_in(UsbRequest request, MonotonicTime deadline) = 0;
    virtual Task<Result<void>>
    bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) = 0;
    /// One transfer of at most `longest` bytes; `endpoint` with bit 7.
    virtual Task<Result<TimedBytes>>
    bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) = 0;
    /// The next transfer of a stream. From the first call on they are read ahead and stamped off
    /// the loop, so that a loop that stalls loses neither bytes nor times; any other call ends the
    /// reading ahead. At most 1000 wait: then the device is left to its own buffer.
    virtual Task<Result<TimedBytes>>
    next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) = 0;
    /// As the device told the kernel when it was plugged in; may be empty.
    [[nodiscard]] virtual const UsbEntry& entry() const = 0;
};

/// Opens by libusb. Finding, opening and transfers happen on a thread of `threads`.
/// `scheduler` is borrowed and must outlive the link.
Task<Result<std::unique_ptr<UsbLink>>>
open_usb_device(Scheduler& scheduler, WorkThreads& threads, UsbPlace place, MonotonicTime deadline);

} // namespace axiscal

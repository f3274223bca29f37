#pragma once
// A device that is not there is waited for by the kernel's word (inotify on the folders of its
// node), not by looking again and again. Loop-bound.

#include "drivers/wire/byte_link.hpp"

namespace axiscal {

enum class Arrival : std::uint8_t {
    came,       ///< it was not there and is now; who may use it is another matter
    not_yet,    ///< `latest` passed
    cannot_tell ///< it is there already, or nothing would tell: a network, a CAN bus
};

/// Serial: the path, whose folders may come and go (/dev/serial/by-id). USB and HID: a device that
/// fits the place, told by a new node below /dev.
Task<Arrival> await_arrival(Scheduler& scheduler, LinkSettings settings, MonotonicTime latest);

/// When to try again what could not be opened.
struct RetryTimes {
    MonotonicTime usual;  ///< where nobody hears of what is plugged in
    MonotonicTime latest; ///< where somebody does
};

/// What a LinkOpener is besides when it hears of what is plugged in.
class PlugListener {
public:
    virtual ~PlugListener() = default;
    /// After an opening that failed. Where nothing is there and its coming is heard of, that is as
    /// soon as it comes, at `latest` in any case; else at `usual`.
    /// @returns it came
    virtual Task<bool>
    worth_another_try(Scheduler& scheduler, LinkSettings settings, RetryTimes times) = 0;
};

/// What the LinkOpener of an instrument is besides when it wants to know which line of its
/// modbus_buses() was found closed: a driver of one tells it.
class ClosedLineListener {
public:
    virtual ~ClosedLineListener() = default;
    virtual void missed(const LinkSettings& settings) = 0;
};

} // namespace axiscal

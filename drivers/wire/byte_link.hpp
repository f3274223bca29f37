#pragma once
// Bytes in and out with their arrival time; a deadline on every call. Loop-bound.

#include "drivers/loop/scheduler.hpp"
#include "drivers/wire/usb_place.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

class CanLink;
class ModbusBuses;
class UsbLink;

struct TimedBytes {
    std::vector<std::byte> bytes;
    MonotonicTime read_at; ///< taken right after the read returned, before any parsing
};

class ByteLink {
public:
    virtual ~ByteLink() = default;
    /// Whatever has arrived, at least one byte.
    /// @errors Fault::link_timeout at the deadline, Fault::link_closed at end of file or unplug.
    virtual Task<Result<TimedBytes>> read_some(MonotonicTime deadline) = 0;
    virtual Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime deadline) = 0;
    /// How much later than assumed bytes may be handed over (FTDI latency timer beyond 1 ms).
    [[nodiscard]] virtual Duration latency_uncertainty() const { return {}; }
    /// What a person should know of this link; empty when all is as it should be.
    [[nodiscard]] virtual std::string remark() const { return {}; }
};

/// Where a link leads, as the station file says it.
struct LinkSettings {
    enum class Kind : std::uint8_t {
        serial,
        tcp,
        usb,
        hid,
        can,
        counter,
        files
    } kind = Kind::serial;
    /// serial: /dev/serial/by-id/...; can: the interface, can0; counter: the device, /dev/counter0;
    /// files: the folder in which they are
    std::string path;
    int baud = 115200;
    char parity = 'N';
    int data_bits = 8, stop_bits = 1;
    std::optional<bool> dtr,
        rts; ///< modem lines that power an interface; empty: as the kernel does
    std::string host;
    int port = 0;
    UsbPlace usb; ///< usb, hid
    /// counter: what is to be told, as <linux/counter.h> has it: component type, scope, parent, id;
    /// event; channel
    std::array<std::uint8_t, 6> watch{};
    /// "serial /dev/ttyACM0 115200 8N1" | "tcp host:port" | "USB 0cd5:0006 port 1-2" | "CAN can0" |
    /// "counter /dev/counter0" | "files below /sys/bus/w1/devices"
    [[nodiscard]] std::string describe() const;
};

/// Opens links; a tape player or recorder stands in without the driver noticing.
class LinkOpener {
public:
    virtual ~LinkOpener() = default;
    virtual Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings& settings,
                                                         MonotonicTime deadline) = 0;
    /// A USB device that speaks in transfers of its own. `open` gives HID reports as bytes, and the
    /// texts of files as file_link.hpp tells.
    /// @errors as `choose_usb`; Fault::link_closed where there is no USB; busy while it is in use.
    virtual Task<Result<std::unique_ptr<UsbLink>>> open_usb(const LinkSettings& settings,
                                                            MonotonicTime deadline);
    /// A CAN bus, for an instrument among others on it.
    /// @errors Fault::link_closed where there is no CAN, or the interface is missing, down or
    /// bus-off.
    virtual Task<Result<std::unique_ptr<CanLink>>> open_can(const LinkSettings& settings,
                                                            MonotonicTime deadline);
    /// The Modbus lines behind this opener; null where there are none (tapes).
    [[nodiscard]] virtual ModbusBuses* modbus_buses() { return nullptr; }
};

} // namespace axiscal

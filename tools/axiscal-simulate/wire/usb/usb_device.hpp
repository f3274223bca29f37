#pragma once
// A simulated USB device, as the host's controller sees it through the plug. A model answers
// transfers; who carries them (vhci_hcd, uhid) and which faults they meet is not its business.
// All of one device happens on one thread.

#include "analysis/quantity/result.hpp"

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace axiscal::simulate {

using Bytes = std::vector<std::uint8_t>;

enum class UsbSpeed : std::uint8_t { full = 2, high = 3 }; ///< as vhci_hcd counts them
enum class UsbTransfer : std::uint8_t { bulk = 2, interrupt = 3 };

struct UsbEndpoint {
    std::uint8_t address = 0; ///< with bit 7 for IN
    UsbTransfer transfer = UsbTransfer::bulk;
    std::uint16_t largest_packet = 64; ///< bytes; bulk: 64 at full speed, 512 at high speed
    std::uint8_t interval = 0;
};
struct UsbInterface {
    std::uint8_t its_class = 0xFF, subclass = 0, protocol = 0;
    Bytes class_descriptors = {}; ///< stand between the interface and its endpoints: HID, CDC
    std::vector<UsbEndpoint> endpoints = {};
    std::uint8_t alternate = 0; ///< above 0: another setting of the interface before it
};
/// What the device says of itself at enumeration (USB 2.0, clause 9.6).
struct UsbDescriptors {
    UsbSpeed speed = UsbSpeed::full;
    std::uint16_t vendor = 0, product = 0;
    std::uint16_t release = 0x0100; ///< bcdDevice; ftdi_sio tells chips apart by it
    std::uint8_t its_class = 0, subclass = 0, protocol = 0;
    std::string maker = {}, name = {}, serial = {}; ///< ASCII; empty: the device has no such string
    std::vector<UsbInterface> interfaces = {};
};

/// The eight bytes of a setup packet (USB 2.0, clause 9.3).
struct UsbSetup {
    std::uint8_t request_type = 0, request = 0;
    std::uint16_t value = 0, index = 0, length = 0;
    [[nodiscard]] bool to_host() const { return (request_type & 0x80) != 0; }
};

/// How a transfer ends: with bytes (none for OUT), with STALL, or not yet (the device says NAK).
struct UsbAnswer {
    enum class How { done, stall, hold } how = How::done;
    Bytes bytes = {};
    static UsbAnswer done(Bytes bytes = {}) { return {How::done, std::move(bytes)}; }
    static UsbAnswer stall() { return {How::stall, {}}; }
    static UsbAnswer hold() { return {How::hold, {}}; }
};

class UsbDevice {
public:
    UsbDevice() = default;
    virtual ~UsbDevice() = default;
    UsbDevice(const UsbDevice&) = delete;
    UsbDevice& operator=(const UsbDevice&) = delete;

    [[nodiscard]] virtual const UsbDescriptors& descriptors() const = 0;
    /// Power comes on: a fresh device. Called at every plugging-in, before any transfer.
    virtual void plugged() {}
    /// Requests on endpoint 0. Device, configuration and string descriptors, SET_CONFIGURATION,
    /// SET_INTERFACE, feature and status requests are answered elsewhere; class, vendor, and
    /// descriptors of a class (HID report: type 0x22) come here. `data` is empty for IN requests.
    /// A held request is asked again.
    virtual UsbAnswer control(const UsbSetup& setup, std::span<const std::uint8_t> data) = 0;
    /// Bytes for an OUT endpoint (its number, without direction bit); done() takes them all.
    virtual UsbAnswer out(std::uint8_t endpoint, std::span<const std::uint8_t> data);
    /// At most `most` bytes of an IN endpoint (its number, without direction bit); hold() while
    /// there are none. Whatever is given ends the host's transfer, as a short packet does: a model
    /// whose packets are full waits until it can fill `most`, as the wire would.
    virtual UsbAnswer in(std::uint8_t endpoint, std::size_t most);

    /// When this descriptor is readable, held transfers are asked again; -1: only by pace().
    [[nodiscard]] virtual int wake_descriptor() const { return -1; }
    /// Held transfers are asked again at least this often, where nothing wakes them.
    [[nodiscard]] virtual std::chrono::milliseconds pace() const {
        return std::chrono::milliseconds{5};
    }
    /// What the host has set (line speed, latency), for people. Thread-safe, as is obey().
    [[nodiscard]] virtual std::string state() const { return {}; }
    /// Samples that a streaming device lost because this computer stood still, since its making:
    /// a loss of the simulation's, of which a real host knows nothing. Thread-safe.
    [[nodiscard]] virtual std::uint64_t skipped() const { return 0; }
    /// What can happen to a device of this kind only. @errors bad_request for an unknown word.
    virtual Result<void> obey(const std::string& word);
};

} // namespace axiscal::simulate

#pragma once
// Messages between vhci_hcd and a device: USB/IP's 48-byte headers, big-endian (Linux kernel,
// Documentation/usb/usbip_protocol.rst, "USBIP_CMD_SUBMIT" and following). Pure.

#include "wire/usb/usb_device.hpp"

#include <array>
#include <variant>

namespace axiscal::simulate {

inline constexpr std::size_t usbip_header_size = 48;
using UsbipHeader = std::array<std::uint8_t, usbip_header_size>;

/// A transfer that the host begins. For OUT, `length` bytes follow the header.
struct UrbSubmit {
    std::uint32_t sequence = 0;
    bool in = false;
    std::uint8_t endpoint = 0;
    std::uint32_t length = 0;
    UsbSetup setup; ///< of endpoint 0
};
/// A transfer that the host takes back.
struct UrbUnlink {
    std::uint32_t sequence = 0, victim = 0;
};
using UrbRequest = std::variant<std::monostate, UrbSubmit, UrbUnlink>;

/// monostate: neither SUBMIT nor UNLINK, the stream is lost.
UrbRequest decode_urb(const UsbipHeader& header);

/// RET_SUBMIT with the bytes of an IN transfer. status: 0 or a negated errno; actual: bytes moved.
Bytes encode_return(std::uint32_t sequence,
                    std::int32_t status,
                    std::uint32_t actual,
                    std::span<const std::uint8_t> in_bytes);
/// RET_UNLINK. status: -ECONNRESET where the transfer was still held, else 0.
Bytes encode_unlinked(std::uint32_t sequence, std::int32_t status);

} // namespace axiscal::simulate

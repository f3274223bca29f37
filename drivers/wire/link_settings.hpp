#pragma once
// How a link is written in the station file. Pure.

#include "config/settings.hpp"
#include "drivers/wire/byte_link.hpp"

#include <string_view>

namespace axiscal {

/// "serial:/dev/serial/by-id/..." or "tcp:host:port"; IPv6 hosts in brackets. Other fields are
/// taken from `defaults`.
/// @errors Fault::bad_configuration with what would be right.
Result<LinkSettings> parse_link(std::string_view text, LinkSettings defaults = {});

/// Reads `link` and, on a serial line, `baud`, `parity`, `data_bits` and `stop_bits`; what is
/// missing keeps the driver's default. Refusals go to `options`.
LinkSettings read_link(Settings& options, const LinkSettings& defaults = {});

/// Reads `link` of an instrument on USB: "usb:any", "usb:SERIAL" or "usb-port:1-2.4". What the
/// device shows itself as stands in `defaults`. Refusals go to `options`.
LinkSettings read_usb_link(Settings& options, const LinkSettings& defaults);

/// Reads `link` of an instrument on a CAN bus: "can:can0". Refusals go to `options`.
LinkSettings read_can_link(Settings& options);

} // namespace axiscal

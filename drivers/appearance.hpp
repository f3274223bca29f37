#pragma once
// How an instrument shows itself to the kernel before anybody speaks to it: what `axiscal devices`
// holds against what is plugged in. One constant beside each driver, named in its registry line.
// Pure data.

#include "drivers/wire/usb_place.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace axiscal {

/// The face of the kernel behind which an instrument sits.
enum class Wire : std::uint8_t { serial, usb, hid, tcp, can, one_wire, counter };

struct Appearance {
    Wire wire = Wire::tcp; ///< tcp: it cannot be seen, only asked
    /// USB numbers to which it answers; of a serial instrument those of the port built into it, or
    /// of the adapter that it is sold with.
    std::span<const UsbId> ids = {};
    /// A serial instrument that may sit behind any adapter and any built-in port.
    bool any_port = false;
    std::string_view name = {}; ///< what its block is called unless that name is taken: "laser"
    /// Further lines of its block that the driver demands, each ending with a new line; a comment
    /// says where the value is found.
    std::string_view keys = {};
    /// On USB: it tells its serial number only to whoever opens it, so that the kernel knows none.
    bool serial_when_opened = false;
};

} // namespace axiscal

#pragma once
// Which USB devices can be simulated: one row a kind in usb_kinds.cpp.

#include "scenario.hpp"
#include "sim_clock.hpp"
#include "wire/usb/usb_device.hpp"

#include <map>
#include <memory>

namespace axiscal::simulate {

/// One device as the command line wishes it: KIND[,name=value]...
struct UsbWish {
    std::string kind;
    std::map<std::string, std::string> settings; ///< serial, behind, and what the kind knows
    /// The setting's text, or `otherwise`.
    [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise) const;
    /// The setting as a number, 12 or 0.5. @errors bad_request naming a text that is none.
    [[nodiscard]] Result<double> number(const std::string& name,
                                        const std::string& otherwise) const;
    /// The setting as a number as `lsusb` shows it, 16c0; no number reads as 0.
    [[nodiscard]] std::uint16_t hexadecimal(const std::string& name, std::uint16_t otherwise) const;
};
/// @errors bad_request naming the part that is no name=value.
Result<UsbWish> parse_usb_wish(const std::string& text);

/// The truth that the device measures.
struct UsbWorld {
    Scenario scenario;
    SimClock clock;
};

/// @errors bad_request for settings that the kind can not use, io where what stands behind it
/// fails.
using MakeUsbDevice = Result<std::unique_ptr<UsbDevice>> (*)(const UsbWish&, const UsbWorld&);
struct UsbKind {
    const char* name;
    MakeUsbDevice make;
};
/// @errors bad_request naming the kinds that there are, or as the kind's own.
Result<std::unique_ptr<UsbDevice>> make_usb_device(const UsbWish& wish, const UsbWorld& world);

} // namespace axiscal::simulate

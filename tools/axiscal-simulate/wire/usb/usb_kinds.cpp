#include "wire/usb/usb_kinds.hpp"

#include "wire/usb/cdc_acm.hpp"
#include "wire/usb/ftdi_uart.hpp"
#include "wire/usb/usb_instruments.hpp"

#include <array>
#include <cstdlib>
#include <sstream>

namespace axiscal::simulate {

namespace {

/// One row a kind, by name.
constexpr std::array kinds{
    UsbKind{"cdc-acm", make_cdc_acm},   UsbKind{"ftdi", make_ftdi_uart},
    UsbKind{"usbtenki", make_usbtenki}, UsbKind{"labjack-u6", make_labjack_u6},
    UsbKind{"temper", make_temper},     UsbKind{"gs-usb", make_gs_usb},
    UsbKind{"ds9490r", make_ds9490r},
};

} // namespace

std::string UsbWish::text(const std::string& name, const std::string& otherwise) const {
    const auto found = settings.find(name);
    return found == settings.end() ? otherwise : found->second;
}

Result<double> UsbWish::number(const std::string& name, const std::string& otherwise) const {
    const std::string wished = text(name, otherwise);
    char* end = nullptr;
    const double value = std::strtod(wished.c_str(), &end);
    if (wished.empty() || *end != '\0')
        return fail(Fault::bad_request, name + "=" + wished + " is no number");
    return value;
}

std::uint16_t UsbWish::hexadecimal(const std::string& name, std::uint16_t otherwise) const {
    const std::string number = text(name, "");
    if (number.empty()) return otherwise;
    return static_cast<std::uint16_t>(std::strtoul(number.c_str(), nullptr, 16));
}

namespace {

tl::unexpected<Error> no_setting(const std::string& part, const std::string& text) {
    return fail(Fault::bad_request, "\"" + part + "\" in " + text + " is no name=value");
}

} // namespace

Result<UsbWish> parse_usb_wish(const std::string& text) {
    std::istringstream parts{text};
    UsbWish wish;
    std::getline(parts, wish.kind, ',');
    for (std::string part; std::getline(parts, part, ',');) {
        const auto equals = part.find('=');
        if (equals == std::string::npos || equals == 0) return no_setting(part, text);
        wish.settings[part.substr(0, equals)] = part.substr(equals + 1);
    }
    return wish;
}

Result<std::unique_ptr<UsbDevice>> make_usb_device(const UsbWish& wish, const UsbWorld& world) {
    std::string known;
    for (const UsbKind& kind : kinds) {
        if (wish.kind == kind.name) return kind.make(wish, world);
        known += known.empty() ? kind.name : std::string{", "} + kind.name;
    }
    return fail(Fault::bad_request,
                "no USB device is of kind \"" + wish.kind + "\"; there are: " + known);
}

} // namespace axiscal::simulate

#include "drivers/wire/usb_place.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

namespace axiscal {
namespace {

/// An attribute of one line; empty when there is none.
std::string attribute(const std::filesystem::path& device, const char* name) {
    std::ifstream file{device / name};
    std::string text;
    std::getline(file, text);
    return text;
}

int number_of(const std::string& text, int base) {
    return static_cast<int>(std::strtol(text.c_str(), nullptr, base));
}

std::optional<UsbEntry> entry_of(const std::filesystem::path& device) {
    const std::string vendor = attribute(device, "idVendor");
    if (vendor.empty()) return std::nullopt; // an interface, not a device
    UsbEntry entry;
    entry.vendor = static_cast<std::uint16_t>(number_of(vendor, 16));
    entry.product = static_cast<std::uint16_t>(number_of(attribute(device, "idProduct"), 16));
    entry.device_class = number_of(attribute(device, "bDeviceClass"), 16);
    entry.bus = number_of(attribute(device, "busnum"), 10);
    entry.address = number_of(attribute(device, "devnum"), 10);
    entry.port = device.filename().string();
    entry.name = attribute(device, "product");
    entry.serial = attribute(device, "serial");
    return entry;
}

bool fits(const UsbEntry& entry, const UsbPlace& place) {
    const bool known = std::ranges::any_of(place.ids, [&](const UsbId& id) {
        return id.vendor == entry.vendor && (id.product == 0 || id.product == entry.product) &&
               (id.name.empty() || id.name == entry.name) &&
               (id.device_class < 0 || id.device_class == entry.device_class);
    });
    return known && (place.serial.empty() || place.serial == entry.serial) &&
           (place.port.empty() || place.port == entry.port);
}

std::string hexadecimal(const UsbId& id) {
    char text[16];
    if (id.product == 0)
        std::snprintf(text, sizeof text, "%04x:*", unsigned{id.vendor});
    else
        std::snprintf(text, sizeof text, "%04x:%04x", unsigned{id.vendor}, unsigned{id.product});
    return text;
}

} // namespace

tl::unexpected<Error> UsbPlace::absence() const {
    return fail(Fault::link_closed, "no " + describe() + " is plugged in");
}

std::string UsbEntry::describe() const {
    return "USB " + hexadecimal({vendor, product}) +
           (serial.empty() ? "" : " serial number " + serial) + " port " + port;
}

bool is_plugged(const UsbEntry& entry) {
    return std::ranges::any_of(list_usb(), [&](const UsbEntry& other) {
        return other.port == entry.port && other.address == entry.address;
    });
}

std::string UsbPlace::describe() const {
    std::string text = "USB";
    std::string last;
    for (const UsbId& id : ids) {
        const std::string word = hexadecimal(id);
        if (word != last) text += (last.empty() ? " " : "/") + word;
        last = word;
    }
    if (!serial.empty()) text += " serial number " + serial;
    if (!port.empty()) text += " port " + port;
    return text;
}

std::vector<UsbEntry> list_usb(const std::string& sysfs) {
    std::vector<UsbEntry> plugged;
    std::error_code error;
    const std::filesystem::directory_iterator devices{sysfs + "/bus/usb/devices", error};
    if (error) return plugged;
    for (const auto& device : devices)
        if (auto entry = entry_of(device.path())) plugged.push_back(*std::move(entry));
    std::ranges::sort(plugged, {}, &UsbEntry::port);
    return plugged;
}

Result<UsbEntry> choose_usb(const UsbPlace& place, const std::vector<UsbEntry>& plugged) {
    std::vector<UsbEntry> fitting;
    std::ranges::copy_if(plugged, std::back_inserter(fitting),
                         [&](const UsbEntry& entry) { return fits(entry, place); });
    const std::size_t wanted = place.nth < 0 ? 0 : static_cast<std::size_t>(place.nth);
    if (wanted >= fitting.size()) return place.absence();
    if (place.nth >= 0 || fitting.size() == 1) return fitting[wanted];
    std::string list;
    for (const UsbEntry& entry : fitting)
        list += (list.empty() ? "" : ", ") +
                (entry.serial.empty() ? std::string{} : "usb:" + entry.serial + " or ") +
                "usb-port:" + entry.port;
    return fail(Fault::bad_configuration, std::to_string(fitting.size()) + " of " +
                                              place.describe() +
                                              " are plugged in; write one as link: " + list);
}

} // namespace axiscal

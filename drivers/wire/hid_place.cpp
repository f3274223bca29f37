#include "drivers/wire/hid_place.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

bool below_usb(const fs::path& hid, const fs::path& sysfs) {
    std::error_code error;
    for (auto folder = hid; folder != sysfs && folder.has_relative_path();
         folder = folder.parent_path())
        if (fs::exists(folder / "idVendor", error)) return true;
    return false;
}

/// "0003:413D:2107.0005": bus, vendor, product, and a number that no two ever had.
std::optional<UsbEntry> entry_of(const fs::path& hid) {
    constexpr std::size_t vendor_at = 5, product_at = 10, number_at = 15, whole = 19;
    UsbEntry entry;
    entry.port = hid.filename().string();
    if (entry.port.size() != whole) return std::nullopt;
    const auto number = [&](std::size_t at) {
        return std::strtol(entry.port.substr(at, 4).c_str(), nullptr, 16);
    };
    entry.vendor = static_cast<std::uint16_t>(number(vendor_at));
    entry.product = static_cast<std::uint16_t>(number(product_at));
    entry.address = static_cast<int>(number(number_at));
    std::ifstream facts{hid / "uevent"};
    for (std::string line; std::getline(facts, line);) {
        constexpr std::string_view name = "HID_NAME=", serial = "HID_UNIQ=";
        if (line.starts_with(name)) entry.name = line.substr(name.size());
        if (line.starts_with(serial)) entry.serial = line.substr(serial.size());
    }
    return entry;
}

/// An attribute of an interface; -1 when there is none.
int hexadecimal_in(const fs::path& file) {
    std::ifstream attribute{file};
    int number = -1;
    if (!(attribute >> std::hex >> number)) return -1;
    return number;
}

} // namespace

int last_hid_interface(const std::string& port, const std::string& sysfs) {
    constexpr int hid_class = 3;
    int last = -1;
    std::error_code error;
    const fs::path device = fs::path{sysfs} / "bus/usb/devices" / port;
    for (fs::directory_iterator part{device, error}, end; !error && part != end;
         part.increment(error))
        if (hexadecimal_in(part->path() / "bInterfaceClass") == hid_class)
            last = std::max(last, hexadecimal_in(part->path() / "bInterfaceNumber"));
    return last;
}

std::vector<UsbEntry> list_hid(const std::string& sysfs) {
    std::vector<UsbEntry> plugged = list_usb(sysfs);
    std::error_code error;
    const auto root = fs::canonical(sysfs, error);
    const fs::directory_iterator devices{sysfs + "/bus/hid/devices", error};
    if (error) return plugged;
    for (const auto& device : devices) {
        const auto place = fs::canonical(device.path(), error);
        if (error || below_usb(place, root)) continue;
        if (auto entry = entry_of(place)) plugged.push_back(*std::move(entry));
    }
    std::ranges::sort(plugged, {}, &UsbEntry::port);
    return plugged;
}

bool is_hid_plugged(const UsbEntry& entry) {
    return std::ranges::any_of(list_hid(), [&](const UsbEntry& other) {
        return other.port == entry.port && other.address == entry.address;
    });
}

} // namespace axiscal

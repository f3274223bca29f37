// Sources: Documentation/ABI/testing/sysfs-bus-usb, sysfs-class-net, sysfs-bus-counter of
// Linux 6.1; Documentation/w1/w1-generic.rst. USB numbers of adapters: the tables of the kernel's
// own drivers (ftdi_sio, ch341, cp210x, pl2303, gs_usb, peak_usb, ds2490).
#include "drivers/plugged/plugged.hpp"

#include "drivers/plugged/sysfs.hpp"
#include "drivers/registry.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int can_interface = 280;   // ARPHRD_CAN of <linux/if_arp.h>
constexpr unsigned interface_up = 1; // IFF_UP of <linux/if.h>

struct Adapter {
    UsbId id;
    std::string_view module;
    Wire wire;
};
const std::array adapters{
    Adapter{{0x0403, 0x6001}, "ftdi_sio", Wire::serial},
    Adapter{{0x0403, 0x6010}, "ftdi_sio", Wire::serial},
    Adapter{{0x0403, 0x6011}, "ftdi_sio", Wire::serial},
    Adapter{{0x0403, 0x6014}, "ftdi_sio", Wire::serial},
    Adapter{{0x0403, 0x6015}, "ftdi_sio", Wire::serial},
    Adapter{{0x1A86, 0x7523}, "ch341", Wire::serial},
    Adapter{{0x1A86, 0x5523}, "ch341", Wire::serial},
    Adapter{{0x10C4, 0xEA60}, "cp210x", Wire::serial},
    Adapter{{0x067B, 0x2303}, "pl2303", Wire::serial},
    Adapter{{0x1D50, 0x606F}, "gs_usb", Wire::can},
    Adapter{{0x0C72, 0x000C}, "peak_usb", Wire::can},
    Adapter{{0x04FA, 0x2490}, "ds2490", Wire::one_wire},
};

const Adapter* adapter_of(const UsbEntry& entry) {
    const auto found = std::ranges::find_if(adapters, [&](const Adapter& row) {
        return answers_to(entry, std::span{&row.id, 1});
    });
    return found == adapters.end() ? nullptr : &*found;
}

/// What the registered drivers expect of a USB device that no kernel driver made a terminal of;
/// empty: none knows it. Those that speak in transfers first: a maker's number may cover sticks
/// of both kinds, of which the serial ones are told by what is left.
std::optional<Wire> wire_of(const UsbEntry& entry) {
    for (const bool serial : {false, true})
        for (const InstrumentDriver& driver : instrument_drivers())
            if (driver.shows != nullptr && (driver.shows->wire == Wire::serial) == serial &&
                answers_to(entry, driver.shows->ids))
                return driver.shows->wire;
    return std::nullopt;
}

/// A name of the terminal that stays at another socket, or after another one was plugged in first.
/// Chips without a serial number share their name under by-id: those are told apart by the socket.
std::string lasting_name(const std::string& tty, const UsbEntry* usb, const KernelPlaces& places) {
    const bool numbered = usb != nullptr && !usb->serial.empty();
    const std::array<const char*, 3> folders{numbered ? "serial/by-id" : "axiscal",
                                             numbered ? "axiscal" : "serial/by-path",
                                             "serial/by-path"};
    for (const char* folder : folders)
        for (const fs::path& name : sysfs::entries(fs::path{places.dev} / folder))
            if (sysfs::target_name(name) == tty) return name.string();
    return places.dev + "/" + tty;
}

/// The kernel writes whole numbers; 0 for what is none.
int number_in(const std::string& text) {
    return static_cast<int>(std::strtol(text.c_str(), nullptr, 10));
}

/// A terminal that some hardware stands behind. A built-in port that is not there has type 0.
bool is_serial_line(const fs::path& tty) {
    std::error_code error;
    if (!fs::exists(tty / "device", error)) return false;
    const std::string name = tty.filename().string();
    if (!name.starts_with("tty")) return false;
    const std::string type = sysfs::line_of(tty / "type");
    return type.empty() ? name.starts_with("ttyUSB") || name.starts_with("ttyACM") : type != "0";
}

/// The driver of the nearest device above a terminal that has one.
std::string driver_above(const fs::path& tty) {
    std::error_code error;
    fs::path device = fs::canonical(tty / "device", error);
    for (int step = 0; !error && step < 3; ++step, device = device.parent_path())
        if (std::string name = sysfs::target_name(device / "driver"); !name.empty())
            return name;
    return {};
}

void add_terminals(const KernelPlaces& places,
                   const std::vector<UsbEntry>& usb,
                   std::vector<PluggedDevice>& found) {
    for (const fs::path& tty : sysfs::entries(fs::path{places.sysfs} / "class/tty")) {
        if (!is_serial_line(tty)) continue;
        PluggedDevice device;
        const std::string name = tty.filename().string();
        device.usb = sysfs::usb_above(tty / "device", usb);
        device.place = device.node = places.dev + "/" + name;
        device.kernel_driver = driver_above(tty);
        device.link = "serial:" + lasting_name(name, device.usb ? &*device.usb : nullptr, places);
        const std::string timer = sysfs::line_of(fs::path{places.sysfs} / "bus/usb-serial/devices" /
                                                 name / "latency_timer");
        if (!timer.empty()) device.latency_timer_ms = number_in(timer);
        found.push_back(std::move(device));
    }
}

void add_can(const KernelPlaces& places,
             const std::vector<UsbEntry>& usb,
             std::vector<PluggedDevice>& found) {
    for (const fs::path& net : sysfs::entries(fs::path{places.sysfs} / "class/net")) {
        if (number_in(sysfs::line_of(net / "type")) != can_interface) continue;
        PluggedDevice device;
        device.wire = Wire::can;
        device.place = net.filename().string();
        device.link = "can:" + device.place;
        device.usb = sysfs::usb_above(net / "device", usb);
        device.kernel_driver = sysfs::target_name(net / "device/driver");
        const auto flags = std::strtoul(sysfs::line_of(net / "flags").c_str(), nullptr, 16);
        device.up = (flags & interface_up) != 0;
        found.push_back(std::move(device));
    }
}

/// Families of thermometers, as the driver ds18b20 takes them.
bool is_thermometer(const std::string& name) {
    constexpr std::array<std::string_view, 4> families{"28-", "22-", "3b-", "42-"};
    return std::ranges::any_of(families, [&](auto family) { return name.starts_with(family); });
}

void add_one_wire(const KernelPlaces& places, std::vector<PluggedDevice>& found) {
    PluggedDevice device;
    device.wire = Wire::one_wire;
    device.place = "1-Wire";
    bool master = false;
    for (const fs::path& slave : sysfs::entries(fs::path{places.sysfs} / "bus/w1/devices")) {
        const std::string name = slave.filename().string();
        master = master || name.starts_with("w1_bus_master");
        if (is_thermometer(name)) device.sensors.push_back(name);
    }
    if (!device.sensors.empty()) device.kernel_driver = "w1_therm";
    if (master) found.push_back(std::move(device));
}

void add_counters(const KernelPlaces& places, std::vector<PluggedDevice>& found) {
    for (const fs::path& counter : sysfs::entries(fs::path{places.sysfs} / "bus/counter/devices")) {
        PluggedDevice device;
        device.wire = Wire::counter;
        device.place = device.node = places.dev + "/" + counter.filename().string();
        device.kernel_driver = "counter";
        found.push_back(std::move(device));
    }
}

std::string
hidraw_node(const KernelPlaces& places, const UsbEntry& entry, const std::vector<UsbEntry>& usb) {
    std::string last; // the interface that answers is the last one of a stick
    for (const fs::path& hid : sysfs::entries(fs::path{places.sysfs} / "class/hidraw")) {
        const auto owner = sysfs::usb_above(hid / "device", usb);
        if (owner && owner->port == entry.port) last = places.dev + "/" + hid.filename().string();
    }
    return last;
}

std::string usbfs_node(const KernelPlaces& places, const UsbEntry& entry) {
    char numbers[32];
    std::snprintf(numbers, sizeof numbers, "/bus/usb/%03d/%03d", entry.bus, entry.address);
    return places.dev + numbers;
}

/// An instrument that speaks in transfers of its own, or an adapter that no module serves.
void add_usb(const KernelPlaces& places,
             const std::vector<UsbEntry>& usb,
             std::vector<PluggedDevice>& found) {
    for (const UsbEntry& entry : usb) {
        const bool served = std::ranges::any_of(found, [&](const PluggedDevice& device) {
            return device.usb && device.usb->port == entry.port;
        });
        const Adapter* adapter = adapter_of(entry);
        const auto wire = adapter != nullptr ? adapter->wire : wire_of(entry);
        if (served || !wire) continue;
        const bool one_wire_works =
            wire == Wire::one_wire &&
            std::ranges::find(found, Wire::one_wire, &PluggedDevice::wire) != found.end();
        if (one_wire_works) continue;
        PluggedDevice device;
        device.wire = *wire;
        device.usb = entry;
        device.place = "USB port " + entry.port;
        if (adapter != nullptr) device.module = adapter->module;
        if (device.wire == Wire::serial && device.module.empty()) device.module = "cdc_acm";
        if (device.wire == Wire::hid) device.module = "usbhid";
        if (device.wire == Wire::hid) device.node = hidraw_node(places, entry, usb);
        if (!device.node.empty()) device.kernel_driver = "usbhid";
        if (device.wire == Wire::usb) device.node = usbfs_node(places, entry);
        device.link = entry.serial.empty() ? "usb-port:" + entry.port : "usb:" + entry.serial;
        found.push_back(std::move(device));
    }
}

} // namespace

bool answers_to(const UsbEntry& entry, std::span<const UsbId> ids) {
    const UsbPlace place{{ids.begin(), ids.end()}};
    return choose_usb(place, {entry}).has_value();
}

bool is_adapter(const UsbEntry& entry) {
    return adapter_of(entry) != nullptr;
}

std::vector<PluggedDevice> list_plugged(const KernelPlaces& places) {
    const std::vector<UsbEntry> usb = list_usb(places.sysfs);
    std::vector<PluggedDevice> found;
    add_terminals(places, usb, found);
    add_can(places, usb, found);
    add_one_wire(places, found);
    add_counters(places, found);
    add_usb(places, usb, found);
    std::ranges::stable_sort(found, {}, &PluggedDevice::wire);
    return found;
}

} // namespace axiscal

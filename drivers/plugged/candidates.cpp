#include "drivers/plugged/candidates.hpp"

#include "drivers/registry.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view serial_prefix = "serial:";

/// Both names lead to one device node. By their paths: std::filesystem::equivalent compares no
/// devices.
bool same_node(const std::string& name, const std::string& other) {
    if (name == other) return true;
    std::error_code error;
    const fs::path node = fs::canonical(name, error);
    return !error && node == fs::canonical(other, error) && !error;
}

bool same_terminal(const PluggedDevice& device, const std::string& link) {
    return link.starts_with(serial_prefix) &&
           same_node(link.substr(serial_prefix.size()), device.node);
}

/// The entry's driver, when the device could be one of its kind; null: it could not.
const InstrumentDriver* kin(const StationWires::Entry& entry, const PluggedDevice& device) {
    const auto drivers = could_be(device);
    const auto found = std::ranges::find(drivers, entry.driver, &InstrumentDriver::name);
    return found == drivers.end() ? nullptr : *found;
}

bool means(const StationWires::Entry& entry, const PluggedDevice& device) {
    switch (device.wire) {
    case Wire::serial: return same_terminal(device, entry.link);
    case Wire::one_wire:
        return std::ranges::any_of(entry.sensors, [&](const std::string& sensor) {
            return std::ranges::find(device.sensors, sensor) != device.sensors.end();
        });
    case Wire::usb:
    case Wire::hid:
        return kin(entry, device) != nullptr && device.usb &&
               (entry.link == "usb:any" || entry.link == "usb-port:" + device.usb->port ||
                (!device.usb->serial.empty() && entry.link == "usb:" + device.usb->serial));
    case Wire::can: return entry.link == device.link;
    case Wire::counter: return same_node(entry.link, device.node);
    case Wire::tcp: break;
    }
    return false;
}

/// The entry states a serial number that this device would tell only to whoever opens it.
bool may_mean(const StationWires::Entry& entry, const PluggedDevice& device) {
    if (!entry.link.starts_with("usb:") || !device.usb || !device.usb->serial.empty()) return false;
    const InstrumentDriver* driver = kin(entry, device);
    return driver != nullptr && driver->shows->serial_when_opened;
}

bool knows(const InstrumentDriver& driver, const PluggedDevice& device) {
    if (driver.shows == nullptr || driver.shows->wire != device.wire) return false;
    const bool by_number =
        device.wire == Wire::serial || device.wire == Wire::usb || device.wire == Wire::hid;
    return !by_number || (device.usb && answers_to(*device.usb, driver.shows->ids));
}

std::string free_name(std::string_view wanted, const StationWires& station) {
    const auto taken = [&](const std::string& name) {
        return std::ranges::find(station.instruments, name, &StationWires::Entry::name) !=
               station.instruments.end();
    };
    std::string name{wanted.empty() ? "instrument" : wanted};
    const std::string base = name;
    for (int number = 2; taken(name); ++number)
        name = base + "-" + std::to_string(number);
    return name;
}

/// The lines that say where it is plugged in.
std::string wire_lines(const PluggedDevice& device, const Appearance& shows) {
    if (device.wire == Wire::counter) return "device = \"" + device.node + "\"\n";
    if (shows.serial_when_opened && device.link.starts_with("usb-port:"))
        return "link = \"" + device.link + "\"   # its socket; or \"usb:\" and the number on it\n";
    if (device.wire != Wire::one_wire) return "link = \"" + device.link + "\"\n";
    std::string list;
    for (const std::string& sensor : device.sensors)
        list += (list.empty() ? "\"" : ", \"") + sensor + "\"";
    return "sensors = [" + list + "]\n";
}

Obstacle not_served(const PluggedDevice& device) {
    return {"no kernel driver serves it: the module " + device.module + " is not loaded",
            "sudo modprobe " + device.module +
                "; if it does not exist, this kernel was built "
                "without it"};
}

Obstacle not_allowed(const PluggedDevice& device, const Account& service) {
    const std::string line =
        device.usb ? "copy the line of its kind in 70-axiscal.rules to "
                     "/etc/udev/rules.d/71-axiscal-site.rules with " +
                         device.usb->describe().substr(4, 9) +
                         ", then: sudo udevadm control --reload && sudo udevadm trigger"
                   : "sudo usermod -aG dialout " + service.name + ", then restart axiscald";
    return {"the user " + service.name + " may not open " + device.node + " (" +
                rights_text(device.node) + ")",
            line};
}

/// The bit rate is that of a JUMO CANtrans T as delivered. Debian's gs_usb refuses restart-ms, and
/// with it the whole command; what has no adapter behind it (vcan) has no bit rate.
std::string raising_of(const PluggedDevice& can) {
    std::string line = "sudo ip link set " + can.place + " up";
    if (can.kernel_driver.empty()) return line;
    line += " type can bitrate 500000";
    if (can.kernel_driver != "gs_usb") line += " restart-ms 100";
    return line + " (500000 is a JUMO CANtrans T as delivered: state the bit rate of the "
                  "instruments)";
}

} // namespace

StationWires read_station_wires(SettingsDocument& document) {
    StationWires station;
    for (Settings& table : document.root().tables("instrument")) {
        StationWires::Entry entry;
        entry.name = table.text("name", "");
        entry.driver = table.text("driver", "");
        entry.link = table.text(table.has("device") ? "device" : "link", "");
        entry.sensors = table.texts("sensors", std::vector<std::string>{});
        station.instruments.push_back(std::move(entry));
    }
    Settings trigger = document.root().table("trigger");
    station.trigger_line = trigger.text("serial_port", "");
    return station;
}

std::vector<const InstrumentDriver*> could_be(const PluggedDevice& device) {
    std::vector<const InstrumentDriver*> drivers;
    for (const InstrumentDriver& driver : instrument_drivers())
        if (knows(driver, device)) drivers.push_back(&driver);
    const bool own_number = device.usb && !is_adapter(*device.usb) && !drivers.empty();
    if (device.wire != Wire::serial || own_number) return drivers;
    for (const InstrumentDriver& driver : instrument_drivers())
        if (driver.shows != nullptr && driver.shows->any_port) drivers.push_back(&driver);
    return drivers;
}

std::string known_as(const PluggedDevice& device, const StationWires& station) {
    for (const StationWires::Entry& entry : station.instruments)
        if (means(entry, device)) return entry.name;
    const bool line = !station.trigger_line.empty() && !device.node.empty();
    return line && same_node(station.trigger_line, device.node) ? "trigger" : "";
}

std::vector<std::string> may_be(const PluggedDevice& device, const StationWires& station) {
    std::vector<std::string> names;
    if (!known_as(device, station).empty()) return names;
    for (const StationWires::Entry& entry : station.instruments)
        if (may_mean(entry, device)) names.push_back(entry.name);
    return names;
}

std::string toml_block(const PluggedDevice& device,
                       const InstrumentDriver& driver,
                       const StationWires& station) {
    return "[[instrument]]\nname = \"" + free_name(driver.shows->name, station) +
           "\"\ndriver = \"" + std::string{driver.name} + "\"\n" +
           wire_lines(device, *driver.shows) + std::string{driver.shows->keys};
}

std::vector<Obstacle> obstacles(const PluggedDevice& device, const Account& service) {
    std::vector<Obstacle> list;
    if (!device.module.empty() && device.kernel_driver.empty()) list.push_back(not_served(device));
    if (!device.node.empty() && !may_use(service, device.node))
        list.push_back(not_allowed(device, service));
    if (device.latency_timer_ms && *device.latency_timer_ms > 1)
        list.push_back({"its adapter holds bytes back for " +
                            std::to_string(*device.latency_timer_ms) + " ms instead of 1 ms",
                        "install the udev rule of axiscal (docs/install.md), then plug it in "
                        "again",
                        false});
    if (device.wire == Wire::can && !device.up)
        list.push_back({"the interface " + device.place + " is down", raising_of(device)});
    if (device.wire == Wire::one_wire && device.module.empty() && device.sensors.empty())
        list.push_back({"no thermometer answers on the 1-Wire bus",
                        "look at its three wires; then: ls /sys/bus/w1/devices"});
    return list;
}

} // namespace axiscal

#pragma once
// What is plugged into this PC, as the kernel tells in sysfs. Nothing is opened and nothing is
// asked: an instrument that measures at this moment is not disturbed. Blocking, for a command line.

#include "drivers/appearance.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Where the kernel shows itself; other folders in tests.
struct KernelPlaces {
    std::string sysfs = "/sys", dev = "/dev";
};

struct PluggedDevice {
    Wire wire = Wire::serial;
    std::string place; ///< for people: "/dev/ttyACM0", "USB port 1-2.4", "can0", "1-Wire"
    std::string node;  ///< what a program opens; empty: nothing, or it is not there
    std::string
        link; ///< as the station file names it: "serial:/dev/serial/by-id/...", "usb:A10234"
    std::optional<UsbEntry> usb;      ///< the device itself, or the adapter in front of it
    std::string module;               ///< kernel module that should serve it; empty: none is needed
    std::string kernel_driver;        ///< that serves it; empty: none does
    std::vector<std::string> sensors; ///< one_wire: names of the sensors
    bool up = true;                   ///< can: the interface is up
    std::optional<int> latency_timer_ms; ///< of an FTDI adapter
};

/// By wire, then by place. Terminals of programs, hubs and what no driver of axiscal could mean
/// (keyboards, disks) are left out.
std::vector<PluggedDevice> list_plugged(const KernelPlaces& places);

/// It shows itself in one of these ways.
bool answers_to(const UsbEntry& entry, std::span<const UsbId> ids);
/// One of the adapters by which instruments of any kind reach a PC.
bool is_adapter(const UsbEntry& entry);

} // namespace axiscal

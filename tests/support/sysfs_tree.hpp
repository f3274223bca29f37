#pragma once
// A folder laid out as Linux 6.1 lays out /sys and /dev: devices below devices/, symbolic links to
// them from bus/ and class/, and back to driver and device.

#include "tests/support/scratch_folder.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace axiscal::testing {

struct UsbNumbers {
    std::string vendor, product, name = {}, serial = {}, its_class = "00";
};

class SysfsTree {
    using Path = std::filesystem::path;

public:
    [[nodiscard]] std::string sysfs() const { return folder_.file("sys"); }
    [[nodiscard]] std::string dev() const { return folder_.file("dev"); }

    /// A USB device with one interface; returns the interface's folder.
    Path usb(const std::string& port, const UsbNumbers& numbers) {
        const Path device = hub() / port;
        const Path interface = device / (port + ":1.0");
        write(device / "idVendor", numbers.vendor);
        write(device / "idProduct", numbers.product);
        write(device / "bDeviceClass", numbers.its_class);
        write(device / "busnum", "1");
        write(device / "devnum", std::to_string(++devices_));
        if (!numbers.name.empty()) write(device / "product", numbers.name);
        if (!numbers.serial.empty()) write(device / "serial", numbers.serial);
        write(interface / "bInterfaceNumber", "00");
        link(Path{sysfs()} / "bus/usb/devices" / port, device);
        link(Path{sysfs()} / "bus/usb/devices" / interface.filename(), interface);
        char node[16];
        std::snprintf(node, sizeof node, "001/%03d", devices_);
        write(Path{dev()} / "bus/usb" / node, "");
        return interface;
    }
    /// /dev/ttyUSB0 or /dev/ttyACM0 of an interface, with a name under /dev/serial/by-id.
    void terminal(const Path& interface,
                  const std::string& name,
                  const std::string& driver,
                  const std::string& by_id = "") {
        const bool own_device = name.starts_with("ttyUSB");
        const Path device = own_device ? interface / name : interface;
        drive(device, driver);
        node(device / "tty" / name, "tty", device);
        write(Path{dev()} / name, "");
        if (own_device) {
            write(device / "latency_timer", "1");
            link(Path{sysfs()} / "bus/usb-serial/devices" / name, device);
        }
        if (!by_id.empty()) link(Path{dev()} / "serial/by-id" / by_id, Path{dev()} / name);
    }
    /// A built-in port; type 0 is one that no chip stands behind.
    void built_in(const std::string& name, const std::string& type) {
        const Path device = Path{sysfs()} / "devices/pnp0" / ("00:" + name);
        node(device / "tty" / name, "tty", device);
        write(device / "tty" / name / "type", type);
        write(Path{dev()} / name, "");
    }
    void hidraw(const Path& interface, const std::string& name) {
        const Path device = interface / ("0003:0000:0000." + name);
        node(device / "hidraw" / name, "hidraw", device);
        write(Path{dev()} / name, "");
    }
    void can(const Path& interface,
             const std::string& name,
             const std::string& flags,
             const std::string& driver = "gs_usb") {
        drive(interface, driver);
        const Path net = interface / "net" / name;
        node(net, "net", interface);
        write(net / "type", "280");
        write(net / "flags", flags);
    }
    void one_wire(const std::string& name) {
        const Path device = Path{sysfs()} / "devices/w1_bus_master1" / name;
        write(device / "name", name);
        link(Path{sysfs()} / "bus/w1/devices" / name, device);
    }

    static void write(const Path& file, const std::string& text) {
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file} << text << "\n";
    }
    static void link(const Path& name, const Path& target) {
        std::filesystem::create_directories(name.parent_path());
        std::filesystem::create_symlink(target, name);
    }

private:
    [[nodiscard]] Path hub() const {
        return Path{sysfs()} / "devices/pci0000:00/0000:00:14.0/usb1";
    }
    void drive(const Path& device, const std::string& driver) {
        const Path home = Path{sysfs()} / "bus/drivers" / driver;
        std::filesystem::create_directories(home);
        std::filesystem::create_directories(device);
        link(device / "driver", home);
    }
    void node(const Path& folder, const std::string& its_class, const Path& device) {
        std::filesystem::create_directories(folder);
        link(folder / "device", device);
        link(Path{sysfs()} / "class" / its_class / folder.filename(), folder);
    }

    ScratchFolder folder_;
    int devices_ = 0;
};

} // namespace axiscal::testing

// What is plugged in, out of folders laid out as sysfs is; and what could be made of it.
#include "drivers/plugged/candidates.hpp"
#include "drivers/registry.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/sysfs_tree.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::plugged_test {
namespace {

class Plugged : public ::testing::Test {
protected:
    [[nodiscard]] std::vector<PluggedDevice> listed() const {
        return list_plugged({tree.sysfs(), tree.dev()});
    }
    [[nodiscard]] PluggedDevice only() const {
        auto devices = listed();
        EXPECT_EQ(devices.size(), 1U);
        return devices.empty() ? PluggedDevice{} : devices.front();
    }
    static std::string drivers_of(const PluggedDevice& device) {
        std::string names;
        for (const InstrumentDriver* driver : could_be(device))
            names += (names.empty() ? "" : " ") + std::string{driver->name};
        return names;
    }
    static StationWires station_of(const std::string& text) {
        auto document = SettingsDocument::parse(text, "station.toml").value();
        return read_station_wires(document);
    }
    static std::string
    block(const std::string& driver, const std::string& name, const std::string& link) {
        return "[[instrument]]\nname = \"" + name + "\"\ndriver = \"" + driver + "\"\nlink = \"" +
               link + "\"\n";
    }
    [[nodiscard]] static Account someone() {
        Account account;
        account.name = "axiscal";
        account.user = ::geteuid() + 1;
        return account;
    }
    [[nodiscard]] static Account owner() {
        Account account = someone();
        account.user = ::geteuid();
        return account;
    }
    testing::SysfsTree tree;
};

TEST_F(Plugged, StickIsOneDriverByItsNumberAndKeepsItsNameById) {
    const auto interface = tree.usb("1-2.4", {"289b", "0505", "VCP-PTH450-CAL", "E24638", "02"});
    tree.terminal(interface, "ttyACM0", "cdc_acm", "usb-Dracal_VCP-PTH450-CAL_E24638-if00");
    const PluggedDevice stick = only();
    EXPECT_EQ(drivers_of(stick), "dracal-vcp");
    EXPECT_EQ(stick.place, tree.dev() + "/ttyACM0");
    EXPECT_EQ(stick.link,
              "serial:" + tree.dev() + "/serial/by-id/usb-Dracal_VCP-PTH450-CAL_E24638-if00");
    EXPECT_EQ(stick.kernel_driver, "cdc_acm");
    ASSERT_TRUE(stick.usb);
    EXPECT_EQ(stick.usb->serial, "E24638");
    EXPECT_TRUE(obstacles(stick, owner()).empty());
}

TEST_F(Plugged, AdapterCouldBeEverySerialInstrumentAndTheOneSoldWithIt) {
    tree.terminal(tree.usb("1-1", {"0403", "6001", "FT232R", "A600AXIS"}), "ttyUSB0", "ftdi_sio");
    EXPECT_EQ(drivers_of(only()), "umd vaisala ascii-gauge modbus");
}

/// A chipKIT with the published chipKIT-core: its default numbers, no serial number.
TEST_F(Plugged, BoardOfAnOlderCounterIsOneDriverAndToldByItsSocket) {
    tree.terminal(tree.usb("1-1", {"0403", "a662", "Stk500v2", "", "02"}), "ttyACM0", "cdc_acm");
    testing::SysfsTree::link(tree.dev() + "/axiscal/umd-pci-0000_00_14_0-usb-0_1_1_0",
                             tree.dev() + "/ttyACM0");
    EXPECT_EQ(drivers_of(only()), "umd");
    EXPECT_EQ(only().link, "serial:" + tree.dev() + "/axiscal/umd-pci-0000_00_14_0-usb-0_1_1_0");
}

TEST_F(Plugged, NumberThatNobodyKnowsIsASerialInstrumentAtLeast) {
    tree.terminal(tree.usb("1-1", {"cafe", "4001"}), "ttyACM3", "cdc_acm");
    EXPECT_EQ(drivers_of(only()), "vaisala ascii-gauge modbus");
}

TEST_F(Plugged, BuiltInPortIsListedWhereThereIsAChip) {
    tree.built_in("ttyS0", "4");
    tree.built_in("ttyS1", "0");
    EXPECT_EQ(only().place, tree.dev() + "/ttyS0");
    EXPECT_EQ(drivers_of(only()), "vaisala ascii-gauge modbus");
}

TEST_F(Plugged, TwoAdaptersWithoutSerialNumberAreToldApartByTheSocket) {
    for (const char* number : {"0", "1"}) {
        const std::string name = std::string{"ttyUSB"} + number;
        tree.terminal(tree.usb(std::string{"1-"} + number, {"1a86", "7523"}), name, "ch341");
        testing::SysfsTree::link(tree.dev() + "/serial/by-path/pci-0000:00:14.0-usb-0:" + number +
                                     ":1.0-port0",
                                 tree.dev() + "/" + name);
    }
    // Both have one name there; it leads to the one that was plugged in last.
    testing::SysfsTree::link(tree.dev() + "/serial/by-id/usb-1a86_USB_Serial-if00-port0",
                             tree.dev() + "/ttyUSB1");
    for (const PluggedDevice& adapter : listed())
        EXPECT_NE(adapter.link.find("/serial/by-path/"), std::string::npos) << adapter.link;
}

TEST_F(Plugged, SticksWithoutATerminalAreFoundByTransferAndByReport) {
    tree.usb("1-1", {"0cd5", "0006", "LabJack U6"}); // tells its number only when opened
    tree.usb("1-2", {"1781", "0a98", "USBTenki", "A10234"});
    tree.usb("1-3", {"289b", "0504", "USB-PT100", "B2", "ff"});
    tree.hidraw(tree.usb("1-4", {"413d", "2107"}), "hidraw1");
    tree.usb("1-5", {"1781", "0a98", "a programmer"});
    tree.usb("1-6", {"046d", "c31c", "Keyboard"});
    std::string told;
    for (const PluggedDevice& device : listed())
        told += drivers_of(device) + " " + device.link + "\n";
    EXPECT_EQ(told, "labjack-u6 usb-port:1-1\ndracal-usbtenki usb:A10234\ndracal-usbtenki usb:B2\n"
                    "temper usb-port:1-4\n");
}

TEST_F(Plugged, InterfaceThatIsDownIsToldWithTheCommandThatRaisesIt) {
    tree.can(tree.usb("1-1", {"1d50", "606f", "candleLight"}), "can0", "0x40080");
    tree.can(tree.usb("1-2", {"1d50", "606f", "candleLight"}), "can1", "0x400c1");
    const auto found = listed();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].place, "can0");
    ASSERT_EQ(obstacles(found[0], someone()).size(), 1U);
    EXPECT_NE(obstacles(found[0], someone())[0].mend.find("ip link set can0 up"),
              std::string::npos);
    EXPECT_TRUE(obstacles(found[1], someone()).empty());
}

/// gs_usb of Debian's kernel refuses restart-ms (docs/instruments/canopen-404.md); a CANtrans T
/// comes with 500 kbit/s.
TEST_F(Plugged, CommandThatRaisesAnInterfaceHoldsOnlyWhatItsAdapterTakes) {
    tree.can(tree.usb("1-1", {"1d50", "606f", "candleLight"}), "can0", "0x40080");
    tree.can(tree.usb("1-2", {"0c72", "000c", "PCAN-USB"}), "can1", "0x40080", "peak_usb");
    testing::SysfsTree::write(std::filesystem::path{tree.sysfs()} / "class/net/vcan0/type", "280");
    testing::SysfsTree::write(std::filesystem::path{tree.sysfs()} / "class/net/vcan0/flags",
                              "0x80");
    std::string told;
    for (const PluggedDevice& device : listed())
        for (const Obstacle& obstacle : obstacles(device, someone()))
            told += obstacle.mend.substr(0, obstacle.mend.find(" (")) + "\n";
    EXPECT_EQ(told, "sudo ip link set can0 up type can bitrate 500000\n"
                    "sudo ip link set can1 up type can bitrate 500000 restart-ms 100\n"
                    "sudo ip link set vcan0 up\n");
}

TEST_F(Plugged, ThermometersOfOneBusAreOneInstrument) {
    tree.one_wire("w1_bus_master1");
    tree.one_wire("28-0000075b3c2a");
    tree.one_wire("28-0000075b3c41");
    const PluggedDevice bus = only();
    EXPECT_EQ(drivers_of(bus), "ds18b20");
    EXPECT_NE(toml_block(bus, *could_be(bus).front(), {})
                  .find("sensors = [\"28-0000075b3c2a\", \"28-0000075b3c41\"]"),
              std::string::npos);
    const auto station =
        station_of("[[instrument]]\nname = \"screw\"\nsensors = [\"28-0000075b3c41\"]\n");
    EXPECT_EQ(known_as(bus, station), "screw");
}

TEST_F(Plugged, AdapterThatNoModuleServesNamesTheModule) {
    tree.usb("1-1", {"0403", "6001", "FT232R", "A600AXIS"});
    tree.usb("1-2", {"04fa", "2490"});
    tree.usb("1-3", {"1d50", "606f"});
    std::string told;
    for (const PluggedDevice& device : listed())
        for (const Obstacle& obstacle : obstacles(device, someone()))
            told += obstacle.mend.substr(0, obstacle.mend.find(';')) + "\n";
    EXPECT_EQ(told, "sudo modprobe ftdi_sio\nsudo modprobe gs_usb\nsudo modprobe ds2490\n");
}

TEST_F(Plugged, NodeThatTheServiceMayNotOpenIsNamedWithItsRights) {
    tree.terminal(tree.usb("1-1", {"cafe", "4001"}), "ttyACM0", "cdc_acm");
    const PluggedDevice device = only();
    ::chmod(device.node.c_str(), 0600);
    const auto told = obstacles(device, someone());
    ASSERT_EQ(told.size(), 1U);
    EXPECT_NE(told[0].what.find("0600"), std::string::npos) << told[0].what;
    EXPECT_NE(told[0].mend.find("cafe:4001"), std::string::npos) << told[0].mend;
    EXPECT_TRUE(obstacles(device, owner()).empty());
    Account member = someone();
    struct stat about {};
    ASSERT_EQ(::stat(device.node.c_str(), &about), 0);
    member.groups = {about.st_gid};
    ::chmod(device.node.c_str(), 0660);
    EXPECT_TRUE(obstacles(device, member).empty());
    ::chmod(device.node.c_str(), 0606); // the group's rights count for its members, not everybody's
    EXPECT_FALSE(obstacles(device, member).empty());
}

TEST_F(Plugged, AdapterThatHoldsBytesBackIsTold) {
    const auto interface = tree.usb("1-1", {"0403", "6001", "FT232R", "A600AXIS"});
    tree.terminal(interface, "ttyUSB0", "ftdi_sio");
    EXPECT_TRUE(obstacles(only(), owner()).empty());
    testing::SysfsTree::write(interface / "ttyUSB0/latency_timer", "16");
    ASSERT_EQ(obstacles(only(), owner()).size(), 1U);
    EXPECT_NE(obstacles(only(), owner())[0].what.find("16 ms"), std::string::npos);
}

TEST_F(Plugged, DeviceOfTheStationIsKnownUnderWhateverNameItIsWritten) {
    tree.terminal(tree.usb("1-1", {"16c0", "0483", "USB Serial", "7391230"}), "ttyACM0", "cdc_acm",
                  "usb-Teensyduino_USB_Serial_7391230-if00");
    const PluggedDevice laser = only();
    for (const std::string name :
         {"/ttyACM0", "/serial/by-id/usb-Teensyduino_USB_Serial_7391230-if00"})
        EXPECT_EQ(
            known_as(laser, station_of("[[instrument]]\nname = \"x\"\ndriver = \"umd\"\nlink = "
                                       "\"serial:" +
                                       tree.dev() + name + "\"\n")),
            "x");
    EXPECT_EQ(
        known_as(laser, station_of("[trigger]\nserial_port = \"" + tree.dev() + "/ttyACM0\"\n")),
        "trigger");
    EXPECT_EQ(known_as(laser, station_of("[[instrument]]\nname = \"x\"\nlink = "
                                         "\"serial:/dev/ttyACM0\"\n")),
              "");
}

/// Of device nodes std::filesystem::equivalent says nothing: the kernel's own by-id names never
/// met.
TEST_F(Plugged, DeviceNodeIsKnownUnderALinkToIt) {
    PluggedDevice line;
    line.node = "/dev/null";
    const testing::ScratchFolder scratch;
    const std::string link = scratch.path() + "/usb-maker-line";
    ASSERT_EQ(::symlink("/dev/null", link.c_str()), 0);
    const auto known = [&](const std::string& name) {
        return known_as(
            line, station_of("[[instrument]]\nname = \"x\"\nlink = \"serial:" + name + "\"\n"));
    };
    EXPECT_EQ(known(link), "x");
    EXPECT_EQ(known("/dev/zero"), "");
    EXPECT_EQ(known(scratch.path() + "/nowhere"), "");
}

TEST_F(Plugged, SticksOfTheStationAreKnownByNumberBySocketAndAsTheOnlyOne) {
    tree.usb("1-1", {"1781", "0a98", "USBTenki", "A10234"});
    const PluggedDevice stick = only();
    const auto known = [&](const std::string& driver, const std::string& link) {
        return known_as(stick, station_of(block(driver, "x", link)));
    };
    EXPECT_EQ(known("dracal-usbtenki", "usb:A10234"), "x");
    EXPECT_EQ(known("dracal-usbtenki", "usb-port:1-1"), "x");
    EXPECT_EQ(known("dracal-usbtenki", "usb:any"), "x");
    EXPECT_EQ(known("dracal-usbtenki", "usb:A99999"), "");
    EXPECT_EQ(known("labjack-u6", "usb:any"), "");
    EXPECT_TRUE(may_be(stick, station_of(block("dracal-usbtenki", "x", "usb:A99999"))).empty());
}

/// docs/instruments/labjack-u6.md: the number of a U6 is told by ConfigU6, not to the kernel.
TEST_F(Plugged, DeviceThatTellsItsNumberOnlyWhenOpenedMayBeTheOneThatIsMeant) {
    tree.usb("1-1", {"0cd5", "0006", "LabJack U6"});
    const PluggedDevice u6 = only();
    const std::string by_number = block("labjack-u6", "bar", "usb:470012345");
    EXPECT_EQ(known_as(u6, station_of(by_number)), "");
    EXPECT_EQ(may_be(u6, station_of(by_number)), std::vector<std::string>{"bar"});
    EXPECT_EQ(may_be(u6, station_of(by_number + block("labjack-u6", "probe", "usb:470099999"))),
              (std::vector<std::string>{"bar", "probe"}));
    const std::string by_socket = block("labjack-u6", "probe", "usb-port:1-1");
    EXPECT_TRUE(may_be(u6, station_of(by_number + by_socket)).empty()) << "it is the probe";
    EXPECT_TRUE(may_be(u6, station_of(block("labjack-u6", "bar", "usb-port:1-2"))).empty());
    EXPECT_TRUE(may_be(u6, station_of(block("dracal-usbtenki", "air", "usb:A10234"))).empty());
}

/// A TEMPer has no serial number at all: a link with one means no such stick.
TEST_F(Plugged, DeviceWithoutAnyNumberIsNotTakenForANumberedOne) {
    tree.hidraw(tree.usb("1-4", {"413d", "2107"}), "hidraw1");
    EXPECT_TRUE(may_be(only(), station_of(block("temper", "screw", "usb:A1"))).empty());
}

TEST_F(Plugged, LineToAddOfADeviceWithoutANumberNamesItsSocketAndTheOtherWay) {
    tree.usb("1-1", {"0cd5", "0006", "LabJack U6"});
    const PluggedDevice u6 = only();
    const std::string added = toml_block(u6, *could_be(u6).front(), {});
    EXPECT_NE(added.find("link = \"usb-port:1-1\"   # its socket; or \"usb:\""), std::string::npos)
        << added;
    EXPECT_EQ(known_as(u6, station_of(added)), "ballbar");
}

TEST_F(Plugged, NameOfABlockIsNoneOfTheStations) {
    tree.usb("1-1", {"0cd5", "0006", "LabJack U6"});
    const auto station = station_of("[[instrument]]\nname = \"ballbar\"\n[[instrument]]\nname = "
                                    "\"ballbar-2\"\n");
    const PluggedDevice u6 = only();
    EXPECT_NE(toml_block(u6, *could_be(u6).front(), station).find("name = \"ballbar-3\""),
              std::string::npos);
}

TEST_F(Plugged, NothingIsFoundWhereThereIsNoSysfs) {
    EXPECT_TRUE(list_plugged({"/nonexistent", "/nonexistent"}).empty());
}

/// A device as each wire has it, of the driver's own number where it has one.
PluggedDevice device_for(const Appearance& shows) {
    PluggedDevice device;
    device.wire = shows.wire;
    device.node = "/dev/counter0";
    device.sensors = {"28-0000075b3c2a"};
    device.link = shows.wire == Wire::serial ? "serial:/dev/ttyUSB0"
                  : shows.wire == Wire::can  ? "can:can0"
                                             : "usb:any";
    return device;
}

/// The line of the udev rules that gives terminals of these numbers to the service.
bool has_rule(const std::string& rules, const UsbId& id) {
    char vendor[40], product[40];
    std::snprintf(vendor, sizeof vendor, "ATTRS{idVendor}==\"%04x\"", unsigned{id.vendor});
    std::snprintf(product, sizeof product, "ATTRS{idProduct}==\"%04x\"", unsigned{id.product});
    std::istringstream lines{rules};
    for (std::string line; std::getline(lines, line);)
        if (line.find("AXISCAL_NAME") != std::string::npos &&
            line.find(vendor) != std::string::npos &&
            (line.find(product) != std::string::npos ||
             line.find("idProduct") == std::string::npos))
            return true;
    return false;
}

TEST(Appearances, OfTerminalsHaveARuleEach) {
    std::ifstream file{test::source_dir() + "/systemd/70-axiscal.rules"};
    const std::string rules{std::istreambuf_iterator<char>{file}, {}};
    for (const InstrumentDriver& driver : instrument_drivers()) {
        if (driver.shows == nullptr || driver.shows->wire != Wire::serial) continue;
        for (const UsbId& id : driver.shows->ids)
            EXPECT_TRUE(has_rule(rules, id))
                << driver.name << std::hex << " " << id.vendor << ":" << id.product;
    }
}

TEST(Appearances, GiveBlocksThatTheirDriversAccept) {
    ::setenv("AXISCAL_PROFILE_PATH", (test::source_dir() + "/config/profiles").c_str(), 1);
    for (const InstrumentDriver& driver : instrument_drivers()) {
        ASSERT_NE(driver.shows, nullptr) << driver.name << " says nothing of how it is found";
        if (driver.shows->wire == Wire::tcp) continue;
        std::string block = toml_block(device_for(*driver.shows), driver, {});
        const std::string driver_line = "driver = \"" + std::string{driver.name} + "\"\n";
        ASSERT_NE(block.find(driver_line), std::string::npos) << block;
        block = block.substr(block.find(driver_line) + driver_line.size());
        const auto made = testing::make_instrument(std::string{driver.name}, block);
        EXPECT_NE(made.instrument, nullptr);
        for (const Refusal& refusal : made.refusals)
            ADD_FAILURE() << driver.name << ": " << refusal.describe() << "\n" << block;
    }
}

} // namespace
} // namespace axiscal::plugged_test

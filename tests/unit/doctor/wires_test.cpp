// What the doctor says of the wires of a station, out of folders laid out as sysfs is.
#include "tests/support/sysfs_tree.hpp"
#include "tools/axiscal/doctor/doctor.hpp"

#include <gtest/gtest.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::doctor_wires_test {
namespace {

constexpr std::string_view health_letters = "gnb"; // good, note, broken

class DoctorWires : public ::testing::Test {
protected:
    DoctorWires() {
        checked.service.name = "axiscal";
        checked.service.user = ::geteuid() + 1; // owns no node, is in no group
    }
    void add(const std::string& name, const std::string& driver, const std::string& link) {
        checked.wires.instruments.push_back({name, driver, link, {}});
    }
    [[nodiscard]] std::vector<Finding> findings() const {
        DoctorPlaces places;
        places.kernel = {tree.sysfs(), tree.dev()};
        return check_wires(checked, places);
    }
    /// One letter for each finding, in their order.
    [[nodiscard]] std::string health() const {
        std::string letters;
        for (const Finding& finding : findings())
            letters += health_letters[static_cast<std::size_t>(finding.health)];
        return letters;
    }
    /// The node of the only device on the USB bus, as usbfs names it.
    [[nodiscard]] std::string usb_node(int number) const {
        return tree.dev() + "/bus/usb/001/00" + std::to_string(number);
    }
    static void allow(const std::string& node, bool allowed) {
        ASSERT_EQ(::chmod(node.c_str(), allowed ? 0666 : 0600), 0);
    }
    testing::SysfsTree tree;
    CheckedSystem checked;
};

/// The block of docs/instruments/labjack-u6.md on a U6 as the kernel sees it: without a number.
TEST_F(DoctorWires, InstrumentWhoseNumberIsToldOnlyWhenOpenedIsNotBroken) {
    tree.usb("1-3", {"0cd5", "0006", "LabJack U6"});
    allow(usb_node(1), true);
    add("ballbar", "labjack-u6", "usb:470012345");
    ASSERT_EQ(health(), "n");
    const Finding note = findings()[0];
    EXPECT_NE(note.what.find("\"ballbar\" (usb:470012345) may be the one at USB port 1-3"),
              std::string::npos)
        << note.what;
    EXPECT_NE(note.what.find("can be read only when it is opened"), std::string::npos) << note.what;
    EXPECT_FALSE(note.mend.empty());
}

TEST_F(DoctorWires, RightsOfADeviceThatMayBeMeantAreLookedAt) {
    tree.usb("1-3", {"0cd5", "0006", "LabJack U6"});
    allow(usb_node(1), false);
    add("ballbar", "labjack-u6", "usb:470012345");
    ASSERT_EQ(health(), "bn");
    EXPECT_NE(findings()[0].what.find(usb_node(1)), std::string::npos) << findings()[0].what;
    EXPECT_NE(findings()[0].mend.find("0cd5:0006"), std::string::npos) << findings()[0].mend;
}

TEST_F(DoctorWires, DeviceThatIsAnotherInstrumentIsNotTakenForTheMissingOne) {
    tree.usb("1-3", {"0cd5", "0006", "LabJack U6"});
    allow(usb_node(1), true);
    add("ballbar", "labjack-u6", "usb:470012345");
    add("probe", "labjack-u6", "usb-port:1-3");
    ASSERT_EQ(health(), "bg");
    EXPECT_NE(findings()[0].what.find("\"ballbar\" is not plugged in"), std::string::npos);
}

TEST_F(DoctorWires, InstrumentThatIsThereAndOpenToTheServiceIsGood) {
    tree.terminal(tree.usb("1-1", {"0403", "6001", "FT232R", "A600AXIS"}), "ttyUSB0", "ftdi_sio");
    allow(tree.dev() + "/ttyUSB0", true);
    add("air", "vaisala", "serial:" + tree.dev() + "/ttyUSB0");
    ASSERT_EQ(health(), "g");
    EXPECT_NE(findings()[0].what.find("\"air\" is plugged in at " + tree.dev() + "/ttyUSB0"),
              std::string::npos)
        << findings()[0].what;
}

TEST_F(DoctorWires, NodeThatTheServiceMayNotOpenIsBroken) {
    tree.terminal(tree.usb("1-1", {"16c0", "0483", "USB Serial", "7391230"}), "ttyACM0", "cdc_acm");
    allow(tree.dev() + "/ttyACM0", false);
    add("laser", "umd", "serial:" + tree.dev() + "/ttyACM0");
    ASSERT_EQ(health(), "b");
    const Finding told = findings()[0];
    EXPECT_EQ(told.area, "wire");
    EXPECT_NE(told.what.find("\"laser\": the user axiscal may not open"), std::string::npos)
        << told.what;
    EXPECT_NE(told.what.find("0600"), std::string::npos) << told.what;
    EXPECT_NE(told.mend.find("16c0:0483"), std::string::npos) << told.mend;
}

TEST_F(DoctorWires, AdapterThatHoldsBytesBackIsANote) {
    const auto interface = tree.usb("1-1", {"0403", "6001", "FT232R", "A600AXIS"});
    tree.terminal(interface, "ttyUSB0", "ftdi_sio");
    allow(tree.dev() + "/ttyUSB0", true);
    testing::SysfsTree::write(interface / "ttyUSB0/latency_timer", "16"); // as the kernel sets it
    add("air", "vaisala", "serial:" + tree.dev() + "/ttyUSB0");
    ASSERT_EQ(health(), "n");
    EXPECT_NE(findings()[0].what.find("16 ms instead of 1 ms"), std::string::npos)
        << findings()[0].what;
    EXPECT_NE(findings()[0].mend.find("udev rule"), std::string::npos) << findings()[0].mend;
}

TEST_F(DoctorWires, EverythingInTheWayOfOneInstrumentIsTold) {
    const auto interface = tree.usb("1-1", {"0403", "6001", "FT232R", "A600AXIS"});
    tree.terminal(interface, "ttyUSB0", "ftdi_sio");
    testing::SysfsTree::write(interface / "ttyUSB0/latency_timer", "16");
    allow(tree.dev() + "/ttyUSB0", false);
    add("air", "vaisala", "serial:" + tree.dev() + "/ttyUSB0");
    EXPECT_EQ(health(), "bn");
}

TEST_F(DoctorWires, InterfaceThatIsDownIsBroken) {
    tree.can(tree.usb("1-1", {"1d50", "606f", "candleLight"}), "can0", "0x40080");
    add("ballbar", "canopen-406", "can:can0");
    ASSERT_EQ(health(), "b");
    EXPECT_NE(findings()[0].mend.find("ip link set can0 up"), std::string::npos);
}

TEST_F(DoctorWires, LineOfTheCncIsLookedAtLikeAnInstrument) {
    const std::string line = tree.dev() + "/ttyS0";
    checked.wires.trigger_line = line;
    ASSERT_EQ(health(), "b");
    EXPECT_NE(
        findings()[0].what.find("the CNC's serial line " + line + " does not exist on this PC"),
        std::string::npos);
    tree.built_in("ttyS0", "4");
    allow(line, false);
    ASSERT_EQ(health(), "b");
    EXPECT_NE(findings()[0].what.find("\"trigger\": the user axiscal may not open " + line),
              std::string::npos)
        << findings()[0].what;
    EXPECT_NE(findings()[0].mend.find("usermod -aG dialout axiscal"), std::string::npos);
    allow(line, true);
    EXPECT_EQ(health(), "g");
}

/// A pseudo terminal or a radio link: no hardware that the kernel could tell of.
TEST_F(DoctorWires, BareTerminalIsLookedAtForItsRightsAlone) {
    const std::string bare = tree.dev() + "/line";
    testing::SysfsTree::write(bare, "");
    add("air", "vaisala", "serial:" + bare);
    allow(bare, true);
    EXPECT_EQ(health(), "g");
    allow(bare, false);
    EXPECT_EQ(health(), "b");
}

TEST_F(DoctorWires, OnlyWhatIsAbsentIsNotPluggedIn) {
    add("air", "vaisala", "serial:" + tree.dev() + "/ttyUSB0");
    add("far", "ids", "tcp:192.0.2.7:9090"); // an address of documentation, RFC 5737
    ASSERT_EQ(health(), "bg");
    EXPECT_NE(findings()[0].what.find("\"air\" is not plugged in"), std::string::npos);
}

} // namespace
} // namespace axiscal::doctor_wires_test

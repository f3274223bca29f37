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
        patient.service.name = "axiscal";
        patient.service.user = ::geteuid() + 1; // owns no node, is in no group
    }
    void add(const std::string& name, const std::string& driver, const std::string& link) {
        patient.wires.instruments.push_back({name, driver, link, {}});
    }
    [[nodiscard]] std::vector<Finding> findings() const {
        DoctorPlaces places;
        places.kernel = {tree.sysfs(), tree.dev()};
        return check_wires(patient, places);
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
    Patient patient;
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
    EXPECT_NE(note.what.find("told only when it is opened"), std::string::npos) << note.what;
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

} // namespace
} // namespace axiscal::doctor_wires_test

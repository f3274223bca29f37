// Which of the devices that are plugged in is meant; sysfs is a folder of files here.
#include "drivers/wire/usb_place.hpp"
#include "tests/support/scratch_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace axiscal::usb_place_test {
namespace {

class UsbPlaces : public ::testing::Test {
protected:
    void plug(const std::string& port,
              const std::string& vendor,
              const std::string& product,
              const std::string& serial,
              const std::string& name = "",
              const std::string& its_class = "ff") {
        const auto device = std::filesystem::path{folder_.path()} / "bus/usb/devices" / port;
        std::filesystem::create_directories(device);
        const auto write = [&](const char* file, const std::string& text) {
            if (!text.empty()) std::ofstream{device / file} << text << "\n";
        };
        write("idVendor", vendor);
        write("idProduct", product);
        write("bDeviceClass", its_class);
        write("busnum", "1");
        write("devnum", "12");
        write("serial", serial);
        write("product", name);
    }
    Result<UsbEntry> choose(const UsbPlace& place) {
        return choose_usb(place, list_usb(folder_.path()));
    }
    UsbPlace u6{{{0x0CD5, 0x0006}}};

private:
    testing::ScratchFolder folder_;
};

TEST_F(UsbPlaces, AreListedByPortWithWhatTheKernelKnows) {
    plug("1-2.4", "0cd5", "0006", "", "LabJack U6");
    plug("usb1", "1d6b", "0002", "0000:00:14.0", "xHCI", "09");
    const auto entry = choose(u6);
    ASSERT_TRUE(entry) << describe(entry.error());
    EXPECT_EQ(entry->port, "1-2.4");
    EXPECT_EQ(entry->bus, 1);
    EXPECT_EQ(entry->address, 12);
    EXPECT_EQ(entry->name, "LabJack U6");
}

TEST_F(UsbPlaces, AreNoneWithoutUsb) {
    EXPECT_TRUE(list_usb("/nonexistent").empty());
    const auto entry = choose(u6);
    ASSERT_FALSE(entry);
    EXPECT_EQ(entry.error().fault, Fault::link_closed);
    EXPECT_NE(entry.error().detail.find("0cd5:0006"), std::string::npos);
}

TEST_F(UsbPlaces, AreToldApartBySerialNumber) {
    const UsbPlace any{{{0x1781, 0x0A98, "USBTenki"}}};
    plug("1-1", "1781", "0a98", "A10001", "USBTenki");
    plug("1-3", "1781", "0a98", "A10003", "USBTenki");
    UsbPlace second = any;
    second.serial = "A10003";
    EXPECT_EQ(choose(second)->port, "1-3");
    const auto either = choose(any);
    ASSERT_FALSE(either);
    EXPECT_EQ(either.error().fault, Fault::bad_configuration);
    EXPECT_NE(either.error().detail.find("usb:A10001 or usb-port:1-1"), std::string::npos)
        << either.error().detail;
    second.serial = "A10009";
    EXPECT_EQ(choose(second).error().fault, Fault::link_closed);
}

TEST_F(UsbPlaces, AreToldApartByPortAndByTheirOrder) {
    plug("1-3", "0cd5", "0006", "");
    plug("1-1", "0cd5", "0006", "");
    UsbPlace place = u6;
    place.port = "1-3";
    EXPECT_EQ(choose(place)->port, "1-3");
    place = u6;
    place.nth = 0;
    EXPECT_EQ(choose(place)->port, "1-1");
    place.nth = 1;
    EXPECT_EQ(choose(place)->port, "1-3");
    place.nth = 2;
    EXPECT_EQ(choose(place).error().fault, Fault::link_closed);
}

TEST_F(UsbPlaces, AreNotTakenForDevicesThatShareTheirNumbers) {
    const UsbPlace tenki{{{0x1781, 0x0A98, "USBTenki"}, {0x289B, 0, "", 0xFF}}};
    plug("1-1", "1781", "0a98", "X1", "another maker's device");
    plug("1-2", "289b", "0505", "E18890", "VCP-PTH450", "02"); // a serial line
    EXPECT_FALSE(choose(tenki));
    plug("1-3", "289b", "0101", "E20001", "USB-PTH450", "ff");
    EXPECT_EQ(choose(tenki)->serial, "E20001");
}

} // namespace
} // namespace axiscal::usb_place_test

// HID devices as the kernel lists them; sysfs is a folder of files and links here.
#include "drivers/wire/hid_place.hpp"
#include "tests/support/scratch_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace axiscal::hid_place_test {
namespace {

/// The kernel keeps all HID devices in one folder, those on USB as links into their device's.
class HidPlaces : public ::testing::Test {
protected:
    static void write(const std::filesystem::path& file, const std::string& text) {
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file} << text << "\n";
    }
    void add(const std::string& place, const std::string& name) {
        const auto devices = root() / "bus/hid/devices";
        std::filesystem::create_directories(devices);
        std::filesystem::create_directories(root() / "devices" / place / name);
        std::filesystem::create_directory_symlink(root() / "devices" / place / name,
                                                  devices / name);
    }
    [[nodiscard]] std::filesystem::path root() const { return folder_.path(); }
    UsbPlace temper{{{0x413D, 0x2107}}};

private:
    testing::ScratchFolder folder_;
};

TEST_F(HidPlaces, WithoutUsbAreThereUnderTheKernelsName) {
    add("virtual/misc/uhid", "0003:413D:2107.001F");
    write(root() / "devices/virtual/misc/uhid/0003:413D:2107.001F/uevent",
          "DRIVER=hid-generic\nHID_ID=0003:0000413D:00002107\nHID_NAME=stick\nHID_UNIQ=7");
    const auto entry = choose_usb(temper, list_hid(root().string()));
    ASSERT_TRUE(entry) << describe(entry.error());
    EXPECT_EQ(entry->port, "0003:413D:2107.001F");
    EXPECT_EQ(entry->address, 0x1F);
    EXPECT_EQ(entry->name, "stick");
    EXPECT_EQ(entry->serial, "7");
}

TEST_F(HidPlaces, OnUsbAreThereOnce) {
    add("usb1/1-2/1-2:1.1", "0003:413D:2107.0005");
    write(root() / "devices/usb1/1-2/idVendor", "413d");
    write(root() / "devices/usb1/1-2/idProduct", "2107");
    std::filesystem::create_directories(root() / "bus/usb/devices");
    std::filesystem::create_directory_symlink(root() / "devices/usb1/1-2",
                                              root() / "bus/usb/devices/1-2");
    const auto plugged = list_hid(root().string());
    ASSERT_EQ(plugged.size(), 1U);
    EXPECT_EQ(plugged[0].port, "1-2");
}

/// The kernel writes class and number in hexadecimal. A stick whose last interface it can not serve
/// has that interface all the same.
TEST_F(HidPlaces, TheLastInterfaceIsTheDevicesOwnWhetherServedOrNot) {
    const auto device = root() / "bus/usb/devices/1-2";
    write(device / "1-2:1.0/bInterfaceClass", "03");
    write(device / "1-2:1.0/bInterfaceNumber", "00");
    write(device / "1-2:1.10/bInterfaceClass", "03");
    write(device / "1-2:1.10/bInterfaceNumber", "0a");
    write(device / "1-2:1.11/bInterfaceClass", "ff");
    write(device / "1-2:1.11/bInterfaceNumber", "0b");
    write(device / "idVendor", "413d");
    EXPECT_EQ(last_hid_interface("1-2", root().string()), 10);
    EXPECT_EQ(last_hid_interface("0003:413D:2107.001F", root().string()), -1);
}

} // namespace
} // namespace axiscal::hid_place_test

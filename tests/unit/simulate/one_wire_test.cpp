// The simulated 1-Wire cable and its adapter against the data sheets: the DS18B20's table of
// temperatures and power-on scratchpad, application note 27's ROM code, application note 117's
// descriptors, and the requests of the kernel's ds2490.
#include "wire/usb/ds9490r_device.hpp"
#include "wire/usb/usb_descriptors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal::simulate::one_wire_test {
namespace {

using How = UsbAnswer::How;

TEST(OneWireRom, EndsWithTheChecksumOfTheApplicationNote) {
    // Application note 27, figure 2: family 02, serial number 00000001B81C, CRC A2.
    EXPECT_EQ(one_wire_rom(0x02, 0x00000001B81C),
              (OneWireRom{0x02, 0x1C, 0xB8, 0x01, 0x00, 0x00, 0x00, 0xA2}));
}

class Thermometer : public ::testing::Test {
protected:
    static Bytes scratchpad(Ds18b20Chip& one) {
        select(one);
        one.byte(0xBE);
        Bytes read;
        for (int i = 0; i < 9; ++i)
            read.push_back(one.byte(0xFF));
        return read;
    }
    static Bytes converted(Ds18b20Chip& one) {
        select(one);
        one.byte(0x44);
        return scratchpad(one);
    }
    static void select(Ds18b20Chip& one) {
        one.reset();
        one.byte(0x55);
        for (const std::uint8_t byte : one.rom())
            one.byte(byte);
    }
    double celsius = 25.0625;
    Ds18b20Chip chip{1, 12, [this] { return celsius; }};
    const Bytes power_on{0x50, 0x05, 0x4B, 0x46, 0x7F, 0xFF, 0x0C, 0x10, 0x1C};
};

TEST_F(Thermometer, ShowsThePowerOnValueUntilItHasConverted) {
    EXPECT_EQ(scratchpad(chip), power_on);
    EXPECT_NE(converted(chip), power_on);
}

TEST_F(Thermometer, HasTheTemperaturesOfTheDataSheetsTable) {
    struct Row {
        double celsius;
        std::uint8_t low, high;
    };
    for (const Row& row :
         {Row{125, 0xD0, 0x07}, Row{85, 0x50, 0x05}, Row{25.0625, 0x91, 0x01},
          Row{10.125, 0xA2, 0x00}, Row{0.5, 0x08, 0x00}, Row{0, 0x00, 0x00}, Row{-0.5, 0xF8, 0xFF},
          Row{-10.125, 0x5E, 0xFF}, Row{-25.0625, 0x6F, 0xFE}, Row{-55, 0x90, 0xFC}}) {
        celsius = row.celsius;
        const Bytes read = converted(chip);
        EXPECT_EQ(read[0], row.low) << row.celsius;
        EXPECT_EQ(read[1], row.high) << row.celsius;
    }
}

TEST_F(Thermometer, LeavesTheBitsBelowItsResolutionZero) {
    Ds18b20Chip coarse{1, 9, [] { return -10.125; }};
    const Bytes read = converted(coarse);
    EXPECT_EQ(read[0], 0x58); // -10.5 degC: bits 2 to 0 of FF5E are not there
    EXPECT_EQ(read[1], 0xFF);
    EXPECT_EQ(read[4], 0x1F);
}

TEST_F(Thermometer, KeepsQuietWhenAnotherIsMeant) {
    chip.reset();
    chip.byte(0x55);
    for (const std::uint8_t byte : one_wire_rom(0x28, 2))
        chip.byte(byte);
    chip.byte(0xBE);
    EXPECT_EQ(chip.byte(0xFF), 0xFF);
}

TEST_F(Thermometer, WithoutPowerStartsAnewInsteadOfConverting) {
    converted(chip);
    chip.suffer(OneWireTrouble::power_lost);
    EXPECT_EQ(converted(chip), power_on);
}

class Adapter : public ::testing::Test {
protected:
    Adapter() {
        auto bus = std::make_unique<OneWireBus>();
        for (std::uint64_t serial = 1; serial <= 2; ++serial)
            bus->add(std::make_unique<Ds18b20Chip>(serial, 12, [] { return 25.0625; }));
        device = std::make_unique<Ds9490rDevice>(std::move(bus));
        device->plugged();
    }
    How communicate(std::uint16_t value, std::uint16_t index) {
        return device->control({0x40, 1, value, index, 0}, {}).how;
    }
    Bytes touched(const Bytes& bytes) {
        EXPECT_EQ(device->out(2, bytes).how, How::done);
        EXPECT_EQ(communicate(0x0075, static_cast<std::uint16_t>(bytes.size())), How::done);
        return device->in(3, bytes.size()).bytes;
    }
    /// As w1_therm reads a scratchpad through ds2490.
    Bytes scratchpad_of(std::uint64_t serial) {
        communicate(0x0043, 0);
        Bytes match{0x55};
        for (const std::uint8_t byte : one_wire_rom(0x28, serial))
            match.push_back(byte);
        EXPECT_EQ(touched(match), match);
        communicate(0x0053, 0xBE);
        EXPECT_EQ(device->in(3, 1).bytes, Bytes{0xBE});
        return touched(Bytes(9, 0xFF));
    }
    std::unique_ptr<Ds9490rDevice> device;
};

TEST_F(Adapter, HasFourSettingsOfOneInterface) {
    const Bytes told = configuration_descriptor(device->descriptors());
    EXPECT_EQ(told.size(), 9U + 4 * (9 + 3 * 7));
    EXPECT_EQ(told[4], 1); // interfaces
    const std::size_t last = 9 + 3 * 30;
    EXPECT_EQ((Bytes{told.begin() + last, told.begin() + last + 5}), (Bytes{9, 4, 0, 3, 3}));
    EXPECT_EQ((Bytes{told.begin() + last + 9, told.begin() + last + 16}),
              (Bytes{7, 5, 0x81, 3, 32, 0, 1}));
    EXPECT_EQ((Bytes{told.begin() + last + 23, told.begin() + last + 30}),
              (Bytes{7, 5, 0x83, 2, 64, 0, 0}));
}

TEST_F(Adapter, FindsEverySensorAndItself) {
    EXPECT_EQ(device->out(2, Bytes(8, 0)).how, How::done);
    EXPECT_EQ(communicate(0x49FD, 0x40F0), How::done);
    const Bytes state = device->in(1, 32).bytes;
    ASSERT_EQ(state.size(), 16U);
    EXPECT_EQ(state[8], 0x20); // idle
    EXPECT_EQ(state[13], 24);
    const Bytes found = device->in(3, 128).bytes;
    ASSERT_EQ(found.size(), 24U);
    EXPECT_TRUE(std::ranges::equal(one_wire_rom(0x28, 1), Bytes{found.begin(), found.begin() + 8}));
    EXPECT_EQ(found[16], 0x81);
    EXPECT_EQ(device->in(3, 128).how, How::hold);
}

TEST_F(Adapter, ReadsTheSensorThatIsMeant) {
    EXPECT_EQ(scratchpad_of(2), (Bytes{0x50, 0x05, 0x4B, 0x46, 0x7F, 0xFF, 0x0C, 0x10, 0x1C}));
    EXPECT_EQ(scratchpad_of(3), Bytes(9, 0xFF));
    EXPECT_EQ(communicate(0x0029, 0), How::done); // a slot for the answer to "read power supply"
    EXPECT_EQ(device->in(3, 1).bytes, Bytes{1});
}

TEST_F(Adapter, SuffersWhatItIsTold) {
    ASSERT_TRUE(device->obey("wrong-crc:2"));
    EXPECT_EQ(scratchpad_of(2)[0], 0x58);
    ASSERT_TRUE(device->obey("broken:2"));
    EXPECT_EQ(scratchpad_of(2), Bytes(9, 0xFF));
    ASSERT_TRUE(device->obey("mended:2"));
    ASSERT_TRUE(device->obey("shorted"));
    communicate(0x0053, 0xBE);
    EXPECT_EQ(device->in(3, 1).bytes, Bytes{0});
    for (const char* word : {"power-lost", "power-lost:3", "power-lost:0", "sings"})
        EXPECT_FALSE(device->obey(word)) << word;
}

TEST_F(Adapter, LosesItsBufferToAReaderOfLess) {
    EXPECT_EQ(device->out(2, Bytes(4, 0xFF)).how, How::done);
    EXPECT_EQ(communicate(0x0075, 4), How::done);
    EXPECT_EQ(device->in(3, 3).how, How::stall);
    EXPECT_EQ(device->in(3, 4).how, How::hold);
}

} // namespace
} // namespace axiscal::simulate::one_wire_test

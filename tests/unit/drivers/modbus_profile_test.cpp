#include "drivers/environment/modbus_profile.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace axiscal {
namespace {

const std::string shipped = test::source_dir() + "/config/profiles";

ModbusField field(WordType type, bool low_word_first = false) {
    ModbusField made;
    made.type = type;
    made.low_word_first = low_word_first;
    made.count = type == WordType::s32 || type == WordType::u32 || type == WordType::f32 ? 2 : 1;
    return made;
}
std::optional<double> decode(std::vector<std::uint16_t> words, const ModbusField& as) {
    return decode_words(words, as);
}

TEST(ModbusWords, AreReadAsTheirType) {
    EXPECT_EQ(decode({0x0131}, field(WordType::u16)), 305);
    EXPECT_EQ(decode({0xFF33}, field(WordType::s16)), -205);
    EXPECT_EQ(decode({0xFF33}, field(WordType::u16)), 65331);
    EXPECT_EQ(decode({0x0001, 0xE240}, field(WordType::u32)), 123456);
    EXPECT_EQ(decode({0xFFFF, 0xFFFB}, field(WordType::s32)), -5);
    EXPECT_EQ(decode({0xFFFB, 0xFFFF}, field(WordType::s32, true)), -5);
}

/// 20.0 = 41A0 0000 (high word first); 30.56 = 41F4 7AE1 sent low word first as 7AE1 41F4.
TEST(ModbusWords, AreReadAsFloatsInBothWordOrders) {
    EXPECT_EQ(decode({0x41A0, 0x0000}, field(WordType::f32)), 20.0);
    EXPECT_NEAR(decode({0x7AE1, 0x41F4}, field(WordType::f32, true)).value(), 30.56, 1e-5);
    EXPECT_FALSE(decode({0x7FC0, 0x0000}, field(WordType::f32)));
    EXPECT_FALSE(decode({0x7F80, 0x0000}, field(WordType::f32)));
}

TEST(ModbusWords, AreReadAsDecimalDigits) {
    ModbusField serial = field(WordType::bcd);
    serial.count = 2;
    EXPECT_EQ(decode({0x1694, 0x0123}, serial), 16940123);
    EXPECT_FALSE(decode({0x169A, 0x0123}, serial));
    EXPECT_FALSE(decode({0x1694}, serial));
}

TEST(ModbusProfile, EveryShippedProfileIsAccepted) {
    for (const char* name :
         {"xy-md02", "tm-th8", "m-7015", "comet-t7510", "comet-t7310", "vaisala-indigo",
          "vaisala-hmp", "labjack-t7-thermocouple", "labjack-t7-lvdt"}) {
        const auto profile = load_profile(find_profile(name, {shipped}).value());
        ASSERT_TRUE(profile) << describe(profile.error());
        EXPECT_FALSE(profile->model.empty());
        EXPECT_FALSE(profile->channels.empty());
    }
}

/// Of the golden vectors: 30.5 degC = 0131; 24.5 degC and 54.6 % = 00F5 0222; FF33 = -20.5 degC.
TEST(ModbusProfile, ScalesTheXyMd02) {
    const auto profile = load_profile(shipped + "/xy-md02.toml").value();
    const auto value = [&](std::size_t channel, std::uint16_t word) {
        return channel_value(std::vector<std::uint16_t>{word}, profile.channels[channel]);
    };
    EXPECT_DOUBLE_EQ(value(0, 0x0131).value(), 30.5);
    EXPECT_DOUBLE_EQ(value(0, 0x00F5).value(), 24.5);
    EXPECT_DOUBLE_EQ(value(0, 0xFF33).value(), -20.5);
    EXPECT_DOUBLE_EQ(value(1, 0x0222).value(), 54.6);
    EXPECT_FALSE(value(0, 0x7FFF));
    EXPECT_FALSE(value(1, 0x8000));
}

TEST(ModbusProfile, GivesCometsPressureInPascalAndNoErrorValues) {
    const auto profile = load_profile(shipped + "/comet-t7510.toml").value();
    const auto& pressure = profile.channels[2];
    EXPECT_NEAR(channel_value(std::vector<std::uint16_t>{10132}, pressure).value(), 101320, 1e-9);
    EXPECT_FALSE(
        channel_value(std::vector<std::uint16_t>{static_cast<std::uint16_t>(-9999)}, pressure));
    EXPECT_EQ(profile.channels[0].channel.medium, Medium::air);
}

TEST(ModbusProfile, GivesTheContactChannelsAsMaterial) {
    const auto profile = load_profile(shipped + "/tm-th8.toml").value();
    ASSERT_EQ(profile.channels.size(), 2u);
    for (const auto& channel : profile.channels)
        EXPECT_EQ(channel.channel.medium, Medium::material);
    EXPECT_FALSE(channel_value(std::vector<std::uint16_t>{0x7FFF}, profile.channels[0]));
}

TEST(ModbusProfile, JoinsNeighboursAndNeverReadsAcrossAGap) {
    const auto air = register_blocks(load_profile(shipped + "/xy-md02.toml").value());
    ASSERT_EQ(air.size(), 1u);
    EXPECT_EQ(air[0].address, 1);
    EXPECT_EQ(air[0].count, 2);
    const auto comet = register_blocks(load_profile(shipped + "/comet-t7510.toml").value());
    ASSERT_EQ(comet.size(), 2u);
    EXPECT_EQ(comet[0].count, 2);
    EXPECT_EQ(comet[1].address, 0x34);
}

TEST(ModbusProfile, NamesTheKnownOnesWhenOneIsMissing) {
    const auto missing = find_profile("comet", {"/nowhere", shipped});
    ASSERT_FALSE(missing);
    for (const char* known : {"comet-t7310, comet-t7510", "tm-th8", "xy-md02"})
        EXPECT_NE(missing.error().detail.find(known), std::string::npos) << missing.error().detail;
}

TEST(ModbusProfile, IsRefusedWithFileAndLine) {
    testing::ScratchFolder scratch;
    const std::string path = scratch.path() + "/bad.toml";
    std::ofstream{path} << "maker = \"M\"\nmodel = \"X\"\nspeed = 1\n[[channel]]\nname = \"t\"\n"
                           "medium = \"air\"\nunit = \"furlong\"\nfunction = 7\naddress = 1\n"
                           "type = \"s16\"\n";
    const auto profile = load_profile(path);
    ASSERT_FALSE(profile);
    for (const char* word : {"bad.toml:3", "bad.toml:7", "bad.toml:8"})
        EXPECT_NE(profile.error().detail.find(word), std::string::npos) << profile.error().detail;
}

TEST(ModbusProfile, KeysOfTheStationFileAreChecked) {
    const auto made = testing::make_instrument(
        "modbus", "profile = \"" + shipped +
                      "/tm-th8.toml\"\nlink = \"serial:/dev/ttyUSB0\"\n"
                      "unit_id = 3\naddress_offset = 1\npoll_period = \"2 s\"\nbaud = 19200\n");
    EXPECT_TRUE(made.refusals.empty());
    const auto wrong = testing::make_instrument(
        "modbus", "profile = \"nothing\"\nlink = \"serial:/dev/ttyUSB0\"\naddress_offset = 5\n");
    EXPECT_EQ(wrong.refusals.size(), 2u);
}

} // namespace
} // namespace axiscal

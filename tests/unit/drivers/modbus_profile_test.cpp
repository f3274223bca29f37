#include "drivers/environment/modbus_profile.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

#include <fstream>

namespace axiscal::modbus_profile_test {
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

using Bytes = std::vector<std::uint8_t>;

/// Function, first address and number of registers or bits: a request without unit number and
/// checksum.
Bytes request_of(const RegisterBlock& block) {
    const auto high = [](int number) { return static_cast<std::uint8_t>(number >> 8); };
    const auto low = [](int number) { return static_cast<std::uint8_t>(number & 255); };
    return {low(block.function), high(block.address), low(block.address), high(block.count),
            low(block.count)};
}
/// The registers of a reply: function, number of bytes, then each register, its high byte first.
std::vector<std::uint16_t> words_of(const Bytes& reply) {
    std::vector<std::uint16_t> words;
    for (std::size_t at = 2; at + 1 < reply.size(); at += 2)
        words.push_back(static_cast<std::uint16_t>(reply[at] * 256 + reply[at + 1]));
    return words;
}
/// What the channels of a profile with one block make of a reply.
std::vector<std::optional<double>> values_of(const ModbusProfile& profile, const Bytes& reply) {
    const std::vector<std::uint16_t> words = words_of(reply);
    std::vector<std::optional<double>> values;
    for (const ModbusChannel& channel : profile.channels) {
        const auto begin =
            static_cast<std::size_t>(channel.field.address - profile.channels[0].field.address);
        const auto count = static_cast<std::size_t>(channel.field.count);
        values.push_back(channel_value(std::span{words}.subspan(begin, count), channel));
    }
    return values;
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

/// The maker's tM-TH8 manual, 3.7: 30001 on are the inputs (wire 0 on), read by function 04;
/// engineering format: 00E1 = 225 is 22.5 degC, FFF3 = -13 is -1.3, 04B0 = 1200 is 120.0; 8000 =
/// -32768 is under and 7FFF = 32767 over the range.
TEST(ModbusProfile, ReadsSixInputsOfTheM7015AtOnce) {
    const auto profile = load_profile(shipped + "/m-7015.toml").value();
    const auto blocks = register_blocks(channel_fields(profile));
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(request_of(blocks[0]), (Bytes{0x04, 0x00, 0x00, 0x00, 0x06}));
    const auto values = values_of(profile, {0x04, 0x0C, 0x00, 0xE1, 0xFF, 0xF3, 0x00, 0x00, 0x80,
                                            0x00, 0x7F, 0xFF, 0x04, 0xB0});
    ASSERT_EQ(values.size(), 6u);
    EXPECT_DOUBLE_EQ(values[0].value(), 22.5);
    EXPECT_DOUBLE_EQ(values[1].value(), -1.3);
    EXPECT_DOUBLE_EQ(values[2].value(), 0.0);
    EXPECT_FALSE(values[3]);
    EXPECT_FALSE(values[4]);
    EXPECT_FALSE(values[5]); // 120 degC: no machine hall; 49 degC in Fahrenheit
}

/// The maker's map: AIN#_EF_READ_A at 7000 + 2 n = 1B58 hex, FLOAT32. 41BA0000: exponent 131 - 127
/// = 4, fraction 3A0000 / 800000 = 0.453125, 1.453125 x 16 = 23.25. C61C3C00 is -9999 in the map's
/// own words (TEST_FLOAT32).
TEST(ModbusProfile, ReadsTwoThermocouplesOfTheT7AtOnce) {
    const auto profile = load_profile(shipped + "/labjack-t7-thermocouple.toml").value();
    const auto blocks = register_blocks(channel_fields(profile));
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(request_of(blocks[0]), (Bytes{0x03, 0x1B, 0x58, 0x00, 0x04}));
    const auto values =
        values_of(profile, {0x03, 0x08, 0x41, 0xBA, 0x00, 0x00, 0xC6, 0x1C, 0x3C, 0x00});
    ASSERT_EQ(values.size(), 2u);
    EXPECT_DOUBLE_EQ(values[0].value(), 23.25);
    EXPECT_FALSE(values[1]);
}

/// The maker's map: SERIAL_NUMBER at 60028 = EA7C hex, UINT32 as its TEST register, whose 0011 2233
/// is 1122867: 17 x 65536 + 8755.
TEST(ModbusProfile, ReadsTheSerialNumberOfTheT7) {
    for (const char* name : {"/labjack-t7-thermocouple.toml", "/labjack-t7-lvdt.toml"}) {
        const auto profile = load_profile(shipped + name).value();
        ASSERT_TRUE(profile.serial_number) << name;
        const ModbusField& place = profile.serial_number.value();
        EXPECT_EQ(request_of({place.function, place.address, place.count, {}}),
                  (Bytes{0x03, 0xEA, 0x7C, 0x00, 0x02}));
        EXPECT_EQ(decode(words_of({0x03, 0x04, 0x00, 0x11, 0x22, 0x33}), place), 1122867);
    }
}

/// The maker's map: AIN# at 2 n, FLOAT32, volts. 40200000: 1.25 x 2 = 2.5 V are 0.25 mm; C1200000:
/// -1.25 x 8 = -10 V are -1 mm; C1280000: -1.3125 x 8 = -10.5 V are beyond the conditioner's range.
TEST(ModbusProfile, ReadsVoltsOfTheT7AsALength) {
    const auto profile = load_profile(shipped + "/labjack-t7-lvdt.toml").value();
    const auto blocks = register_blocks(channel_fields(profile));
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(request_of(blocks[0]), (Bytes{0x03, 0x00, 0x00, 0x00, 0x02}));
    const auto length_m = [&](std::uint8_t high, std::uint8_t low) {
        return values_of(profile, {0x03, 0x04, high, low, 0x00, 0x00})[0];
    };
    EXPECT_NEAR(length_m(0x40, 0x20).value(), 0.25e-3, 1e-15);
    EXPECT_NEAR(length_m(0xC1, 0x20).value(), -1e-3, 1e-15);
    EXPECT_FALSE(length_m(0xC1, 0x28));
}

TEST(ModbusProfile, JoinsNeighboursAndNeverReadsAcrossAGap) {
    const auto channel_blocks = [](const std::string& name) {
        return register_blocks(channel_fields(load_profile(shipped + name).value()));
    };
    const auto air = channel_blocks("/xy-md02.toml");
    ASSERT_EQ(air.size(), 1u);
    EXPECT_EQ(air[0].address, 1);
    EXPECT_EQ(air[0].count, 2);
    const auto comet = channel_blocks("/comet-t7510.toml");
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

TEST(ModbusProfile, SettingsHaveAPlaceANumberAndChannels) {
    testing::ScratchFolder scratch;
    const std::string path = scratch.path() + "/set.toml";
    const std::string head = "maker = \"M\"\nmodel = \"X\"\n[[channel]]\nname = \"t\"\n"
                             "medium = \"air\"\nunit = \"degC\"\nfunction = 4\naddress = 1\n"
                             "type = \"s16\"\n[[setting]]\nname = \"s\"\n";
    const auto told = [&](const std::string& keys) {
        std::ofstream{path} << head << keys;
        const auto profile = load_profile(path);
        return profile ? std::string{} : profile.error().detail;
    };
    EXPECT_EQ(told("function = 1\naddress = 266\nmust_be = 1\n"), "");
    EXPECT_EQ(told("function = 3\naddress = 1\ntype = \"f32\"\nmust_be = 0.5\n"), "");
    EXPECT_NE(told("function = 1\naddress = 266\n").find("must_be"), std::string::npos);
    EXPECT_NE(told("function = 1\naddress = 1\nmust_be = 1\ntype = \"s16\"\n").find("type"),
              std::string::npos);
    const auto unknown = told("function = 2\naddress = 1\nmust_be = 1\nchannels = [\"u\"]\n");
    EXPECT_NE(unknown.find("\"u\" is no channel of this profile; known: t"), std::string::npos)
        << unknown;
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

TEST(ModbusProfile, ThatIsRefusedSaysNothingOfTheChannels) {
    InstrumentConfig config;
    config.channels.push_back({});
    config.channels.back().channel = "contact 1";
    setenv("AXISCAL_PROFILE_PATH", shipped.c_str(), 1);
    for (const char* profile : {"profile = \"tm-th9\"\n", "profile = \"\"\n", ""}) {
        const auto made = testing::make_instrument(
            "modbus", profile + std::string{"link = \"serial:/dev/ttyUSB0\"\n"}, config);
        ASSERT_EQ(made.refusals.size(), 1u) << profile;
        EXPECT_EQ(made.refusals.front().key, "profile");
    }
    const auto near = testing::make_instrument(
        "modbus", "profile = \"tm-th9\"\nlink = \"serial:/dev/ttyUSB0\"\n", config);
    EXPECT_NE(near.refusals.front().reason.find("did you mean \"tm-th8\"?"), std::string::npos)
        << near.refusals.front().reason;
}

} // namespace
} // namespace axiscal::modbus_profile_test

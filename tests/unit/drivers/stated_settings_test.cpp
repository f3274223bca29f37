// What the shipped profiles ask their instruments, and which numbers leave a channel without
// values. Addresses and numbers: the documents that the profiles name.
#include "drivers/environment/stated_settings.hpp"
#include "tests/support/source_dir.hpp"

#include <gtest/gtest.h>

namespace axiscal::stated_settings_test {
namespace {

using Words = std::vector<std::uint16_t>;

ModbusProfile shipped(const std::string& name) {
    return load_profile(test::source_dir() + "/config/profiles/" + name + ".toml").value();
}

struct Block {
    int function, address;
    Words words;
};

/// A sensor whose settings were all read, as `blocks` in the order of their addresses.
StatedSettings read(const std::string& profile, const std::vector<Block>& blocks) {
    StatedSettings settings{shipped(profile)};
    EXPECT_EQ(settings.blocks().size(), blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const RegisterBlock& block = settings.blocks().at(i);
        EXPECT_EQ(block.function, blocks[i].function);
        EXPECT_EQ(block.address, blocks[i].address);
        EXPECT_EQ(static_cast<std::size_t>(block.count), blocks[i].words.size());
        settings.take(block, blocks[i].words);
    }
    return settings;
}

TEST(StatedSettings, LeaveNoValueBeforeTheyAreRead) {
    EXPECT_TRUE(StatedSettings{shipped("xy-md02")}.spoils(0));
    EXPECT_TRUE(StatedSettings{shipped("xy-md02")}.spoils(1));
    EXPECT_FALSE(StatedSettings{shipped("comet-t7510")}.spoils(0)) << "has none that can be read";
}

// "Temperature correction value (/10) -10.0 to 10.0" at 0x0103, of the humidity at 0x0104.
TEST(StatedSettings, OfAnXyMd02AreItsOwnCorrections) {
    const auto as_delivered = read("xy-md02", {{3, 0x0103, {0, 0}}});
    EXPECT_FALSE(as_delivered.spoils(0));
    EXPECT_FALSE(as_delivered.spoils(1));
    const auto colder = read("xy-md02", {{3, 0x0103, {0xFFFB, 0}}}); // -0.5 K
    EXPECT_TRUE(colder.spoils(0));
    EXPECT_FALSE(colder.spoils(1));
    const auto drier = read("xy-md02", {{3, 0x0103, {0, 0xFFE2}}}); // -3 %
    EXPECT_FALSE(drier.spoils(0));
    EXPECT_TRUE(drier.spoils(1));
}

// 3.7: 00267 scale (0 Fahrenheit, 1 Celsius), 00269 format (0 hex, 1 engineering), 40449 on
// temperature offsets in tenths.
TEST(StatedSettings, OfATmTh8AreScaleFormatAndOffsets) {
    const auto spoilt = [](std::uint16_t celsius, std::uint16_t engineering, Words offsets) {
        const auto settings = read(
            "tm-th8", {{1, 266, {celsius}}, {1, 268, {engineering}}, {3, 448, std::move(offsets)}});
        return std::pair{settings.spoils(0), settings.spoils(1)};
    };
    EXPECT_EQ(spoilt(1, 1, {0, 0}), std::pair(false, false));
    EXPECT_EQ(spoilt(0, 1, {0, 0}), std::pair(true, true));
    EXPECT_EQ(spoilt(1, 0, {0, 0}), std::pair(true, true));
    EXPECT_EQ(spoilt(1, 1, {0, 0xFF80}), std::pair(false, true)); // -12.8 K
}

TEST(StatedSettings, OfAnM7015IsItsFormat) {
    EXPECT_FALSE(read("m-7015", {{1, 268, {1}}}).spoils(5));
    EXPECT_TRUE(read("m-7015", {{1, 268, {0}}}).spoils(5));
}

// M212022EN, revision K: 0200 error status (1 no errors), 0201 online (0 locked), 0207 and 0208
// status of humidity and temperature (0 OK, 0020 locked, 0080 sensor failure).
TEST(StatedSettings, OfAVaisalaProbeAreItsStatusRegisters) {
    for (const char* profile : {"vaisala-hmp", "vaisala-indigo"}) {
        const auto temperature = [&](Words errors, Words of_values) {
            return read(profile,
                        {{3, 0x0200, std::move(errors)}, {3, 0x0207, std::move(of_values)}})
                .spoils(0);
        };
        EXPECT_FALSE(temperature({1, 1}, {0, 0}));
        EXPECT_TRUE(temperature({0, 1}, {0, 0}));
        EXPECT_TRUE(temperature({1, 0}, {0, 0}));
        EXPECT_TRUE(temperature({1, 1}, {0, 0x0080}));
        EXPECT_FALSE(temperature({1, 1}, {0x0020, 0}));
        EXPECT_TRUE(read(profile, {{3, 0x0200, {1, 1}}, {3, 0x0207, {0x0020, 0}}}).spoils(1));
    }
}

// AIN#_EF_INDEX at 9000 + 2 n (22: type K), AIN#_EF_CONFIG_A at 9300 + 2 n (1: Celsius), UINT32.
TEST(StatedSettings, OfALabJackT7AreTypeAndUnitOfEachInput) {
    const auto spoilt = [](Words index, Words unit) {
        const auto settings = read("labjack-t7-thermocouple",
                                   {{3, 9000, std::move(index)}, {3, 9300, std::move(unit)}});
        return std::pair{settings.spoils(0), settings.spoils(1)};
    };
    EXPECT_EQ(spoilt({0, 22, 0, 22}, {0, 1, 0, 1}), std::pair(false, false));
    EXPECT_EQ(spoilt({0, 22, 0, 21}, {0, 1, 0, 1}), std::pair(false, true)); // type J
    EXPECT_EQ(spoilt({0, 22, 0, 22}, {0, 0, 0, 1}), std::pair(true, false)); // kelvin
    EXPECT_EQ(spoilt({0, 22, 0, 22}, {0, 2, 0, 2}), std::pair(true, true));  // Fahrenheit
}

TEST(StatedSettings, AreToldOnceForEachNumberWithPlaceAndWayOut) {
    StatedSettings settings{shipped("xy-md02")};
    const RegisterBlock& block = settings.blocks().at(0);
    const auto told = settings.take(block, Words{5, 0});
    ASSERT_EQ(told.size(), 1u);
    for (const char* word : {"XY-MD02: own temperature correction (holding register 0x0103) is 5",
                             "must be 0", "no value of air temperature", "copy of the profile"})
        EXPECT_NE(told[0].find(word), std::string::npos) << told[0];
    EXPECT_TRUE(settings.take(block, Words{5, 0}).empty());
    EXPECT_EQ(settings.take(block, Words{6, 0}).size(), 1u);
    EXPECT_TRUE(settings.take(block, Words{0, 0}).empty());
    EXPECT_FALSE(settings.spoils(0));
    EXPECT_EQ(settings.take(block, Words{6, 0}).size(), 1u) << "wrong again";
    settings.forget();
    EXPECT_EQ(settings.take(block, Words{6, 0}).size(), 1u) << "opened anew";
}

/// A float of 1e30 (7149 F2CA): no whole number holds it.
TEST(StatedSettings, AreToldWhateverTheRegistersHold) {
    ModbusProfile profile = shipped("xy-md02");
    profile.settings.resize(1);
    profile.settings[0].field = {3, 0, 2, WordType::f32, false};
    StatedSettings settings{profile};
    const auto told = settings.take(settings.blocks().at(0), Words{0x7149, 0xF2CA});
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find(" is 1000000"), std::string::npos) << told[0];
}

TEST(StatedSettings, ThatAreNeverShownAreTakenAsStatedAndThatAreHiddenLaterAreNot) {
    StatedSettings settings{shipped("xy-md02")};
    const RegisterBlock& block = settings.blocks().at(0);
    EXPECT_EQ(settings.refuse(block, "exception 2").size(), 2u);
    EXPECT_TRUE(settings.refuse(block, "exception 2").empty());
    EXPECT_FALSE(settings.spoils(0));
    settings.take(block, Words{0, 0});
    EXPECT_EQ(settings.refuse(block, "exception 4").size(), 2u);
    EXPECT_TRUE(settings.spoils(0));
    EXPECT_TRUE(settings.refuse(block, "exception 4").empty());
}

} // namespace
} // namespace axiscal::stated_settings_test

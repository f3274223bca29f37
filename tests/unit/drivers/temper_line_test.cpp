// Literal answers as urwen/temper prints them of a stick with firmware TEMPerX232_V2.0, and the
// driver's run through a probe that is pulled and a button that was not held.
#include "drivers/environment/temper_line.hpp"
#include "tests/support/made_instrument.hpp"

#include <gtest/gtest.h>

namespace axiscal::temper_line_test {
namespace {

constexpr std::string_view printed = "Temp-Inner:30.53 [C],39.92 [%RH]<";

TEST(TemperLine, ReadsTheLineThatIsPrinted) {
    const auto line = parse_temper_line(printed);
    ASSERT_TRUE(line);
    EXPECT_FALSE(line->probe);
    EXPECT_DOUBLE_EQ(line->temperature_degC.value(), 30.53);
    EXPECT_TRUE(line->has_humidity);
    EXPECT_DOUBLE_EQ(line->humidity_percent.value(), 39.92);
}

TEST(TemperLine, ReadsAProbeWithoutHumidityBelowZero) {
    const auto line = parse_temper_line("Temp-Outer:-5.12 [C]<");
    ASSERT_TRUE(line);
    EXPECT_TRUE(line->probe);
    EXPECT_DOUBLE_EQ(line->temperature_degC.value(), -5.12);
    EXPECT_FALSE(line->has_humidity);
}

TEST(TemperLine, TellsFahrenheitInDegreesCelsius) {
    EXPECT_NEAR(parse_temper_line("Temp-Inner:68.00 [F],39.92 [%RH]<")->temperature_degC.value(),
                20.0, 1e-12);
}

TEST(TemperLine, HasNoNumberForDashesAndTheImpossible) {
    const auto dashes = parse_temper_line("Temp-Outer:--.-- [C]<");
    ASSERT_TRUE(dashes);
    EXPECT_EQ(dashes->temperature_degC, std::nullopt);
    const auto wet = parse_temper_line("Temp-Inner:126.00 [C],100.01 [%RH]<");
    ASSERT_TRUE(wet);
    EXPECT_EQ(wet->temperature_degC, std::nullopt);
    EXPECT_TRUE(wet->has_humidity);
    EXPECT_EQ(wet->humidity_percent, std::nullopt);
}

/// There is no checksum: a digit that became another one passes, any other damage does not.
TEST(TemperLine, RefusesEveryDamagedByteThatIsNoDigit) {
    for (std::size_t at = 0; at < printed.size(); ++at) {
        if (printed[at] >= '0' && printed[at] <= '9') continue;
        for (const int bit : {1, 2, 4, 8, 16, 32, 64, 128}) {
            std::string damaged{printed};
            damaged[at] = static_cast<char>(damaged[at] ^ bit);
            EXPECT_FALSE(parse_temper_line(damaged)) << damaged;
        }
    }
}

TEST(TemperLine, RefusesALineThatWasCutAnywhere) {
    for (std::size_t length = 0; length < printed.size(); ++length) {
        EXPECT_FALSE(parse_temper_line(printed.substr(0, length))) << length;
        if (length > 0) {
            EXPECT_FALSE(parse_temper_line(printed.substr(length))) << length;
        }
    }
}

TEST(TemperLine, RefusesANumberThatLostAPlaceBehindThePoint) {
    for (const char* const text :
         {"Temp-Inner:30.5 [C],39.92 [%RH]<", "Temp-Inner:3053 [C]<", "Temp-Inner:.53 [C]<",
          "Temp-Inner:3053.00 [C]<", "Temp-Inner: 30.53 [C]<", "Temp-Inner:30.53 [K]<"})
        EXPECT_EQ(parse_temper_line(text).error().fault, Fault::bad_frame) << text;
}

TEST(TemperLine, ReadsWhatTheStickAddsByItself) {
    const auto none = parse_temper_calibration("Inner-Calib:0.0 [C],0.0 [%RH]");
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->probe);
    EXPECT_EQ(none->temperature_K, 0);
    const auto probe = parse_temper_calibration("Outer-Calib:-10.0 [C],2.5 [%RH]");
    ASSERT_TRUE(probe);
    EXPECT_TRUE(probe->probe);
    EXPECT_DOUBLE_EQ(probe->temperature_K, -10.0);
    EXPECT_DOUBLE_EQ(probe->humidity_percent, 2.5);
    EXPECT_FALSE(parse_temper_calibration(printed));
    EXPECT_FALSE(parse_temper_calibration("Inner-Calib:0.0 [C]"));
}

TEST(TemperLine, FindsTheNameBehindWhatCameBefore) {
    EXPECT_EQ(temper_version("TEMPerX232_V2.0\r\n"), "TEMPerX232_V2.0");
    EXPECT_EQ(temper_version("TEMPerX232_V2.0"), "TEMPerX232_V2.0");
    EXPECT_EQ(temper_version("Temp-Inner:30.53 [C]<\r\nTEMPerX232_V2.0\r\n"), "TEMPerX232_V2.0");
    EXPECT_EQ(temper_version("ERROR\r\n"), "");
}

TEST(TemperSerial, LeavesTheMediumOfItsTemperaturesToTheStationFile) {
    const auto stick = testing::instrument("temper-serial", "link = \"serial:/dev/null\"\n");
    ASSERT_EQ(stick->channels().size(), 4U);
    EXPECT_EQ(stick->channels().front().name, "probe temperature");
    EXPECT_EQ(stick->channels().front().medium, Medium::none);
}

TEST(TemperSerial, IsPolledNoFasterThanTwiceASecond) {
    const auto made = testing::make_instrument(
        "temper-serial", "link = \"serial:/dev/null\"\npoll_period = \"100 ms\"\n");
    ASSERT_EQ(made.refusals.size(), 1U);
    EXPECT_NE(made.refusals.front().key.find("poll_period"), std::string::npos);
}

} // namespace
} // namespace axiscal::temper_line_test

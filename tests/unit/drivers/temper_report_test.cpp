// Literal reports of TEMPer sticks, as open drivers know them.
#include "drivers/environment/temper_report.hpp"
#include "drivers/framing/byte_order.hpp"

#include <gtest/gtest.h>

namespace axiscal::temper_report_test {
namespace {

std::vector<std::byte> text(std::string_view letters) {
    const auto bytes = std::as_bytes(std::span{letters});
    return {bytes.begin(), bytes.end()};
}
TemperFamily family(std::string_view firmware) {
    return temper_family(firmware).value();
}

TEST(TemperFirmware, IsReadFromItsReports) {
    EXPECT_EQ(temper_firmware(text("TEMPerX_V3.3    ")), "TEMPerX_V3.3");
    EXPECT_EQ(temper_firmware(text("TEMPer1F_H1V1.5F\0\0")), "TEMPer1F_H1V1.5F");
    EXPECT_EQ(temper_firmware(bytes_of({0x80, 0x40, 0x09})), "");
}

TEST(TemperFirmware, IsRefusedWhenUnknownAndShownInHexadecimal) {
    const auto unknown = temper_family("TEMPerZ_9");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().fault, Fault::unknown_instrument);
    EXPECT_NE(unknown.error().detail.find("54454d506572"), std::string::npos);
    EXPECT_FALSE(temper_family(""));
    EXPECT_FALSE(temper_family("TEMPerX_V3.4"));
}

TEST(TemperReading, IsInHundredthsForNewSticks) {
    const auto gold = family("TEMPerGold_V3.1");
    const auto warm = decode_temper_reading(bytes_of({0x80, 0x40, 0x09, 0x85, 0, 0, 0, 0}), gold);
    EXPECT_DOUBLE_EQ(warm.stick_temperature.value(), 24.37);
    EXPECT_FALSE(warm.probe_temperature);
    const auto cold = decode_temper_reading(bytes_of({0x80, 0x40, 0xFE, 0x00, 0, 0, 0, 0}), gold);
    EXPECT_DOUBLE_EQ(cold.stick_temperature.value(), -5.12);
}

TEST(TemperReading, IsIn256ThsForOldSticks) {
    const auto reading =
        decode_temper_reading(bytes_of({0x80, 0x02, 0x18, 0x80, 0, 0, 0, 0}), family("TEMPerF1.4"));
    EXPECT_EQ(reading.stick_temperature, 24.5);
}

TEST(TemperReading, HasTheProbeInTheSecondReport) {
    const auto reading = decode_temper_reading(bytes_of({0x80, 0x40, 0x09, 0x85, 0x13, 0x88, 0, 0,
                                                         0x80, 0x01, 0x07, 0xD0, 0x4E, 0x20, 0, 0}),
                                               family("TEMPerX_V3.3"));
    EXPECT_DOUBLE_EQ(reading.stick_temperature.value(), 24.37);
    EXPECT_DOUBLE_EQ(reading.stick_humidity.value(), 50);
    EXPECT_DOUBLE_EQ(reading.probe_temperature.value(), 20);
    EXPECT_FALSE(reading.probe_humidity);
}

// A TEMPerX_V3.3 whose probe answers first: byte 1 tells whose report it is, not the order.
TEST(TemperReading, GoesByTheHeadOfEachReport) {
    const auto x = family("TEMPerX_V3.3");
    const auto reading = decode_temper_reading(bytes_of({0x80, 0x01, 0x07, 0xD0, 0x4E, 0x20, 0, 0,
                                                         0x80, 0x40, 0x09, 0x85, 0x13, 0x88, 0, 0}),
                                               x);
    EXPECT_DOUBLE_EQ(reading.stick_temperature.value(), 24.37);
    EXPECT_DOUBLE_EQ(reading.stick_humidity.value(), 50);
    EXPECT_DOUBLE_EQ(reading.probe_temperature.value(), 20);
    EXPECT_EQ(reading.bad_reports, 0);
    const auto alone =
        decode_temper_reading(bytes_of({0x80, 0x01, 0x07, 0xD0, 0x4E, 0x20, 0, 0}), x);
    EXPECT_FALSE(alone.stick_temperature);
    EXPECT_DOUBLE_EQ(alone.probe_temperature.value(), 20);
}

TEST(TemperReading, TakesNoReportWithAnotherHeadForAValue) {
    const auto x = family("TEMPerX_V3.3");
    const auto text = decode_temper_reading(bytes_of({'T', 'E', 'M', 'P', 'e', 'r', 'X', '_', //
                                                      0x80, 0x40, 0x09, 0x85, 0x13, 0x88, 0, 0}),
                                            x);
    EXPECT_DOUBLE_EQ(text.stick_temperature.value(), 24.37);
    EXPECT_FALSE(text.probe_temperature);
    EXPECT_EQ(text.bad_reports, 1);
    const auto other = decode_temper_reading(bytes_of({0x80, 0x33, 0x09, 0x85, 0, 0, 0, 0}), x);
    EXPECT_FALSE(other.stick_temperature);
    EXPECT_EQ(other.bad_reports, 1);
    const auto twice = decode_temper_reading(bytes_of({0x80, 0x01, 0x07, 0xD0, 0x4E, 0x20, 0, 0,
                                                       0x80, 0x01, 0x09, 0x85, 0x4E, 0x20, 0, 0}),
                                             x);
    EXPECT_FALSE(twice.stick_temperature);
    EXPECT_EQ(twice.bad_reports, 1);
    const auto old =
        decode_temper_reading(bytes_of({0x55, 0x02, 0x18, 0x80, 0, 0, 0, 0}), family("TEMPerF1.4"));
    EXPECT_FALSE(old.stick_temperature);
}

TEST(TemperReading, HasTheProbeWhereOthersHaveTheStickOnATemper1F) {
    const auto reading = decode_temper_reading(bytes_of({0x80, 0x40, 0x09, 0x85, 0, 0, 0, 0}),
                                               family("TEMPer1F_V3.9"));
    EXPECT_DOUBLE_EQ(reading.probe_temperature.value(), 24.37);
    EXPECT_FALSE(reading.stick_temperature);
}

TEST(TemperReading, FollowsTheSht20OfAnH1Stick) {
    // SHT20 data sheet: T = -46.85 + 175.72 S / 2^16, RH = -6 + 125 S / 2^16; raw << 2 and << 4.
    const auto reading = decode_temper_reading(bytes_of({0x80, 0x40, 0x18, 0xEB, 0x07, 0x2B, 0, 0}),
                                               family("TEMPer1F_H1V1.5F"));
    EXPECT_NEAR(reading.stick_temperature.value(), 21.57, 0.01); // 6379 x 4
    EXPECT_NEAR(reading.stick_humidity.value(), 50.0, 0.05);     // 1835 x 16
}

TEST(TemperReading, HasNoNumberForAnAbsentProbeOrAMissingReport) {
    const auto x = family("TEMPerX_V3.3");
    const auto unplugged = decode_temper_reading(
        bytes_of({0x80, 0x40, 0x09, 0x85, 0x13, 0x88, 0, 0, 0x80, 0x01, 0x4E, 0x20, 0, 0, 0, 0}),
        x);
    EXPECT_FALSE(unplugged.probe_temperature);
    EXPECT_FALSE(
        decode_temper_reading(bytes_of({0x80, 0x40, 0x09, 0x85, 0, 0, 0, 0}), x).probe_temperature);
    EXPECT_FALSE(
        decode_temper_reading(bytes_of({0x80, 0x40, 0x7F, 0xFF, 0, 0, 0, 0}), x).stick_temperature);
    EXPECT_FALSE(decode_temper_reading({}, x).stick_temperature);
}

} // namespace
} // namespace axiscal::temper_report_test

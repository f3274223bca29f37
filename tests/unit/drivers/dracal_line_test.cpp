// Literal lines: published by the vendor's users (first) and the vendor's sample program.
#include "drivers/environment/dracal_line.hpp"

#include <gtest/gtest.h>

namespace axiscal::dracal_line_test {
namespace {

constexpr std::string_view reading = "D,VCP-PTH450,E18890,,101182,Pa,24.8344,C,59.8779,%,*3FB5";
constexpr std::string_view reading_lower =
    "D,VCP-PTH450-CAL,E24638,,99688,Pa,21.77,C,49.98,%,*3a8d";
constexpr std::string_view acknowledge =
    "I,VCP-PTH450-CAL,E24638,Poll interval set to 1000 ms,*cdea";

TEST(DracalLine, ReadsAPublishedReading) {
    const auto body = verify_dracal_line(reading);
    ASSERT_TRUE(body);
    const auto line = parse_dracal_line(*body);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->kind, 'D');
    EXPECT_EQ(line->product, "VCP-PTH450");
    EXPECT_EQ(line->serial, "E18890");
    EXPECT_EQ(line->message, "");
    ASSERT_EQ(line->pairs.size(), 3u);
    EXPECT_EQ(line->pairs[0].value, 101182);
    EXPECT_EQ(line->pairs[0].unit, "Pa");
    EXPECT_EQ(line->pairs[1].value, 24.8344);
    EXPECT_EQ(line->pairs[2].unit, "%");
}

TEST(DracalLine, AcceptsBothCasesOfTheChecksum) {
    EXPECT_TRUE(verify_dracal_line(reading_lower));
    std::string upper{reading_lower};
    upper.replace(upper.size() - 4, 4, "3A8D");
    EXPECT_TRUE(verify_dracal_line(upper));
    EXPECT_TRUE(verify_dracal_line(acknowledge));
}

TEST(DracalLine, RefusesEveryDamagedByte) {
    for (std::size_t at = 0; at < reading.size() - 5; ++at) {
        std::string damaged{reading};
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        EXPECT_FALSE(verify_dracal_line(damaged)) << damaged;
    }
}

TEST(DracalLine, RefusesALineWithoutChecksum) {
    EXPECT_EQ(verify_dracal_line("D,VCP-PTH450,E18890,,1,Pa,").error().fault, Fault::bad_frame);
    EXPECT_EQ(verify_dracal_line("D,VCP-PTH450,E18890,,1,Pa,*3F").error().fault, Fault::bad_frame);
    EXPECT_EQ(verify_dracal_line("D,VCP-PTH450,E18890,,1,Pa,*zzzz").error().fault,
              Fault::bad_frame);
    EXPECT_EQ(verify_dracal_line("").error().fault, Fault::bad_frame);
}

TEST(DracalLine, ReadsAnAcknowledgement) {
    const auto line = parse_dracal_line(verify_dracal_line(acknowledge).value());
    ASSERT_TRUE(line);
    EXPECT_EQ(line->kind, 'I');
    EXPECT_EQ(line->serial, "E24638");
    EXPECT_EQ(line->message, "Poll interval set to 1000 ms");
    EXPECT_TRUE(line->pairs.empty());
}

TEST(DracalLine, ReadsTheTableOfInfo) {
    const auto line = parse_dracal_line("I,Product ID,Serial Number,Message,MS5611 Pressure,Pa,"
                                        "SHT31 Temperature,C,SHT31 Relative Humidity,%,");
    ASSERT_TRUE(line);
    EXPECT_EQ(line->labels, (std::vector<std::string>{"MS5611 Pressure", "Pa", "SHT31 Temperature",
                                                      "C", "SHT31 Relative Humidity", "%"}));
}

TEST(DracalLine, StoresValuesInStoredUnits) {
    EXPECT_EQ(stored_reading({101182.0, "Pa"})->value, 101182);
    EXPECT_DOUBLE_EQ(stored_reading({101.182, "kPa"})->value.value(), 101182);
    EXPECT_DOUBLE_EQ(stored_reading({68.0, "F"})->value.value(), 20);
    EXPECT_EQ(stored_reading({59.8779, "%"})->kind, ChannelKind::humidity);
    EXPECT_FALSE(stored_reading({1.0, "V"}));
}

TEST(DracalLine, HasNoNumberForAnAbsentSensor) {
    const auto line = parse_dracal_line("D,VCP-PTH450,E18890,,,Pa,nan,C,Err,%,");
    ASSERT_TRUE(line);
    for (const auto& pair : line->pairs) {
        EXPECT_FALSE(pair.value) << pair.unit;
        EXPECT_FALSE(stored_reading(pair)->value);
    }
    EXPECT_FALSE(stored_reading({-273.15, "C"})->value);
    EXPECT_FALSE(stored_reading({0.0, "Pa"})->value);
}

} // namespace
} // namespace axiscal::dracal_line_test

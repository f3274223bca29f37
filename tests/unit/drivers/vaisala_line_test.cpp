// Literal messages: the default reply of the user's guide; its checksums worked out by hand from
// their definition (exclusive or; sum modulo 65536).
#include "drivers/environment/vaisala_line.hpp"
#include "tests/support/made_instrument.hpp"

#include <gtest/gtest.h>

namespace axiscal::vaisala_line_test {
namespace {

constexpr std::string_view reply = "P= 1013.2 hPa T= 31.1 'C RH= 38.3 %RH";

TEST(VaisalaLine, ReadsTheReplyOfTheUsersGuide) {
    const auto reading = parse_vaisala_line(reply);
    ASSERT_TRUE(reading);
    EXPECT_DOUBLE_EQ(reading->pressure_Pa.value(), 101320);
    EXPECT_DOUBLE_EQ(reading->temperature_degC.value(), 31.1);
    EXPECT_DOUBLE_EQ(reading->humidity_percent.value(), 38.3);
}

TEST(VaisalaLine, TakesTheRightChecksumsOnly) {
    const std::string text{reply};
    EXPECT_EQ(verify_vaisala_line(text + "35", VaisalaChecksum::csx).value(), reply);
    EXPECT_EQ(verify_vaisala_line(text + "07EB", VaisalaChecksum::cs4).value(), reply);
    EXPECT_EQ(verify_vaisala_line(text + "07eb", VaisalaChecksum::cs4).value(), reply);
    EXPECT_EQ(verify_vaisala_line(text, VaisalaChecksum::none).value(), reply);
    EXPECT_EQ(verify_vaisala_line(text + "36", VaisalaChecksum::csx).error().fault,
              Fault::checksum);
    EXPECT_EQ(verify_vaisala_line(text, VaisalaChecksum::csx).error().fault, Fault::bad_frame);
    EXPECT_EQ(verify_vaisala_line("35", VaisalaChecksum::csx).error().fault, Fault::bad_frame);
}

TEST(VaisalaLine, RefusesEveryDamagedByte) {
    for (const auto kind : {VaisalaChecksum::csx, VaisalaChecksum::cs4}) {
        const std::string whole =
            std::string{reply} + (kind == VaisalaChecksum::csx ? "35" : "07EB");
        for (std::size_t at = 0; at < whole.size(); ++at) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(damaged[at] ^ 1);
            EXPECT_FALSE(verify_vaisala_line(damaged, kind)) << damaged;
        }
    }
}

TEST(VaisalaLine, HasNoValueForAsterisksOtherUnitsAndTheImpossible) {
    const auto faulty = parse_vaisala_line("P= ****.* hPa T= 31.1 K RH=138.3 %RH");
    ASSERT_TRUE(faulty);
    EXPECT_EQ(faulty->pressure_Pa, std::nullopt);
    EXPECT_EQ(faulty->temperature_degC, std::nullopt); // K is no unit of these instruments
    EXPECT_EQ(faulty->humidity_percent, std::nullopt);
    const auto alone = parse_vaisala_line("P=  101.325 kPa");
    ASSERT_TRUE(alone);
    EXPECT_DOUBLE_EQ(alone->pressure_Pa.value(), 101325);
    EXPECT_EQ(alone->temperature_degC, std::nullopt);
    EXPECT_EQ(parse_vaisala_line("T= 31.1 'C").error().fault, Fault::bad_frame);
}

TEST(VaisalaLine, TakesFahrenheit) {
    EXPECT_NEAR(parse_vaisala_line("P= 1013.2 hPa T= 68.0 'F")->temperature_degC.value(), 20.0,
                1e-12);
}

TEST(Vaisala, MeasuresPressureAloneAsPtb330) {
    const std::string keys = "link = \"serial:/dev/null\"\nmodel = ";
    EXPECT_EQ(testing::instrument("vaisala", keys + "\"ptu300\"\n")->channels().size(), 3U);
    EXPECT_EQ(testing::instrument("vaisala", keys + "\"ptb330\"\n")->channels().size(), 1U);
}

} // namespace
} // namespace axiscal::vaisala_line_test

// Literal replies of USBTenki sensors, from the maker's open library and the data sheets of the
// chips.
#include "drivers/environment/tenki_reading.hpp"
#include "drivers/framing/byte_order.hpp"

#include <gtest/gtest.h>

namespace axiscal::tenki_reading_test {
namespace {

// MS5611-01BA03 data sheet, example of the calculation: C1..C6, low byte first.
std::vector<std::byte> data_sheet_words() {
    return bytes_of({0xBF, 0x9C, 0x3C, 0x90, 0x15, 0x5B, 0xF2, 0x5A, 0xB8, 0x82, 0x98, 0x6E});
}
TenkiCalibration data_sheet() {
    TenkiCalibration calibration;
    calibration.ms5611 = decode_ms5611_calibration(data_sheet_words()).value();
    return calibration;
}
std::optional<double> value_of_reply(int chip, std::initializer_list<int> reply) {
    const auto content = decode_tenki_reply(bytes_of(reply), 0x10);
    EXPECT_TRUE(content);
    return tenki_value(chip, *content, data_sheet());
}

TEST(TenkiReply, HoldsTheNumberOfChannels) {
    EXPECT_EQ(decode_tenki_reply(bytes_of({0x02, 0x03, 0x01}), 0x02).value(), bytes_of({3}));
}

TEST(TenkiReply, HoldsTheChipOfAChannel) {
    EXPECT_EQ(decode_tenki_reply(bytes_of({0x01, 0x20, 0x21}), 0x01).value(), bytes_of({0x20}));
}

TEST(TenkiReply, IsAnErrorOfTheSensorWhenItIsOneZero) {
    EXPECT_EQ(decode_tenki_reply(bytes_of({0x00}), 0x10).error().fault, Fault::refused);
}

TEST(TenkiReply, IsNoReplyWhenItIsEmptyOrOfAnotherCommand) {
    EXPECT_EQ(decode_tenki_reply({}, 0x10).error().fault, Fault::bad_frame);
    EXPECT_EQ(decode_tenki_reply(bytes_of({0x02, 0x03, 0x01}), 0x01).error().fault,
              Fault::bad_frame);
}

TEST(TenkiReply, IsRefusedForEveryDamagedByte) {
    const auto whole = bytes_of({0x10, 0x1A, 0xA2, 0x8A, 0x3E, 0xC1, 0x82, 0x5F});
    ASSERT_TRUE(decode_tenki_reply(whole, 0x10));
    for (std::size_t at = 0; at < whole.size(); ++at) {
        auto damaged = whole;
        damaged[at] ^= std::byte{0x20};
        EXPECT_EQ(decode_tenki_reply(damaged, 0x10).error().fault, Fault::checksum) << at;
    }
}

TEST(TenkiReading, IsTheTemperatureOfAnSht31) {
    EXPECT_NEAR(value_of_reply(0x20, {0x10, 0x66, 0x66, 0x10}).value(), 25.000, 1e-3);
}

TEST(TenkiReading, IsTheHumidityOfAnSht31) {
    // SHT3x data sheet, 4.13: RH = 100 raw / (2^16 - 1); half scale.
    EXPECT_NEAR(tenki_value(0x19, bytes_of({0x80, 0x00}), {}).value(), 50.0008, 1e-3);
}

TEST(TenkiReading, IsTheDataSheetsExampleOfAnMs5611) {
    // D1 = 9085466, D2 = 8569150: 20.07 degC, 1000.09 mbar.
    EXPECT_EQ(value_of_reply(0x15, {0x10, 0x1A, 0xA2, 0x8A, 0x3E, 0xC1, 0x82, 0x5F}), 100009);
    EXPECT_EQ(tenki_value(0x16, bytes_of({0x3E, 0xC1, 0x82}), data_sheet()), 20.07);
}

TEST(TenkiReading, CompensatesAColdMs5611ToTheSecondOrder) {
    // D2 = 8269150: dT = -297634, TEMP 995.47 (first order 9.95 degC), T2 = 41.25 -> 9.54 degC.
    EXPECT_NEAR(tenki_value(0x16, bytes_of({0x5E, 0x2D, 0x7E}), data_sheet()).value(), 9.54, 0.011);
}

TEST(TenkiReading, IsTheTemperatureOfAPt100OnThreeWires) {
    // R = Rref code / 2^23 / gain: 400 ohm, half scale, gain 2 -> 100 ohm -> 0 degC.
    EXPECT_NEAR(
        tenki_value(0x34, bytes_of({0x40, 0x00, 0x00, 0x01, 0x90, 0x10, 0x00, 0x00}), {}).value(),
        0, 1e-9);
}

TEST(TenkiReading, KnowsThePlatinumTableOfIec60751) {
    // IEC 60751:2008, table 1 (Pt100), rounded to 0.01 ohm there.
    for (const auto& [degC, ohm] :
         {std::pair{-200.0, 18.52}, std::pair{-100.0, 60.26}, std::pair{-50.0, 80.31},
          std::pair{0.0, 100.0}, std::pair{20.0, 107.79}, std::pair{100.0, 138.51},
          std::pair{850.0, 390.48}})
        EXPECT_NEAR(platinum_temperature(ohm, 100).value(), degC, 0.02) << ohm;
    EXPECT_FALSE(platinum_temperature(10, 100));
    EXPECT_FALSE(platinum_temperature(400, 100));
}

TEST(TenkiReading, TakesTheLeadsOffAPt100WithItsOwnSource) {
    // 110 ohm in the loop at 1.01 mA and gain 2: 111.1 mV / 7.8125 uV = 14221; 5 ohm a lead at gain
    // 8: 5.05 mV / 1.953125 uV = 2586. 100 ohm are left.
    TenkiCalibration calibration;
    calibration.pt100_current_A = 1.01e-3;
    const auto raw = bytes_of({0x00, 0x37, 0x8D, 0x00, 0x0A, 0x1A});
    EXPECT_NEAR(tenki_value(0x12, raw, calibration).value(), 0, 0.02);
}

TEST(TenkiReading, HasNoNumberForABrokenSensor) {
    EXPECT_FALSE(tenki_value(0x20, bytes_of({0xFF, 0xFF}), {}));
    EXPECT_FALSE(tenki_value(0x19, bytes_of({0x00, 0x00}), {}));
    EXPECT_FALSE(tenki_value(0x20, bytes_of({0x66}), {}));
    EXPECT_FALSE(tenki_value(0x15, bytes_of({0, 0, 0, 0x3E, 0xC1, 0x82}), data_sheet()));
    EXPECT_FALSE(tenki_value(0x15, bytes_of({0x1A, 0xA2, 0x8A, 0x3E, 0xC1, 0x82}), {}));
    EXPECT_FALSE(decode_ms5611_calibration(
        bytes_of({255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255})));
    EXPECT_FALSE(tenki_measure(0xFF));
}

} // namespace
} // namespace axiscal::tenki_reading_test

// Expected bytes: the vendor sheets' frames, CRC by the Modbus polynomial.
#include "wire/modbus_slave.hpp"
#include "wire/simulated_sensors.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::modbus_slave_test {
namespace {

Bytes ask(RegisterBank bank, const Bytes& frame) {
    EXPECT_TRUE(rtu_crc_right(frame));
    return rtu_frame(frame[0], answer_pdu(bank, std::span{frame}.subspan(1, frame.size() - 3)));
}

RegisterBank xy_md02(double celsius, double humidity) {
    Scenario scenario;
    scenario.air.temperature.start = celsius;
    scenario.air.humidity_percent.start = humidity;
    return sensor_bank(scenario, {"air", "xy-md02"}, 0);
}

TEST(ModbusSlave, AnswersTheVendorsTemperatureRequest) {
    const Bytes request{0x01, 0x04, 0x00, 0x01, 0x00, 0x01, 0x60, 0x0A};
    const Bytes reply{0x01, 0x04, 0x02, 0x01, 0x31, 0x79, 0x74};
    EXPECT_EQ(ask(xy_md02(30.5, 50), request), reply);
}

TEST(ModbusSlave, AnswersTemperatureAndHumidityTogether) {
    const Bytes request{0x01, 0x04, 0x00, 0x01, 0x00, 0x02, 0x20, 0x0B};
    const Bytes reply{0x01, 0x04, 0x04, 0x00, 0xF5, 0x02, 0x22, 0x6A, 0xCF};
    EXPECT_EQ(ask(xy_md02(24.5, 54.6), request), reply);
}

TEST(ModbusSlave, NegativeTemperatureIsTwosComplement) {
    EXPECT_EQ(xy_md02(-20.5, 50).input.at(1), 0xFF33);
}

TEST(ModbusSlave, MaterialModuleShowsItsChannelsInBothTables) {
    Scenario scenario;
    scenario.thermal.material.start = 23.04;
    scenario.thermal.sensor_difference_k = {0.1, -0.1};
    const RegisterBank bank = sensor_bank(scenario, {"material", "tm-th8"}, 0);
    EXPECT_EQ(bank.input.at(0), 231);
    EXPECT_EQ(bank.input.at(1), 229);
    EXPECT_EQ(bank.holding.at(0), 231);
    EXPECT_TRUE(bank.discretes.at(128 + 2)); // no sensor there
}

TEST(ModbusSlave, CometShowsPressureInTenthsOfHectopascal) {
    Scenario scenario;
    scenario.air.pressure_pa.start = 100250;
    const RegisterBank bank = sensor_bank(scenario, {"air", "comet"}, 0);
    EXPECT_EQ(bank.holding.at(0x34), 10025);
    RegisterBank asked = bank;
    EXPECT_EQ(answer_pdu(asked, Bytes{4, 0, 0x31, 0, 1}), (Bytes{0x84, 1})); // FC 3 only
}

TEST(ModbusSlave, VaisalaAnswersTheReadingOfItsUserGuide) {
    // M212287EN: 30.56 %RH is 41F47AE1, sent 7AE1 41F4.
    Scenario scenario;
    scenario.air.humidity_percent.start = 30.56;
    scenario.air.temperature.start = 21.5;
    RegisterBank bank = sensor_bank(scenario, {"air", "vaisala-hmp"}, 0);
    EXPECT_EQ(answer_pdu(bank, Bytes{3, 0, 0, 0, 2}), (Bytes{3, 4, 0x7A, 0xE1, 0x41, 0xF4}));
    EXPECT_EQ(answer_pdu(bank, Bytes{3, 0, 2, 0, 2}), (Bytes{3, 4, 0, 0, 0x41, 0xAC}));
}

TEST(ModbusSlave, LabJackHoldsFloatsHighWordFirst) {
    Scenario scenario;
    scenario.thermal.material.start = 20;
    scenario.thermal.sensor_difference_k = {0.0};
    RegisterBank bank = sensor_bank(scenario, {"material", "labjack-t7"}, 0);
    // 20.0 = 41A0 0000, and -9999 = C61C 3C00 where there is no sensor.
    EXPECT_EQ(answer_pdu(bank, Bytes{3, 0x1B, 0x58, 0, 4}),
              (Bytes{3, 8, 0x41, 0xA0, 0, 0, 0xC6, 0x1C, 0x3C, 0}));
}

TEST(ModbusSlave, RefusesWhatIsNotThere) {
    RegisterBank bank;
    bank.holding = {{0, 7}};
    EXPECT_EQ(answer_pdu(bank, Bytes{3, 0, 0, 0, 2}), (Bytes{0x83, 2}));
    EXPECT_EQ(answer_pdu(bank, Bytes{3, 0, 0, 0, 0}), (Bytes{0x83, 3}));
    EXPECT_EQ(answer_pdu(bank, Bytes{0x2B, 0, 0, 0, 0}), (Bytes{0xAB, 1}));
    EXPECT_EQ(answer_pdu(bank, Bytes{16, 0, 0, 0, 1, 4, 0, 1}), (Bytes{0x90, 3}));
}

TEST(ModbusSlave, WritesWordsAndCoils) {
    RegisterBank bank;
    bank.holding = {{0, 0}, {1, 0}};
    bank.coils = {{0, false}};
    EXPECT_EQ(answer_pdu(bank, Bytes{16, 0, 0, 0, 2, 4, 1, 2, 3, 4}), (Bytes{16, 0, 0, 0, 2}));
    EXPECT_EQ(bank.holding.at(0), 0x0102);
    EXPECT_EQ(bank.holding.at(1), 0x0304);
    EXPECT_EQ(answer_pdu(bank, Bytes{15, 0, 0, 0, 1, 1, 1}), (Bytes{15, 0, 0, 0, 1}));
    EXPECT_TRUE(bank.coils.at(0));
}

TEST(ModbusSlave, KnowsTheLengthOfARequest) {
    EXPECT_EQ(rtu_request_length(Bytes{1, 4}), 8U);
    EXPECT_FALSE(rtu_request_length(Bytes{1, 16, 0, 0, 0, 1}));
    EXPECT_EQ(rtu_request_length(Bytes{1, 16, 0, 0, 0, 1, 2}), 11U);
    EXPECT_EQ(rtu_request_length(Bytes{1, 99}), 0U);
}

} // namespace
} // namespace axiscal::simulate::modbus_slave_test

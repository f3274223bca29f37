// Expected bytes: public sample lines of the vendor, CRC re-computed from the described polynomial.
#include "wire/dracal_line.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::dracal_line_test {
namespace {

TEST(DracalLine, CrcClosesThePublishedSample) {
    EXPECT_EQ(crc16_xmodem("D,VCP-PTH450,E18890,,101182,Pa,24.8344,C,59.8779,%,"), 0x3FB5);
    EXPECT_EQ(crc16_xmodem("123456789"), 0x31C3); // the check value of CRC-16/XMODEM
}

TEST(DracalLine, DataLineIsThePublishedSample) {
    const DracalStick stick;
    EXPECT_EQ(stick.data_line(99688, 21.77, 49.98),
              "D,VCP-PTH450-CAL,E24638,,99688,Pa,21.77,C,49.98,%,*3a8d");
}

TEST(DracalLine, PollIsAcknowledgedAsPublished) {
    DracalStick stick;
    EXPECT_EQ(stick.answer("POLL 1000"),
              "I,VCP-PTH450-CAL,E24638,Poll interval set to 1000 ms,*cdea");
    EXPECT_EQ(stick.poll_ms, 1000);
}

TEST(DracalLine, FractionDigitsChangeTheResolution) {
    DracalStick stick;
    stick.answer("FRAC 4");
    EXPECT_NE(stick.data_line(101182, 24.8344, 59.8779).find(",24.8344,C,59.8779,%,"),
              std::string::npos);
}

} // namespace
} // namespace axiscal::simulate::dracal_line_test

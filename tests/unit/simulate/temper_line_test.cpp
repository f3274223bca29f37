// Expected bytes: what urwen/temper prints of a stick with firmware TEMPerX232_V2.0.
#include "wire/temper_line.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::temper_line_test {
namespace {

std::string answered(std::string typed, const TemperTruth& truth) {
    return temper_answer(typed, truth);
}

TEST(TemperAnswer, IsLetterByLetterThatOfTheStick) {
    EXPECT_EQ(answered("ReadTemp", {30.53, 39.92, {}}), "Temp-Inner:30.53 [C],39.92 [%RH]<\r\n");
    EXPECT_EQ(answered("Version", {}), "TEMPerX232_V2.0\r\n");
    EXPECT_EQ(answered("ReadType", {}), "Type:Inner-H2\r\n");
    EXPECT_EQ(answered("ReadCalib", {}),
              "Inner-Calib:0.0 [C],0.0 [%RH]\r\nOuter-Calib:0.0 [C],0.0 [%RH]\r\n");
}

TEST(TemperAnswer, HasASecondLineForAProbe) {
    EXPECT_EQ(answered("ReadTemp", {30.53, 39.92, -0.5}),
              "Temp-Inner:30.53 [C],39.92 [%RH]<\r\nTemp-Outer:-0.50 [C]<\r\n");
}

TEST(TemperAnswer, WaitsForHalfACommandAndForgetsWhatIsNone) {
    std::string typed = "\r\nReadTe";
    EXPECT_EQ(temper_answer(typed, {}), "");
    EXPECT_EQ(typed, "ReadTe");
    typed += "mpxyz";
    EXPECT_EQ(temper_answer(typed, {20, 50, {}}), "Temp-Inner:20.00 [C],50.00 [%RH]<\r\n");
    EXPECT_EQ(typed, "");
}

} // namespace
} // namespace axiscal::simulate::temper_line_test

// Expected bytes: the frames worked out from the field list of the public reader.
#include "wire/hpi_device.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::hpi_device_test {
namespace {

std::string bytes(std::initializer_list<int> numbers) {
    std::string text;
    for (const int number : numbers)
        text += static_cast<char>(number);
    return text;
}

const std::string distance_on = bytes({0xAA, 0xB0, 0x32, 0, 0, 0, 0, 0x8E});

/// A device that sends distances from where it stands at 0.
HpiDevice sending() {
    HpiDevice device;
    std::string typed = distance_on + hpi_frame(0xB079, std::string(4, '\0'));
    EXPECT_EQ(device.answer(typed).size(), 32U);
    device.distance(0, 80);
    return device;
}

TEST(HpiFrame, IsThatOfTheCommandForDistances) {
    EXPECT_EQ(hpi_frame(0xB032, std::string(4, '\0')), distance_on);
}

TEST(HpiDevice, SendsADistanceInStepsOfAHundredPicometres) {
    HpiDevice device = sending();
    EXPECT_EQ(device.distance(-123.4567891, 80),
              bytes({0xAA, 0xB0, 0x15, 0xFF, 0xFF, 0xFF, 0xB6, 0x69, 0xFD, 0x2D, 0x00, 0x00, 0x00,
                     0x09, 0x50, 0x84}));
}

TEST(HpiDevice, AcknowledgesWholeCommandsBehindNoise) {
    HpiDevice device;
    EXPECT_EQ(device.distance(0, 80), "") << "not ordered";
    std::string typed = bytes({0xAA, 0x00}) + distance_on + distance_on.substr(0, 5);
    const std::string answer = device.answer(typed);
    EXPECT_EQ(answer, hpi_frame(0xB032, std::string(12, '\0')));
    EXPECT_EQ(typed, distance_on.substr(0, 5));
    EXPECT_EQ(device.distance(0, 80).size(), 16U);
}

TEST(HpiDevice, KeepsTheFlagOfALostBeamAndLosesWhatItDidNotCount) {
    HpiDevice device = sending();
    const std::string before = device.distance(1, 80);
    device.set_beam(false);
    EXPECT_EQ(device.distance(2, 80)[13], '\x01');
    device.set_beam(true);
    EXPECT_EQ(device.distance(2, 80)[13], '\x01') << "until it is deleted";
    std::string typed = hpi_frame(0xB03D, std::string(4, '\0'));
    device.answer(typed);
    EXPECT_EQ(device.distance(2, 80), before) << "still at 1 mm";
}

TEST(HpiDevice, SendsNothingAfterARestartAndStandsAtZero) {
    HpiDevice device = sending();
    const std::string zero = device.distance(0, 80);
    device.restart();
    EXPECT_EQ(device.distance(7, 80), "");
    std::string typed = distance_on;
    device.answer(typed);
    EXPECT_EQ(device.distance(7, 80), zero);
}

TEST(HpiDevice, TellsAirAndMaterialInTheirSteps) {
    const HpiDevice device = sending();
    // 21.37 degC is 0859, 45 %, 1013.2 hPa is 2794; battery 90, link 70.
    EXPECT_EQ(device.air({21.37, 45, 101320}).substr(2, 9),
              bytes({0x0A, 0, 0x08, 0x59, 45, 90, 70, 0x27, 0x94}));
    EXPECT_EQ(device.material(2, -5.25).substr(2, 4), bytes({0x0A, 2, 0xFD, 0xF3}));
}

} // namespace
} // namespace axiscal::simulate::hpi_device_test

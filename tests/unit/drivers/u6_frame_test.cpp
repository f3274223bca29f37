// Literal frames of a LabJack U6, worked out from its maker's C examples (exodriver, examples/U6).
#include "drivers/ballbar/u6_frame.hpp"
#include "drivers/framing/byte_order.hpp"

#include <gtest/gtest.h>

namespace axiscal::u6_frame_test {
namespace {

U6Bytes zeros(U6Bytes frame, std::size_t length) {
    frame.resize(length);
    return frame;
}

/// 25 samples of 0x8000 after counter 7; the checksums by hand: 25 x 80 + 07 = 0C87.
U6Bytes packet() {
    auto frame = bytes_of({0x00, 0xF9, 0x1D, 0xC0, 0x87, 0x0C, 0, 0, 0, 0, 0x07, 0});
    for (int i = 0; i < 25; ++i) {
        frame.push_back(std::byte{0x00});
        frame.push_back(std::byte{0x80});
    }
    frame = zeros(std::move(frame), 64);
    frame[0] = std::byte{0x6B}; // F9 + 1D + C0 + 87 + 0C = 269: 69 + 2
    return frame;
}

TEST(U6Frame, AsksForTheConfigurationWithoutWriting) {
    EXPECT_EQ(u6_config_request(), zeros(bytes_of({0x0B, 0xF8, 0x0A, 0x08, 0, 0}), 26));
}

TEST(U6Frame, AsksForABlockOfCalibration) {
    EXPECT_EQ(u6_calibration_request(0), bytes_of({0x27, 0xF8, 0x01, 0x2D, 0, 0, 0, 0}));
    EXPECT_EQ(u6_calibration_request(2), bytes_of({0x29, 0xF8, 0x01, 0x2D, 2, 0, 0, 2}));
}

TEST(U6Frame, ConfiguresAStreamOfOneChannelAtOneKilohertz) {
    EXPECT_EQ(u6_stream_config_request({}),
              bytes_of({0xD9, 0xF8, 0x05, 0x11, 0xCA, 0x00, 0x01, 0x01, 0x19, 0x00, 0x00, 0x00,
                        0xA0, 0x0F, 0x00, 0x00}));
}

TEST(U6Frame, TellsInputGainAndDifferential) {
    U6StreamSetup setup;
    setup.channel = 2;
    setup.differential = true;
    setup.gain_index = 1;
    const auto frame = u6_stream_config_request(setup);
    EXPECT_EQ(frame[14], std::byte{0x02});
    EXPECT_EQ(frame[15], std::byte{0x90});
}

TEST(U6Frame, StartsAndStopsTheStream) {
    EXPECT_EQ(u6_stream_start_request(), bytes_of({0xA8, 0xA8}));
    EXPECT_EQ(u6_stream_stop_request(), bytes_of({0xB0, 0xB0}));
    EXPECT_TRUE(decode_u6_stream_start(bytes_of({0xA9, 0xA9, 0x00, 0x00})));
    EXPECT_EQ(decode_u6_stream_start(bytes_of({0xD9, 0xA9, 0x30, 0x00})).error().fault,
              Fault::refused);
    EXPECT_EQ(decode_u6_stream_start(bytes_of({0xA8, 0xA9, 0x00, 0x00})).error().fault,
              Fault::checksum);
}

TEST(U6Frame, ReadsWhoTheDeviceIs) {
    // Serial number 470012345 = 1C 03 D1 B9; firmware 1.43; U6-Pro has bit 3 of byte 37.
    auto reply = zeros(
        bytes_of({0, 0xF8, 0x10, 0x08, 0, 0, 0, 0, 0, 43, 1, 0, 0, 0, 0, 0xB9, 0xD1, 0x03, 0x1C}),
        38);
    reply[37] = std::byte{0x0C};
    reply[4] = std::byte{0xE1}; // 2B + 01 + B9 + D1 + 03 + 1C + 0C = 1E1
    reply[5] = std::byte{0x01};
    reply[0] = std::byte{0xF3}; // F8 + 10 + 08 + E1 + 01 = 1F2: F2 + 1
    const auto who = decode_u6_config(reply);
    ASSERT_TRUE(who) << describe(who.error());
    EXPECT_EQ(who->serial, 470012345U);
    EXPECT_EQ(who->firmware, "1.43");
    EXPECT_TRUE(who->is_pro);
}

TEST(U6Frame, ReadsFixedPointConstants) {
    // 33523 = 82F3; -0.5 = -1 + 0.5; 0.25; 0.
    auto reply = zeros(bytes_of({0, 0xF8, 0x11, 0x2D, 0, 0, 0, 0}), 40);
    reply[12] = std::byte{0xF3};
    reply[13] = std::byte{0x82};
    reply[19] = std::byte{0x80};
    for (const std::size_t at : {20U, 21U, 22U, 23U})
        reply[at] = std::byte{0xFF};
    reply[27] = std::byte{0x40};
    reply[4] = std::byte{0x31}; // F3 + 82 + 80 + 4 x FF + 40 = 631
    reply[5] = std::byte{0x06};
    reply[0] = std::byte{0x6E}; // F8 + 11 + 2D + 31 + 06 = 16D: 6D + 1
    const auto four = decode_u6_calibration(reply);
    ASSERT_TRUE(four) << describe(four.error());
    EXPECT_EQ((*four)[0], 33523);
    EXPECT_EQ((*four)[1], -0.5);
    EXPECT_EQ((*four)[2], 0.25);
    EXPECT_EQ((*four)[3], 0);
}

TEST(U6Frame, TakesAStreamConfigReply) {
    EXPECT_TRUE(decode_u6_stream_config(bytes_of({0x0B, 0xF8, 0x01, 0x11, 0, 0, 0, 0})));
    EXPECT_EQ(
        decode_u6_stream_config(bytes_of({0x3D, 0xF8, 0x01, 0x11, 0x32, 0, 0x32, 0})).error().fault,
        Fault::refused);
}

TEST(U6Packet, HoldsItsSamplesAndItsCounter) {
    const auto decoded = decode_u6_packet(packet(), 25);
    ASSERT_TRUE(decoded) << describe(decoded.error());
    EXPECT_EQ(decoded->counter, 7);
    EXPECT_EQ(decoded->samples, std::vector<std::uint16_t>(25, 0x8000));
    EXPECT_EQ(decoded->lost_scans, 0U);
    EXPECT_FALSE(decoded->overflowed);
}

TEST(U6Packet, TellsThatTheBufferRanOver) {
    auto bytes = packet();
    bytes[11] = std::byte{59};
    bytes[4] = std::byte{0xC2}; // 0C87 + 3B
    bytes[0] = std::byte{0xA6};
    const auto decoded = decode_u6_packet(bytes, 25);
    ASSERT_TRUE(decoded) << describe(decoded.error());
    EXPECT_TRUE(decoded->overflowed);
}

TEST(U6Packet, TellsHowManyScansAreMissing) {
    auto bytes = packet();
    bytes[6] = std::byte{0x2C}; // 300 = 012C
    bytes[7] = std::byte{0x01};
    bytes[11] = std::byte{60};
    bytes[4] = std::byte{0xF0}; // 0C87 + 2C + 01 + 3C
    bytes[0] = std::byte{0xD4};
    const auto decoded = decode_u6_packet(bytes, 25);
    ASSERT_TRUE(decoded) << describe(decoded.error());
    EXPECT_EQ(decoded->lost_scans, 300U);
}

TEST(U6Packet, IsRefusedForEveryDamagedByte) {
    ASSERT_TRUE(decode_u6_packet(packet(), 25));
    for (std::size_t at = 0; at < packet().size(); ++at) {
        auto damaged = packet();
        damaged[at] ^= std::byte{0x01};
        EXPECT_FALSE(decode_u6_packet(damaged, 25)) << at;
    }
}

TEST(U6Packet, IsRefusedWhenItIsShort) {
    for (std::size_t length = 0; length < 64; ++length)
        EXPECT_EQ(decode_u6_packet(zeros(packet(), length), 25).error().fault, Fault::bad_frame);
}

// u6.c, U6_CALIBRATION_INFO_DEFAULT.
const std::vector<double> nominal{3.1580578e-4, -10.58695652,  3.1580578e-5, -1.058695652,
                                  3.1580578e-6, -0.1058695652, 3.1580578e-7, -0.01058695652,
                                  -3.158058e-4, 33523,         -3.158058e-5, 33523,
                                  -3.158058e-6, 33523,         -3.158058e-7, 33523};

TEST(U6Volts, FollowTheConstantsOfTheGain) {
    const U6Range range = u6_range(nominal, 0).value();
    EXPECT_NEAR(u6_volts(33523, range), 0, 1e-12);
    EXPECT_NEAR(u6_volts(65188, range), 10, 3.2e-4); // (65188 - 33523) x 3.1580578e-4
    EXPECT_NEAR(u6_volts(1858, range), -10, 3.2e-4);
    EXPECT_NEAR(u6_volts(65188, u6_range(nominal, 3).value()), 0.01, 3.2e-7);
}

TEST(U6Volts, AreRefusedWithoutACalibration) {
    EXPECT_FALSE(u6_range(std::vector<double>(16, -1.0 / 4294967296), 0));
    EXPECT_FALSE(u6_range(std::vector<double>(16), 0));
    auto off = nominal;
    off[0] *= 1.2;
    EXPECT_FALSE(u6_range(off, 0));
}

} // namespace
} // namespace axiscal::u6_frame_test

// The simulated USB instruments against literal bytes of the makers' and open drivers' documents.
#include "wire/usb/temper_device.hpp"
#include "wire/usb/u6_device.hpp"
#include "wire/usb/usbtenki_device.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::usb_device_models_test {
namespace {

Bytes vendor_request(UsbDevice& device, std::uint8_t request, std::uint16_t value) {
    return device.control({0xC0, request, value, 0, 64}, {}).bytes;
}

UsbTenkiDevice tenki() {
    return {"A10234", [] {
                return TrueAir{Temperature::celsius(25), pascal(100009), percent(50), 450};
            }};
}

TEST(UsbTenkiDevice, AnswersWithEchoAndChecksum) {
    auto device = tenki();
    EXPECT_EQ(vendor_request(device, 0x02, 0), (Bytes{0x02, 0x04, 0x06}));
    EXPECT_EQ(vendor_request(device, 0x01, 2), (Bytes{0x01, 0x20, 0x21}));
    EXPECT_EQ(vendor_request(device, 0x10, 2), (Bytes{0x10, 0x66, 0x66, 0x10})); // 25 degC
}

TEST(UsbTenkiDevice, AnswersUnknownChannelsWithNothingAndUnknownCommandsWithZero) {
    auto device = tenki();
    EXPECT_EQ(vendor_request(device, 0x10, 9), Bytes{});
    EXPECT_EQ(vendor_request(device, 0x77, 0), Bytes{0x00});
}

TEST(UsbTenkiDevice, CountsAsTheDataSheetsExample) {
    // MS5611-01BA03 data sheet: D1 = 9085466, D2 = 8569150 are 20.07 degC and 1000.09 mbar; there
    // TEMP is 2007.9853 hundredths and P 100009.07 Pa before they are cut.
    const auto counts = ms5611_counts(100009.07, 20.079853, ms5611_example);
    EXPECT_NEAR(counts.d2, 8569150, 1);
    EXPECT_NEAR(counts.d1, 9085466, 1);
}

class U6 : public ::testing::Test {
protected:
    Bytes ask(const Bytes& command) {
        EXPECT_EQ(device.out(1, command).how, UsbAnswer::How::done);
        return device.in(2, 64).bytes;
    }
    double now_s = 100;
    U6Device device{470012345, {[this] { return now_s; }, [](double) { return 0.0; }}};
    const Bytes stream_config{0xD9, 0xF8, 0x05, 0x11, 0xCA, 0x00, 0x01, 0x01,
                              0x19, 0x00, 0x00, 0x00, 0xA0, 0x0F, 0x00, 0x00};
};

TEST_F(U6, TellsItsSerialNumber) {
    Bytes request{0x0B, 0xF8, 0x0A, 0x08};
    request.resize(26);
    const Bytes reply = ask(request);
    ASSERT_EQ(reply.size(), 38U);
    EXPECT_EQ((Bytes{reply.begin() + 15, reply.begin() + 19}), (Bytes{0xB9, 0xD1, 0x03, 0x1C}));
}

TEST_F(U6, RefusesACommandWhoseChecksumIsWrong) {
    EXPECT_EQ(ask({0x0C, 0xF8, 0x01, 0x2D, 0, 0, 0, 0}), (Bytes{0xB8, 0xB8}));
}

TEST_F(U6, StreamsOnePacketOf25SamplesIn25Milliseconds) {
    EXPECT_EQ(ask(stream_config), (Bytes{0x0B, 0xF8, 0x01, 0x11, 0, 0, 0, 0}));
    EXPECT_EQ(ask({0xA8, 0xA8}), (Bytes{0xA9, 0xA9, 0x00, 0x00}));
    now_s += 0.024;
    EXPECT_EQ(device.in(3, 64).how, UsbAnswer::How::hold);
    now_s += 0.002;
    const Bytes packet = device.in(3, 64).bytes;
    ASSERT_EQ(packet.size(), 64U);
    EXPECT_EQ((Bytes{packet.begin() + 1, packet.begin() + 4}), (Bytes{0xF9, 0x1D, 0xC0}));
    EXPECT_EQ(packet[10], 0);
    EXPECT_EQ(device.in(3, 64).how, UsbAnswer::How::hold);
}

TEST_F(U6, ReportsHowMuchItsBufferLost) {
    ask(stream_config);
    ask({0xA8, 0xA8});
    now_s += 3;
    int old_packets = 0;
    Bytes packet = device.in(3, 64).bytes;
    for (; packet[11] == 59; packet = device.in(3, 64).bytes)
        ++old_packets;
    EXPECT_EQ(old_packets, 984 / 25);
    EXPECT_EQ(packet[11], 60);
    EXPECT_EQ(packet[6] + 256 * packet[7], 3000 - 25 - 39 * 25);
    EXPECT_EQ(packet[10], 39);
}

TEST_F(U6, CountsAsSkippedOnlyWhatItLostWhileATransferWaited) {
    ask(stream_config);
    ask({0xA8, 0xA8});
    const auto lost_after_three_seconds = [&] {
        now_s += 3;
        Bytes packet = device.in(3, 64).bytes;
        while (packet[11] == 59)
            packet = device.in(3, 64).bytes;
        EXPECT_EQ(packet[11], 60);
        return packet[6] + 256U * packet[7];
    };
    EXPECT_EQ(device.in(3, 64).how, UsbAnswer::How::hold); // the host waits, the clock leaps
    const std::uint64_t its_own = lost_after_three_seconds();
    EXPECT_EQ(its_own, 2000U); // 3000, less 39 packets and the one of the report
    EXPECT_EQ(device.skipped(), its_own);
    now_s += 0.026;
    EXPECT_EQ(device.in(3, 64).how, UsbAnswer::How::done); // and nobody asks any more
    EXPECT_GT(lost_after_three_seconds(), 0U);
    EXPECT_EQ(device.skipped(), its_own);
}

TEST(TemperDevice, AnswersItsFirmwareAndItsValuesInReports) {
    TemperDevice device{"TEMPerX_V3.3", [] { return TemperShown{24.37, -5.12, 50, true}; }};
    const Bytes firmware{0x01, 0x86, 0xFF, 0x01, 0, 0, 0, 0},
        values{0x01, 0x80, 0x33, 0x01, 0, 0, 0, 0};
    const UsbSetup set_report{0x21, 0x09, 0x0200, 1, 8};
    device.control(set_report, firmware);
    EXPECT_EQ(device.in(2, 8).bytes, (Bytes{'T', 'E', 'M', 'P', 'e', 'r', 'X', '_'}));
    EXPECT_EQ(device.in(2, 8).bytes, (Bytes{'V', '3', '.', '3', ' ', ' ', ' ', ' '}));
    EXPECT_EQ(device.in(2, 8).how, UsbAnswer::How::hold);
    device.control(set_report, values);
    const Bytes stick = device.in(2, 8).bytes, probe = device.in(2, 8).bytes;
    EXPECT_EQ((Bytes{stick.begin() + 2, stick.begin() + 6}), (Bytes{0x09, 0x85, 0x13, 0x88}));
    EXPECT_EQ((Bytes{probe.begin() + 2, probe.begin() + 4}), (Bytes{0xFE, 0x00}));
}

} // namespace
} // namespace axiscal::simulate::usb_device_models_test

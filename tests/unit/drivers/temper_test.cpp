// A TEMPer stick under virtual time, and how USB instruments are written in the station file.
#include "tests/support/running_instrument.hpp"
#include "wire/usb/temper_device.hpp"

#include <gtest/gtest.h>

namespace axiscal::temper_test {
namespace {

using namespace std::chrono_literals;
using simulate::UsbFault;

class TemperStick : public ::testing::Test {
protected:
    TemperStick() { stick.plug.sockets = {&socket}; }
    testing::VirtualScheduler scheduler;
    simulate::TemperShown shown{22.5, 20.25, 40, true};
    simulate::TemperDevice device{"TEMPerX_V3.3", [this] { return shown; }};
    testing::Socket socket{&device};
    testing::RunningInstrument stick{scheduler, "temper", "link = \"usb:any\"\n"};
};

TEST_F(TemperStick, ReadsProbeStickAndHumidity) {
    stick.start();
    scheduler.run_for(2s);
    EXPECT_EQ(stick.last(0), 20.25);
    EXPECT_EQ(stick.last(1), 22.5);
    EXPECT_EQ(stick.last(3), 40);
    ASSERT_EQ(stick.sink.identities.size(), 1U);
    EXPECT_EQ(stick.sink.identities[0].firmware, "TEMPerX_V3.3");
}

TEST_F(TemperStick, HasNoNumberForAProbeThatIsUnplugged) {
    shown.probe_connected = false;
    stick.start();
    scheduler.run_for(2s);
    EXPECT_FALSE(stick.last(0));
    EXPECT_EQ(stick.last(1), 22.5);
}

TEST_F(TemperStick, ReadsOldSticksIn256Ths) {
    simulate::TemperDevice old{"TEMPerF1.4", [this] { return shown; }};
    socket.device = &old;
    stick.start();
    scheduler.run_for(2s);
    EXPECT_EQ(stick.last(1), 22.5);
    EXPECT_FALSE(stick.last(0));
    for (const Sample& sample : stick.sink.samples)
        EXPECT_EQ(sample.channel, 1); // it has no probe
}

TEST_F(TemperStick, IsRefusedWithAFirmwareThatIsNotKnown) {
    simulate::TemperDevice strange{"TEMPerY_V9.9", [this] { return shown; }};
    socket.device = &strange;
    stick.start();
    scheduler.run_for(2s);
    EXPECT_TRUE(stick.sink.samples.empty());
    EXPECT_EQ(stick.ends.front(), Fault::unknown_instrument);
}

TEST_F(TemperStick, IsGivenUpWhenItIsSilentAndComesBack) {
    stick.start();
    scheduler.run_for(2s);
    const auto samples = stick.sink.samples.size();
    socket.faults.set(UsbFault::mute, 0);
    scheduler.run_for(6s);
    EXPECT_EQ(stick.sink.samples.size(), samples);
    ASSERT_FALSE(stick.ends.empty());
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(5s);
    EXPECT_GT(stick.sink.samples.size(), samples);
}

TEST_F(TemperStick, GivesNoNumberOfShortReports) {
    stick.start();
    scheduler.run_for(2s);
    const auto samples = stick.sink.samples.size();
    socket.faults.set(UsbFault::cut, 5);
    scheduler.run_for(6s);
    EXPECT_EQ(stick.sink.samples.size(), samples);
    EXPECT_GE(stick.counters().bad_frames, 3U);
    EXPECT_EQ(stick.ends.front(), Fault::bad_frame);
}

TEST(UsbLinks, AreWrittenInTheStationFile) {
    for (const char* link : {"usb:any", "usb:E20001", "usb-port:1-2.4"})
        EXPECT_TRUE(
            testing::make_instrument("dracal-usbtenki", std::string{"link = \""} + link + "\"\n")
                .refusals.empty())
            << link;
    for (const char* link : {"usb:", "usb-port:", "serial:/dev/ttyUSB0", "any"}) {
        const auto made =
            testing::make_instrument("dracal-usbtenki", std::string{"link = \""} + link + "\"\n");
        ASSERT_EQ(made.refusals.size(), 1U) << link;
        EXPECT_NE(made.refusals[0].reason.find("usb:SERIAL"), std::string::npos);
    }
}

TEST(UsbLinks, WantTheScaleOfTheBallbar) {
    const auto made = testing::make_instrument(
        "labjack-u6", "link = \"usb:any\"\ninput = 3\ndifferential = true\nscale_voltage = 0\n");
    std::string text;
    for (const Refusal& refusal : made.refusals)
        text += refusal.describe() + "\n";
    for (const char* key : {"scale_length", "scale_voltage", "input"})
        EXPECT_NE(text.find(key), std::string::npos) << text;
}

} // namespace
} // namespace axiscal::temper_test

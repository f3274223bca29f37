// A USBTenki stick under virtual time: what is read, and what comes of a device that is unplugged,
// silent, stalls, cuts or corrupts its answers.
#include "tests/support/running_instrument.hpp"
#include "wire/usb/usbtenki_device.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace axiscal::dracal_usbtenki_test {
namespace {

using namespace std::chrono_literals;
using simulate::UsbFault;

simulate::TrueAir some_air() {
    return {Temperature::celsius(25), pascal(100009), percent(50), 450};
}

class UsbTenki : public ::testing::Test {
protected:
    UsbTenki() { stick.plug.sockets = {&socket}; }
    testing::VirtualScheduler scheduler;
    simulate::UsbTenkiDevice device{"A10234", some_air};
    testing::Socket socket{&device};
    testing::RunningInstrument stick{scheduler, "dracal-usbtenki", "link = \"usb:A10234\"\n"};
};

TEST_F(UsbTenki, ReadsTheAirThatIsThere) {
    stick.start();
    scheduler.run_for(1600ms);
    EXPECT_NEAR(stick.last(0).value(), 25, 0.003); // 175 K / 65535
    EXPECT_NEAR(stick.last(1).value(), 100009, 2); // a count of D1 is 0.02 Pa, then truncated
    EXPECT_NEAR(stick.last(2).value(), 50, 0.002);
    EXPECT_EQ(stick.sink.samples.size(), 4 * 3U); // at 0, 0.5, 1 and 1.5 s
    ASSERT_EQ(stick.sink.identities.size(), 1U);
    EXPECT_EQ(stick.sink.identities[0].serial, "A10234");
}

TEST_F(UsbTenki, ReadsColdAirToo) {
    simulate::UsbTenkiDevice cold{
        "A10234", [] {
            return simulate::TrueAir{Temperature::celsius(-20), pascal(70000), percent(30), 450};
        }};
    socket.device = &cold;
    stick.start();
    scheduler.run_for(100ms);
    EXPECT_NEAR(stick.last(0).value(), -20, 0.003);
    EXPECT_NEAR(stick.last(1).value(), 70000, 4);
}

TEST_F(UsbTenki, IsToldUnpluggedAndComesBack) {
    stick.start();
    scheduler.run_for(600ms);
    socket.plugged = false;
    scheduler.run_for(2s);
    ASSERT_FALSE(stick.ends.empty());
    EXPECT_EQ(stick.ends.front(), Fault::link_closed);
    const auto before = stick.sink.samples.size();
    socket.plugged = true;
    scheduler.run_for(1s);
    EXPECT_GT(stick.sink.samples.size(), before);
}

TEST_F(UsbTenki, IsAskedThreeTimesAndGivenUpWhenItIsSilent) {
    stick.start();
    scheduler.run_for(600ms);
    socket.faults.set(UsbFault::mute, 0);
    const auto samples = stick.sink.samples.size();
    scheduler.run_for(12s); // three tries of a second, and those of the next openings
    EXPECT_EQ(stick.sink.samples.size(), samples);
    ASSERT_FALSE(stick.ends.empty());
    EXPECT_EQ(stick.ends.front(), Fault::link_timeout);
    EXPECT_GE(stick.counters().timeouts, 9U);
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(5s);
    EXPECT_GT(stick.sink.samples.size(), samples);
}

TEST_F(UsbTenki, GivesNoNumberOfADamagedReply) {
    stick.start();
    scheduler.run_for(600ms);
    const auto samples = stick.sink.samples.size();
    socket.faults.set(UsbFault::corrupt, 0x10);
    scheduler.run_for(1s);
    EXPECT_EQ(stick.sink.samples.size(), samples);
    EXPECT_GE(stick.counters().checksum_errors, 3U);
    ASSERT_FALSE(stick.ends.empty());
    EXPECT_EQ(stick.ends.front(), Fault::checksum);
}

TEST_F(UsbTenki, GivesNoNumberOfAShortReply) {
    stick.start();
    for (int length = 0; length < 4; ++length) {
        scheduler.run_for(1600ms);
        ASSERT_TRUE(stick.last(1)) << length;
        socket.faults.set(UsbFault::cut, length);
        const auto good = std::ranges::count_if(
            stick.sink.samples, [](const Sample& sample) { return sample.value().has_value(); });
        scheduler.run_for(1s);
        EXPECT_EQ(std::ranges::count_if(stick.sink.samples,
                                        [](const Sample& s) { return s.value().has_value(); }),
                  good)
            << length;
        socket.faults.set(UsbFault::none, 0);
    }
}

TEST_F(UsbTenki, HasAbsentChannelsWhileItStalls) {
    stick.start();
    scheduler.run_for(600ms);
    socket.faults.set(UsbFault::stall, 0);
    scheduler.run_for(1s);
    EXPECT_EQ(stick.sink.samples.back().quality(), Quality::absent);
    EXPECT_FALSE(stick.last(1));
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(1s);
    EXPECT_TRUE(stick.last(1));
}

} // namespace
} // namespace axiscal::dracal_usbtenki_test

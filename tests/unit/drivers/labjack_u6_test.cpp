// A ballbar on a LabJack U6 under virtual time: its samples are without a hole, or the hole is
// counted.
#include "tests/support/running_instrument.hpp"
#include "wire/usb/u6_device.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::labjack_u6_test {
namespace {

using namespace std::chrono_literals;
using simulate::UsbFault;

class LabJackU6 : public ::testing::Test {
protected:
    LabJackU6() { ballbar.plug.sockets = {&socket}; }
    simulate::U6Device::World world(double volts) {
        simulate::U6Device::World seen;
        seen.now_s = [this] { return 1e-9 * static_cast<double>(nanoseconds_of(scheduler.now())); };
        seen.volts = [volts](double seconds) { return volts + 0.5 * std::sin(seconds); };
        return seen;
    }
    /// Every sample's number follows the one before it, and so does its time.
    void expect_numbered_without_a_hole() {
        const auto& samples = ballbar.sink.samples;
        for (std::size_t i = 1; i < samples.size(); ++i) {
            ASSERT_EQ(samples[i].device_count, samples[i - 1].device_count + 1);
            ASSERT_NEAR(seconds_of(samples[i].at - samples[i - 1].at), 1e-3, 1e-5);
        }
    }
    testing::VirtualScheduler scheduler;
    simulate::U6Device device{470012345, world(-1)};
    testing::Socket socket{&device};
    testing::RunningInstrument ballbar{scheduler, "labjack-u6",
                                       "link = \"usb:470012345\"\nscale_length = \"1 mm\"\n"};
};

TEST_F(LabJackU6, StreamsLengthsAtOneKilohertz) {
    ballbar.start();
    scheduler.run_for(10s);
    EXPECT_GE(ballbar.sink.samples.size(), 9900U);
    expect_numbered_without_a_hole();
    EXPECT_EQ(ballbar.counters().gaps, 0U);
    ASSERT_EQ(ballbar.sink.identities.size(), 1U);
    EXPECT_EQ(ballbar.sink.identities[0].serial, "470012345");
    for (const Sample& sample : ballbar.sink.samples) {
        // 1 mm for 10 V: a count is 32 nm. A sample is stamped to 2 ms, in which the sine moves by
        // 1 mV, 100 nm.
        const double volts = -1 + 0.5 * std::sin(seconds_of(sample.at.time_since_epoch()));
        ASSERT_NEAR(sample.value().value(), volts * 1e-4, 1.2e-7);
    }
}

TEST_F(LabJackU6, MeasuresWithTheDevicesOwnCalibration) {
    simulate::U6Device still{470012345, [&] {
                                 auto seen = world(0);
                                 seen.volts = [](double seconds) {
                                     return seconds < 3 ? 8.0 : -8.0;
                                 };
                                 return seen;
                             }()};
    socket.device = &still;
    ballbar.start();
    scheduler.run_for(4s);
    // Half a count of 0.316 mV is 16 nm; nominal constants would be 0.8 um off.
    EXPECT_NEAR(ballbar.sink.samples.front().value().value(), 0.8e-3, 17e-9);
    EXPECT_NEAR(ballbar.sink.samples.back().value().value(), -0.8e-3, 17e-9);
}

TEST_F(LabJackU6, HasNoNumberBeyondTheConvertersScale) {
    simulate::U6Device far{470012345, [&] {
                               auto seen = world(0);
                               seen.volts = [](double) { return 30.0; };
                               return seen;
                           }()};
    socket.device = &far;
    ballbar.start();
    scheduler.run_for(1s);
    ASSERT_FALSE(ballbar.sink.samples.empty());
    for (const Sample& sample : ballbar.sink.samples)
        EXPECT_EQ(sample.quality(), Quality::absent);
}

TEST_F(LabJackU6, CountsPacketsThatAreMissing) {
    device.swallow(20, 3);
    ballbar.start();
    scheduler.run_for(2s);
    EXPECT_EQ(ballbar.counters().gaps, 1U);
    EXPECT_EQ(ballbar.counters().lost_records, 75U);
    EXPECT_EQ(ballbar.sink.samples[20 * 25].device_count, 20 * 25 + 75 + 1U);
    EXPECT_EQ(ballbar.sink.notes, std::vector{Fault::samples_lost});
}

TEST_F(LabJackU6, CountsPacketsThatAreDamaged) {
    ballbar.start();
    scheduler.run_for(1s);
    socket.faults.set(UsbFault::corrupt, 0x04);
    scheduler.run_for(100ms);
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(1s);
    EXPECT_EQ(ballbar.counters().checksum_errors, 4U);
    EXPECT_EQ(ballbar.counters().lost_records, 100U);
    EXPECT_TRUE(ballbar.ends.empty());
}

TEST_F(LabJackU6, TellsAComputerThatReadsTooSlowly) {
    ballbar.start();
    scheduler.run_for(1s);
    socket.faults.set(UsbFault::mute, 0);
    scheduler.run_for(1500ms); // short of the driver's patience; the buffer holds 984 ms
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(2s);
    EXPECT_TRUE(ballbar.ends.empty());
    const auto& counters = ballbar.counters();
    EXPECT_GT(counters.lost_records, 400U);
    EXPECT_EQ(ballbar.sink.samples.back().device_count, counters.samples + counters.lost_records);
    const auto count = static_cast<double>(ballbar.sink.samples.back().device_count);
    EXPECT_NEAR(
        count,
        seconds_of(ballbar.sink.samples.back().at - ballbar.sink.samples.front().at) * 1e3 + 1, 2);
}

TEST_F(LabJackU6, IsGivenUpWhenItIsSilentAndNumberedAnewAfterwards) {
    ballbar.start();
    scheduler.run_for(1s);
    socket.faults.set(UsbFault::mute, 0);
    scheduler.run_for(4s);
    ASSERT_FALSE(ballbar.ends.empty());
    EXPECT_EQ(ballbar.ends.front(), Fault::link_timeout);
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(5s);
    EXPECT_EQ(ballbar.sink.samples.front().epoch, 0U);
    EXPECT_EQ(ballbar.sink.samples.back().epoch, 1U);
    EXPECT_LT(ballbar.sink.samples.back().device_count, 5000U);
    EXPECT_TRUE(ballbar.sink.samples.back().value());
}

class LabJackU6Spoilt : public LabJackU6, public ::testing::WithParamInterface<UsbFault> {};

TEST_P(LabJackU6Spoilt, IsGivenUpWhenNothingWholeComesAndComesBack) {
    ballbar.start();
    scheduler.run_for(1s);
    const auto samples = ballbar.sink.samples.size();
    EXPECT_GT(samples, 800U);
    socket.faults.set(GetParam(), 7);
    scheduler.run_for(3s);
    EXPECT_EQ(ballbar.sink.samples.size(), samples);
    EXPECT_FALSE(ballbar.ends.empty());
    socket.faults.set(UsbFault::none, 0);
    scheduler.run_for(3s);
    EXPECT_GT(ballbar.sink.samples.size(), samples);
}

INSTANTIATE_TEST_SUITE_P(Faults,
                         LabJackU6Spoilt,
                         ::testing::Values(UsbFault::corrupt, UsbFault::cut, UsbFault::stall));

TEST_F(LabJackU6, IsFoundByTheSerialNumberThatOnlyItTells) {
    simulate::U6Device wrong{470099999, world(5)};
    testing::Socket first{&wrong, "1-0"};
    ballbar.plug.sockets = {&first, &socket};
    ballbar.start();
    scheduler.run_for(2s);
    ASSERT_FALSE(ballbar.sink.samples.empty());
    EXPECT_LT(ballbar.sink.samples.back().value().value(), 0);
    EXPECT_EQ(first.openings, 1);
    socket.plugged = false;
    scheduler.run_for(3s);
    EXPECT_EQ(ballbar.ends.back(), Fault::link_closed);
}

} // namespace
} // namespace axiscal::labjack_u6_test

// What is not there is waited for by the kernel's word; the folders are real, the time is virtual.
#include "drivers/loop/doorbell.hpp"
#include "drivers/loop/virtual_scheduler.hpp"
#include "drivers/wire/arrival.hpp"
#include "tests/support/scratch_folder.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <filesystem>

namespace axiscal::arrival_test {
namespace {

using namespace std::chrono_literals;
using testing::ScratchFolder;
using testing::write_bytes;

class ArrivalOfALine : public ::testing::Test {
protected:
    void wait_for(const std::string& path, Duration patience = 5min) {
        LinkSettings settings;
        settings.path = path;
        wait_for(settings, patience);
    }
    void wait_for(const LinkSettings& settings, Duration patience) {
        boost::asio::co_spawn(scheduler.loop(),
                              await_arrival(scheduler, settings, scheduler.now() + patience),
                              [this](std::exception_ptr, Arrival arrival) { outcome = arrival; });
        scheduler.run_for(1ms);
    }
    /// The kernel queues its word before the call that makes an entry returns.
    [[nodiscard]] std::optional<Arrival> outcome_soon() {
        scheduler.run_for(1s);
        return outcome;
    }
    ScratchFolder scratch;
    VirtualScheduler scheduler;
    std::optional<Arrival> outcome;
};

TEST_F(ArrivalOfALine, IsToldWhenItsNodeIsMade) {
    wait_for(scratch.file("ttyUSB0"));
    scheduler.run_for(1min);
    ASSERT_FALSE(outcome);
    write_bytes(scratch.file("ttyUSB0"), "");
    EXPECT_EQ(outcome_soon(), Arrival::came);
}

/// /dev/serial/by-id comes with the first adapter and goes with the last one.
TEST_F(ArrivalOfALine, IsToldWhenTheFoldersAboveItAreMade) {
    wait_for(scratch.file("serial/by-id/usb-laser"));
    scheduler.run_for(1min);
    std::filesystem::create_directory(scratch.file("serial"));
    EXPECT_FALSE(outcome_soon());
    std::filesystem::create_directory(scratch.file("serial/by-id"));
    EXPECT_FALSE(outcome_soon());
    write_bytes(scratch.file("serial/by-id/usb-air"), ""); // somebody else's
    EXPECT_FALSE(outcome_soon());
    std::filesystem::create_symlink("/dev/null", scratch.file("serial/by-id/usb-laser"));
    EXPECT_EQ(outcome_soon(), Arrival::came);
}

TEST_F(ArrivalOfALine, IsToldAfterItsFolderWasRemovedAndMadeAgain) {
    std::filesystem::create_directory(scratch.file("by-id"));
    wait_for(scratch.file("by-id/usb-laser"));
    std::filesystem::remove(scratch.file("by-id"));
    EXPECT_FALSE(outcome_soon());
    std::filesystem::create_directory(scratch.file("by-id"));
    write_bytes(scratch.file("by-id/usb-laser"), "");
    EXPECT_EQ(outcome_soon(), Arrival::came);
}

TEST_F(ArrivalOfALine, IsToldWhenItIsMovedThere) {
    write_bytes(scratch.file("new"), "");
    wait_for(scratch.file("ttyUSB0"));
    std::filesystem::rename(scratch.file("new"), scratch.file("ttyUSB0"));
    EXPECT_EQ(outcome_soon(), Arrival::came);
}

TEST_F(ArrivalOfALine, EndsAtItsTimeAndWakesForNothingElse) {
    wait_for(scratch.file("ttyUSB0"), 5min);
    scheduler.run_for(5min - 2ms);
    EXPECT_FALSE(outcome);
    scheduler.run_for(1ms);
    EXPECT_EQ(outcome, Arrival::not_yet);
    EXPECT_EQ(scheduler.wakeups(), 1U);
}

TEST_F(ArrivalOfALine, CannotTellOfWhatIsThereAlready) {
    write_bytes(scratch.file("ttyUSB0"), ""); // not permitted, or in use by another program
    wait_for(scratch.file("ttyUSB0"));
    EXPECT_EQ(outcome, Arrival::cannot_tell);
    outcome.reset();
    std::filesystem::create_symlink("/nonexistent", scratch.file("dangling"));
    wait_for(scratch.file("dangling"));
    EXPECT_EQ(outcome, Arrival::cannot_tell);
}

TEST_F(ArrivalOfALine, CannotTellOfANetwork) {
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::tcp;
    wait_for(settings, 5min);
    EXPECT_EQ(outcome, Arrival::cannot_tell);
    outcome.reset();
    settings.kind = LinkSettings::Kind::can;
    wait_for(settings, 5min);
    EXPECT_EQ(outcome, Arrival::cannot_tell);
}

TEST_F(ArrivalOfALine, WaitsForAUsbDeviceThatNobodyHas) {
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::usb;
    settings.usb.ids = {UsbId{0xdead, 0xbeef}};
    wait_for(settings, 5min);
    EXPECT_FALSE(outcome);
    scheduler.run_for(5min);
    EXPECT_EQ(outcome, Arrival::not_yet);
}

TEST(Doorbell, ARingBeforeTheWaitEndsItAndIsHeardOnce) {
    VirtualScheduler scheduler;
    Doorbell bell{scheduler.executor()};
    int waits = 0;
    const auto wait_twice = [](VirtualScheduler* time, Doorbell* door, int* count) -> Task<void> {
        for (; *count < 2; ++*count)
            co_await door->wait(*time, std::nullopt);
    };
    bell.ring();
    bell.ring();
    boost::asio::co_spawn(scheduler.loop(), wait_twice(&scheduler, &bell, &waits),
                          [](std::exception_ptr) {});
    scheduler.run_for(1h);
    EXPECT_EQ(waits, 1);
    bell.ring();
    scheduler.run_for(1ms);
    EXPECT_EQ(waits, 2);
}

} // namespace
} // namespace axiscal::arrival_test

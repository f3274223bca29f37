// Instruments that die, flood or send garbage, on real ptys.
#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/loop_until.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/pty_pair.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/watched_opener.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <filesystem>

namespace axiscal::instrument_faults_test {
namespace {

/// One running instrument behind a path that stays while the device changes, as udev's names do.
class Running {
public:
    Running(boost::asio::io_context& loop, const std::string& driver, const std::string& keys)
        : loop_{loop}
        , scheduler_{loop}
        , device_{folder_.path() + "/device"}
        , instrument_{testing::instrument(driver, "link = \"serial:" + device_ + "\"\n" + keys)} {
        plug();
    }
    /// A device is plugged in and the instrument opened.
    void plug() {
        std::filesystem::remove(device_);
        pty = std::make_unique<testing::PtyPair>();
        std::filesystem::create_symlink(pty->path, device_);
        ended.reset();
        const int before = opener_.answers();
        boost::asio::co_spawn(loop_, run(), boost::asio::detached);
        EXPECT_TRUE(testing::loop_until(loop_, [&] { return opener_.answers() > before; }));
    }
    [[nodiscard]] const InstrumentCounters& counters() const { return instrument_->counters(); }

    std::unique_ptr<testing::PtyPair> pty;
    testing::SampleRecorder sink;
    std::optional<Fault> ended;

private:
    Task<void> run() {
        const InstrumentContext context{&scheduler_, &opener_, &sink};
        const auto result = co_await instrument_->run(context);
        ended = result ? Fault::none : result.error().fault;
    }

    boost::asio::io_context& loop_;
    AsioScheduler scheduler_;
    testing::WatchedOpener opener_{scheduler_};
    testing::ScratchFolder folder_;
    std::string device_;
    std::unique_ptr<Instrument> instrument_;
};

const std::string umd_keys = "wavelength = \"632.991 nm\"\nfold = \"corner cube\"\n"
                             "fastest = \"1 m/s\"\n";

std::string record(std::uint64_t sequence, std::int64_t displacement = 0) {
    const std::uint64_t slot = sequence & 31;
    const std::string low_speed = slot == 1   ? "10 247"
                                  : slot == 2 ? "8 100000"
                                  : slot == 3 ? "20 1025"
                                              : "0 0";
    return "0 0 " + std::to_string(displacement) + " 0 0 " + std::to_string(sequence) + " " +
           low_speed + "\r\n";
}
std::string records(std::uint64_t first, std::uint64_t count) {
    std::string text;
    for (auto sequence = first; sequence < first + count; ++sequence)
        text += record(sequence);
    return text;
}

TEST(InstrumentFaults, HalfAFirstLineIsNoReading) {
    boost::asio::io_context loop;
    Running laser{loop, "umd", umd_keys};
    // The end of a 16-field record: 8 fields that look like a record of their own.
    laser.pty->send("0 0 123456 0 0 7 0 0\r\n" + records(33, 10));
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.sink.samples.size() == 8; }));
    for (const Sample& sample : laser.sink.samples)
        EXPECT_EQ(sample.value(), 0.0);
    EXPECT_EQ(laser.counters().bad_frames, 0u);
}

TEST(InstrumentFaults, GarbageIsCountedAndTheNextRecordCounts) {
    boost::asio::io_context loop;
    Running laser{loop, "umd", umd_keys};
    laser.pty->send("\r\n" + records(1, 8));
    laser.pty->send(std::string("\xff\x00\x80 junk\n", 9) + std::string(5000, 'z') + "\n1 2 3\n");
    laser.pty->send(records(9, 8));
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.counters().frames == 16; }));
    EXPECT_EQ(laser.counters().bad_frames, 3u);
    EXPECT_EQ(laser.counters().gaps, 0u);
    EXPECT_EQ(laser.sink.samples.back().epoch, 0u);
}

TEST(InstrumentFaults, ALineWithoutEndOfAnAirSensorIsOneBadFrame) {
    boost::asio::io_context loop;
    Running air{loop, "dracal-vcp", "poll_period = \"10 s\"\n"};
    air.pty->send(std::string(600, 'x') + "\r\n" +
                  "D,VCP-PTH450,E18890,,101182,Pa,24.8344,C,59.8779,%,*3FB5\r\n");
    ASSERT_TRUE(testing::loop_until(loop, [&] { return air.sink.samples.size() == 3; }));
    EXPECT_EQ(air.counters().bad_frames, 1u);
    EXPECT_EQ(air.counters().checksum_errors, 0u);
}

TEST(InstrumentFaults, UnpluggedIsToldAndTheInstrumentComesBackWithANewEpoch) {
    boost::asio::io_context loop;
    Running laser{loop, "umd", umd_keys};
    laser.pty->send("\r\n" + records(1, 8));
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.counters().frames == 8; }));
    laser.pty->unplug();
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.ended.has_value(); }));
    EXPECT_EQ(*laser.ended, Fault::link_closed);
    laser.plug();
    laser.pty->send("\r\n" + records(9, 40));
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.counters().frames == 48; }));
    EXPECT_EQ(laser.sink.samples.front().epoch, 0u);
    EXPECT_EQ(laser.sink.samples.back().epoch, 1u);
    EXPECT_FALSE(laser.ended);
}

TEST(InstrumentFaults, AMissingDeviceIsToldAtOnce) {
    boost::asio::io_context loop;
    Running laser{loop, "umd", umd_keys};
    laser.pty->unplug();
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.ended.has_value(); }));
    EXPECT_EQ(*laser.ended, Fault::link_closed);
}

TEST(InstrumentFaults, AFloodDisturbsNoOtherInstrument) {
    boost::asio::io_context loop;
    Running laser{loop, "umd", umd_keys};
    Running air{loop, "dracal-vcp", "poll_period = \"10 s\"\n"};
    ::fcntl(laser.pty->master(), F_SETFL, O_NONBLOCK);
    std::string flood = "\r\n";
    for (std::uint64_t sequence = 1; sequence < 400; ++sequence)
        flood += record(sequence);
    const std::string reading = "D,VCP-PTH450,E18890,,101182,Pa,24.8344,C,59.8779,%,*3FB5\r\n";
    for (int turn = 0; turn < 20; ++turn) {
        laser.pty->send(flood);
        air.pty->send(reading);
        const std::size_t wanted = 3 * static_cast<std::size_t>(turn + 1);
        ASSERT_TRUE(testing::loop_until(loop, [&] { return air.sink.samples.size() == wanted; }));
    }
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.counters().frames > 400; }));
    EXPECT_FALSE(laser.ended);
    EXPECT_FALSE(air.ended);
    EXPECT_EQ(air.counters().checksum_errors, 0u);
}

TEST(InstrumentFaults, TimesOfABurstAreSpreadAndNeverGoBack) {
    boost::asio::io_context loop;
    Running laser{loop, "umd", umd_keys};
    laser.pty->send("\r\n" + records(1, 40));
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.counters().frames == 40; }));
    laser.pty->send(records(41, 40));
    ASSERT_TRUE(testing::loop_until(loop, [&] { return laser.counters().frames == 80; }));
    for (std::size_t i = 1; i < laser.sink.samples.size(); ++i)
        ASSERT_LT(laser.sink.samples[i - 1].at, laser.sink.samples[i].at);
}

} // namespace
} // namespace axiscal::instrument_faults_test

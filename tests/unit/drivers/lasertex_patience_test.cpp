// The driver of the Lasertex HPI-3D: its keys, and its patience under virtual time.
#include "drivers/recording/tape_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/virtual_scheduler.hpp"
#include "tests/unit/drivers/lasertex_wire.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal::lasertex_patience_test {
namespace {

using namespace std::chrono_literals;
using namespace lasertex_wire;

std::string refusals_of(const std::string& keys) {
    std::string text;
    for (const Refusal& refusal :
         testing::make_instrument("lasertex", "link = \"serial:/dev/ttyUSB0\"\n" + keys).refusals)
        text += refusal.describe() + "\n";
    return text;
}

TEST(LasertexKeys, MustStateWhetherThePositionIsCompensated) {
    EXPECT_NE(refusals_of("wavelength = \"633 nm\"\n").find("position"), std::string::npos);
    EXPECT_NE(refusals_of("position = \"air\"\nwavelength = \"633 nm\"\n").find("position"),
              std::string::npos);
    EXPECT_EQ(refusals_of(raw_keys), "");
    EXPECT_EQ(refusals_of("position = \"compensated\"\n"), "");
}

TEST(LasertexKeys, TakeAWavelengthForARawPositionAlone) {
    EXPECT_NE(refusals_of("position = \"raw\"\n").find("wavelength"), std::string::npos);
    EXPECT_NE(refusals_of("position = \"compensated\"\nwavelength = \"633 nm\"\n")
                  .find("belongs to a raw position"),
              std::string::npos);
}

TEST(LasertexKeys, MakeALaserOfARawPositionAndALengthOfACompensatedOne) {
    const std::string link = "link = \"serial:/dev/ttyUSB0\"\n";
    const auto raw = testing::instrument("lasertex", link + raw_keys);
    ASSERT_TRUE(raw->optics());
    EXPECT_DOUBLE_EQ(raw->optics()->vacuum_wavelength.in(nm), 632.991);
    EXPECT_TRUE(raw->incremental());
    EXPECT_EQ(raw->channels().front().name, "axis 1");
    const auto compensated = testing::instrument("lasertex", link + "position = \"compensated\"\n");
    EXPECT_FALSE(compensated->optics() || compensated->resolution());
    EXPECT_TRUE(compensated->incremental());
}

class LasertexPatience : public ::testing::Test {
protected:
    void hear(Duration at, const Bytes& bytes) { add(TapeEntry::Direction::in, at, bytes); }
    void order(Duration at, int command) { add(TapeEntry::Direction::out, at, request(command)); }
    /// All five commands within half a second, then distances up to one second: 0, 1, 2 ...
    void begin_well() {
        Duration at{};
        for (const int command : {0x32, 0x35, 0x79, 0x3F, 0x3D}) {
            order(at, command);
            hear(at + 5ms, acknowledgement(command));
            at += 40ms;
            hear(at, distance(0));
        }
        for (at += 40ms; at <= 1s; at += 40ms)
            hear(at, distance(++steps));
    }
    /// So many distances in one piece.
    void lump(Duration at, int count) {
        Bytes bytes;
        for (int nth = 0; nth < count; ++nth) {
            const Bytes one = distance(++steps);
            bytes.insert(bytes.end(), one.begin(), one.end());
        }
        hear(at, bytes);
    }
    void play(Duration until) {
        hear(1h, distance(0)); // the line stays open
        boost::asio::co_spawn(scheduler.loop(), run(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
        scheduler.run_for(until);
    }

    testing::VirtualScheduler scheduler;
    Tape tape;
    TapePlayer player{scheduler, tape};
    testing::SampleRecorder sink;
    std::unique_ptr<Instrument> laser =
        testing::instrument("lasertex", "link = \"serial:/dev/none\"\n" + raw_keys);
    MonotonicTime begin = scheduler.now();
    int steps = 0;
    std::optional<Fault> ended;
    MonotonicTime ended_at;

private:
    void add(TapeEntry::Direction direction, Duration at, const Bytes& bytes) {
        TapeEntry entry;
        entry.direction = direction;
        entry.offset = at;
        entry.bytes = bytes;
        tape.entries.push_back(std::move(entry));
    }
    Task<void> run() {
        const InstrumentContext context{&scheduler, &player, &sink};
        const auto result = co_await laser->run(context);
        ended = result ? Fault::none : result.error().fault;
        ended_at = scheduler.now();
    }
};

TEST_F(LasertexPatience, AHostThatStallsForSevenSecondsLosesNeitherDatumNorFrame) {
    begin_well();
    lump(8s, 175);
    lump(8040ms, 1);
    play(8100ms);
    EXPECT_FALSE(ended) << fault_name(*ended);
    const auto found = positions(sink);
    ASSERT_FALSE(found.empty());
    EXPECT_DOUBLE_EQ(found.back().value().value(), 1e-10 * (steps - 1));
    EXPECT_TRUE(std::ranges::all_of(found, [](const Sample& s) { return s.epoch == 0; }));
    EXPECT_TRUE(std::ranges::is_sorted(found, {}, &Sample::at));
    EXPECT_EQ(laser->counters().restarts, 0U);
    EXPECT_EQ(laser->counters().bad_frames, 0U);
    // Spread over the pause: the first of the lump is some 40 ms behind the last before it.
    const auto first = found[found.size() - 175];
    EXPECT_LT(first.at - (begin + 1s), 100ms);
}

TEST_F(LasertexPatience, ALaserThatWasSilentForThreeSecondsMayHaveRestarted) {
    begin_well();
    steps = 0;
    lump(4s, 1);
    lump(4040ms, 1);
    play(4100ms);
    EXPECT_FALSE(ended);
    EXPECT_EQ(positions(sink).back().epoch, 1U);
    EXPECT_EQ(laser->counters().restarts, 1U);
    EXPECT_EQ(std::ranges::count(sink.notes, Fault::datum_lost), 1);
}

TEST_F(LasertexPatience, ALineSilentForEightSecondsIsGivenUp) {
    begin_well();
    play(10s);
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::link_timeout);
    EXPECT_EQ(ended_at - begin, 1s + 8s);
}

TEST_F(LasertexPatience, ALaserThatDoesNotAnswerIsAskedThreeTimes) {
    for (const Duration at : {0s, 1s, 2s})
        order(at, 0x32);
    play(5s);
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::link_timeout);
    EXPECT_EQ(ended_at - begin, 3s);
    EXPECT_EQ(laser->counters().timeouts, 3U);
}

TEST_F(LasertexPatience, NoPositionIsHandedUpBeforeOldFaultsWereForgotten) {
    Duration at{};
    for (const int command : {0x32, 0x35, 0x79, 0x3F, 0x3D}) {
        order(at, command);
        hear(at + 5ms, acknowledgement(command));
        at += 40ms;
        hear(at, distance(0, command == 0x3D ? 9 : 1));
    }
    hear(at + 40ms, distance(1));
    hear(at + 80ms, distance(2));
    play(1s);
    ASSERT_FALSE(positions(sink).empty());
    EXPECT_DOUBLE_EQ(positions(sink).back().value().value(), 1e-10);
    EXPECT_TRUE(sink.notes.empty());
}

TEST_F(LasertexPatience, ALaserThatSendsButAcknowledgesNothingIsToldApart) {
    for (Duration at{}; at < 3s; at += 40ms) {
        if (at % 1s == 0s) order(at, 0x32);
        hear(at + 40ms, distance(0));
    }
    play(5s);
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::refused);
    EXPECT_TRUE(positions(sink).empty());
}

} // namespace
} // namespace axiscal::lasertex_patience_test

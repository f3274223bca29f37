// A host that stalls loses no datum, a laser that is silent is opened anew: the driver's patience,
// under virtual time.
#include "drivers/recording/tape_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal::laser_patience_test {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t per_second = 1000; // code 8 says it in hundredths

std::string record(std::uint64_t number) {
    const std::uint64_t slot = number & 31;
    const std::string low_speed = slot == 1   ? "10 247"
                                  : slot == 2 ? "8 100000"
                                  : slot == 3 ? "20 1025"
                                              : "0 0";
    return "0 0 " + std::to_string(number) + " 0 0 " + std::to_string(number) + " " + low_speed +
           "\r\n";
}

/// Records `first` .. `last`, handed over in one piece at `at`.
TapeEntry lump(Duration at, std::uint64_t first, std::uint64_t last) {
    std::string text = first == 1 ? "\r\n" : "";
    for (std::uint64_t number = first; number <= last; ++number)
        text += record(number);
    TapeEntry entry;
    entry.offset = at;
    for (const char letter : text)
        entry.bytes.push_back(static_cast<std::byte>(letter));
    return entry;
}

class LaserPatience : public ::testing::Test {
protected:
    /// One second as it should be; then nothing comes for so long, and then all that waited.
    void play(Duration silence) {
        for (std::uint64_t tenth = 1; tenth <= 10; ++tenth)
            tape.entries.push_back(lump(tenth * 100ms, tenth * 100 - 99, tenth * 100));
        waited = per_second + static_cast<std::uint64_t>(silence / 1ms);
        tape.entries.push_back(lump(1s + silence, per_second + 1, waited));
        tape.entries.push_back(lump(1h, waited + 1, waited + 1)); // the line stays open
        boost::asio::co_spawn(scheduler.loop(), run(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
        scheduler.run_for(1s + silence + 100ms);
    }
    Task<void> run() {
        const InstrumentContext context{&scheduler, &player, &sink};
        const auto result = co_await laser->run(context);
        ended = result ? Fault::none : result.error().fault;
        ended_at = scheduler.now();
    }

    testing::VirtualScheduler scheduler;
    MonotonicTime begin = scheduler.now();
    Tape tape;
    TapePlayer player{scheduler, tape};
    testing::SampleRecorder sink;
    std::unique_ptr<Instrument> laser = testing::instrument(
        "umd",
        "link = \"serial:/dev/none\"\nwavelength = \"632.991 nm\"\nfold = \"corner cube\"\n"
        "fastest = \"1 m/s\"\ncounts_per_cycle = 4\nhead = \"homodyne\"\n");
    std::uint64_t waited = 0;
    std::optional<Fault> ended;
    MonotonicTime ended_at;
};

TEST_F(LaserPatience, AHostThatStallsForSevenSecondsLosesNeitherDatumNorRecord) {
    play(7s);
    EXPECT_FALSE(ended) << fault_name(*ended);
    EXPECT_EQ(laser->counters().frames, waited);
    EXPECT_EQ(laser->counters().gaps, 0U);
    EXPECT_EQ(laser->counters().restarts, 0U);
    ASSERT_FALSE(sink.samples.empty());
    EXPECT_TRUE(std::ranges::all_of(sink.samples, [](const Sample& s) { return s.epoch == 0; }));
    EXPECT_TRUE(std::ranges::is_sorted(sink.samples, {}, &Sample::at));
    EXPECT_EQ(std::ranges::count(sink.notes, Fault::datum_lost), 0);
}

TEST_F(LaserPatience, ALineSilentForEightSecondsIsGivenUp) {
    play(9s);
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, Fault::link_timeout);
    EXPECT_EQ(ended_at - begin, 1s + 8s) << "eight seconds after the last record";
    EXPECT_EQ(laser->counters().frames, per_second);
}

} // namespace
} // namespace axiscal::laser_patience_test

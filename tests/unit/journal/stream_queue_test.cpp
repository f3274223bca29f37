// The blocks of a stream before a disk that stalls: so many wait, each more is refused, and the
// file tells where they are missing.

#include "acquisition/journal/journal.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/stream_packing.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/journal/manual_clock.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

namespace axiscal::stream_queue_test {
namespace {

/// docs/circular.md: so many blocks wait.
constexpr std::int64_t held = 64;
constexpr std::size_t samples_a_block = 10;

StreamChunk block_at(std::int64_t index) {
    StreamChunk chunk;
    chunk.head.index = index;
    for (std::size_t i = 0; i < samples_a_block; ++i) {
        chunk.at.push_back(monotonic_from_ns(1'000'000'000 * (index + 1) +
                                             1'000'000 * static_cast<std::int64_t>(i)));
        chunk.value.push_back(1e-3 * static_cast<double>(index));
    }
    return chunk;
}

/// A journal with a thread of its own that does not come to write by itself: its time stands still.
class StalledDisk : public ::testing::Test {
protected:
    StalledDisk() {
        RunRecord header = testing::RandomRun{21}.header();
        header.kind = TestKind::circular;
        EXPECT_TRUE(finish(journal_.open(path_, header)));
        CircularSetup setup;
        setup.plan.nominal_radius_mm = 100;
        setup.plan.feed_mm_per_s = 50;
        setup.bar_instrument = "ballbar";
        journal_.note(setup, std::vector<StreamSetup>{{0, 0, "ballbar", "m", 1000}});
    }
    /// @returns how many of `count` blocks were taken
    std::int64_t note(std::int64_t count) {
        std::int64_t taken = 0;
        for (std::int64_t i = 0; i < count; ++i)
            taken += journal_.note(block_at(next_++)) ? 1 : 0;
        return taken;
    }
    /// The disk comes to write once.
    void write() { ASSERT_TRUE(finish(journal_.flush())); }
    StreamSamples end() {
        EXPECT_TRUE(finish(journal_.close(false, "enough")));
        const auto read = read_run_file_contents(path_);
        EXPECT_TRUE(read) << (read ? "" : read.error().detail);
        const auto samples = samples_of(read->blocks, 0);
        EXPECT_TRUE(samples) << (samples ? "" : samples.error().detail);
        return *samples;
    }

private:
    Result<void> finish(Task<Result<void>> task) {
        std::optional<Result<void>> outcome;
        boost::asio::co_spawn(loop_, std::move(task),
                              [&](const std::exception_ptr& thrown, Result<void> result) {
                                  EXPECT_FALSE(thrown);
                                  outcome.emplace(std::move(result));
                              });
        loop_.restart();
        loop_.run();
        return std::move(outcome).value();
    }
    testing::ScratchFolder scratch_;
    std::string path_ = scratch_.file("circle.axiscal");
    boost::asio::io_context loop_{1};
    AsioScheduler scheduler_{loop_};
    testing::ManualClock clock_;
    Journal journal_{scheduler_, JournalThread::own, clock_};
    std::int64_t next_ = 0;
};

TEST_F(StalledDisk, HoldsSixtyFourBlocksAndRefusesEachMore) {
    EXPECT_EQ(note(held), held);
    EXPECT_EQ(note(10), 0);
    write();
    EXPECT_EQ(note(1), 1);
    const StreamSamples found = end();
    EXPECT_EQ(found.dropped_blocks, 10U);
    ASSERT_EQ(found.value.size(), (held + 1) * samples_a_block);
    ASSERT_EQ(found.gaps.size(), 1U);
    EXPECT_EQ(found.gaps[0].why, "dropped");
    EXPECT_EQ(found.gaps[0].at, held * samples_a_block);
    EXPECT_EQ(found.value.back(), 1e-3 * (held + 10)); // the block that came after the stall
}

TEST_F(StalledDisk, TellsTwoStallsApart) {
    EXPECT_EQ(note(held + 3), held);
    write();
    EXPECT_EQ(note(held + 5), held);
    write();
    EXPECT_EQ(note(1), 1);
    const StreamSamples found = end();
    EXPECT_EQ(found.dropped_blocks, 8U);
    ASSERT_EQ(found.gaps.size(), 2U);
    EXPECT_EQ(found.gaps[1].at, 2 * held * samples_a_block);
}

TEST_F(StalledDisk, ThatIsWrittenInTimeLosesNothing) {
    for (int stall = 0; stall < 3; ++stall) {
        EXPECT_EQ(note(held), held);
        write();
    }
    const StreamSamples found = end();
    EXPECT_EQ(found.dropped_blocks, 0U);
    EXPECT_TRUE(found.gaps.empty());
    EXPECT_EQ(found.value.size(), 3 * held * samples_a_block);
}

} // namespace
} // namespace axiscal::stream_queue_test

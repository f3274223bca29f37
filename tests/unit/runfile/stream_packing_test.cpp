// Streams in the run file: bit for bit, few bytes a sample, damage told.

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_verify.hpp"
#include "acquisition/runfile/stream_packing.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sqlite3.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

namespace axiscal::stream_packing_test {
namespace {

using testing::RandomRun;
using testing::ScratchFolder;

/// 1 kHz, times as a clock places them: a nanosecond up or down.
StreamChunk chunk_of(std::vector<double> values, std::int64_t index = 0, unsigned seed = 1) {
    std::mt19937_64 random{seed};
    StreamChunk chunk;
    chunk.head.index = index;
    std::int64_t ns = 7'000'000'000 + index * 20'000'000'000;
    for (std::size_t i = 0; i < values.size(); ++i)
        chunk.at.push_back(monotonic_from_ns(ns += 999'999 + static_cast<int>(random() % 3)));
    chunk.value = std::move(values);
    return chunk;
}

/// What a ballbar of 32 nm a step shows of a circle with 0.3 um of noise.
std::vector<double> ballbar_values(std::size_t count) {
    constexpr double step_m = 32e-9;
    std::mt19937_64 random{3};
    std::normal_distribution<double> noise{0, 0.3e-6};
    std::vector<double> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 18'850;
        values.push_back(std::round((8e-6 * std::cos(2 * angle) + noise(random)) / step_m) *
                         step_m);
    }
    return values;
}

/// Full mantissas: nothing about them repeats.
std::vector<double> rough_values(std::size_t count) {
    std::mt19937_64 random{4};
    std::normal_distribution<double> noise{0, 0.3e-6};
    std::vector<double> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(1e-4 + noise(random));
    return values;
}

void expect_same(const StreamChunk& written, const StreamChunk& read) {
    EXPECT_EQ(read.at, written.at);
    ASSERT_EQ(read.value.size(), written.value.size());
    for (std::size_t i = 0; i < read.value.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(read.value[i]),
                  std::bit_cast<std::uint64_t>(written.value[i]));
}

TEST(StreamPacking, GivesBackEveryBit) {
    for (const auto& values :
         {ballbar_values(1000), rough_values(1000), std::vector<double>{-0.0},
          std::vector<double>{5e-324, -1.7976931348623157e308, 0.0, -0.0, 1e-300}}) {
        const StreamChunk chunk = chunk_of(values);
        const auto read = unpacked(packed(chunk));
        ASSERT_TRUE(read) << read.error().detail;
        expect_same(chunk, *read);
    }
}

TEST(StreamPacking, ASampleTakesFewBytes) {
    // the bound of a row's other columns: 11 numbers of 9 bytes and the hash, once in 1000 samples
    constexpr double others = (11 * 9 + 32) / 1000.0;
    const auto bytes = [&](const std::vector<double>& values) {
        return static_cast<double>(packed(chunk_of(values)).packed.size()) / 1000 + others;
    };
    EXPECT_LT(bytes(ballbar_values(1000)), 3.5);
    EXPECT_LT(bytes(rough_values(1000)), 8);
}

TEST(StreamPacking, TheRowTellsRangeAndTimesWithoutUnpacking) {
    const StreamBlock block = packed(chunk_of({3, -1, 2}));
    EXPECT_EQ(block.low, -1);
    EXPECT_EQ(block.high, 3);
    EXPECT_EQ(block.samples, 3);
    EXPECT_LT(block.begin, block.end);
}

TEST(StreamPacking, DamagedBytesAreRefusedNotBelieved) {
    const StreamBlock good = packed(chunk_of(rough_values(500)));
    for (std::size_t at = 0; at < good.packed.size(); at += 7) {
        StreamBlock bad = good;
        bad.packed[at] = static_cast<char>(bad.packed[at] ^ 0x5a);
        if (const auto read = unpacked(bad)) {
            EXPECT_EQ(read->value.size(), 500U) << at;
        }
    }
    for (const int samples : {0, -1, 499, 501, 2'000'000'000}) {
        StreamBlock bad = good;
        bad.samples = samples;
        EXPECT_FALSE(unpacked(bad)) << samples;
    }
    StreamBlock empty = good;
    empty.packed.clear();
    EXPECT_FALSE(unpacked(empty));
    StreamBlock cut = good;
    cut.packed.resize(cut.packed.size() / 2);
    EXPECT_FALSE(unpacked(cut));
}

TEST(StreamPacking, ABlockAtAnImpossiblePlaceIsRefused) {
    constexpr auto farthest = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t index : {farthest, farthest - 1, std::int64_t{-1}}) {
        StreamChunk chunk = chunk_of(ballbar_values(10));
        chunk.head.index = index;
        const std::vector<StreamBlock> alone{packed(chunk)};
        EXPECT_FALSE(samples_of(alone, 0)) << index;
    }
}

TEST(StreamPacking, HolesAndDroppedBlocksAreKeptAsGaps) {
    std::vector<StreamBlock> blocks;
    for (const std::int64_t index : {0, 1, 4}) // 2 and 3 were dropped
        blocks.push_back(packed(chunk_of(ballbar_values(10), index)));
    blocks[1].before = "gap";
    blocks[1].missing = 12;
    const auto samples = samples_of(blocks, 0);
    ASSERT_TRUE(samples) << samples.error().detail;
    EXPECT_EQ(samples->value.size(), 30U);
    EXPECT_EQ(samples->dropped_blocks, 2U);
    ASSERT_EQ(samples->gaps.size(), 2U);
    EXPECT_EQ(samples->gaps[0].at, 10U);
    EXPECT_EQ(samples->gaps[0].missing, 12U);
    EXPECT_EQ(samples->gaps[1].why, "dropped");
    blocks.push_back(blocks[2]); // the disk did not tell whether it had kept it
    EXPECT_EQ(samples_of(blocks, 0)->value.size(), 30U);
    std::swap(blocks[0], blocks[1]);
    EXPECT_FALSE(samples_of(blocks, 0));
}

CircularSetup full_setup() {
    CircularSetup setup;
    setup.plan.plane = CircularPlane::zx;
    setup.plan.nominal_radius_mm = 150;
    setup.plan.feed_mm_per_s = 1000.0 / 60;
    setup.plan.senses = {Sense::cw, Sense::ccw};
    setup.plan.repeats = 3;
    setup.plan.warm_up = 1;
    setup.plan.start_deg = -20;
    setup.plan.arc_deg = 220;
    setup.plan.overshoot_deg = 10;
    setup.plan.feed_in_mm = 0.8;
    setup.plan.feed_in_outside = false;
    setup.plan.centre_mm = {1, -2, 3};
    setup.plan.tool_offset = "Z 120 mm";
    setup.plan.work_offset = "Z 150 mm";
    setup.plan.start = StartMethod::trigger;
    setup.plan.trigger_delay_s = 0.008;
    setup.capture = {1000, 40, 4};
    setup.bar_instrument = "ballbar";
    setup.bar_sign = -1;
    setup.bar_length_mm = 150.0123;
    setup.bar_alpha_per_K = 0.5e-6;
    setup.bar_temperature_channel = 7;
    setup.uncertainty.device_width_um = 0.5;
    setup.uncertainty.runs = 3;
    return setup;
}

/// A file with two chunks, closed.
std::string write_file(const ScratchFolder& scratch) {
    RandomRun random{11};
    const std::string path = scratch.file("circle.axiscal");
    RunRecord header = random.header();
    header.kind = TestKind::circular;
    auto writer = RunFileWriter::create(path, header).value();
    RunBatch batch;
    batch.circular = full_setup();
    batch.streams.push_back({0, 4, "ballbar", "m", 1000});
    batch.chunks.push_back(chunk_of(ballbar_values(1000), 0));
    batch.chunks.back().head.time_uncertainty = std::chrono::microseconds{40};
    EXPECT_TRUE(writer.write(batch));
    RunBatch second;
    second.chunks.push_back(chunk_of(ballbar_values(900), 1));
    EXPECT_TRUE(writer.write(second));
    EXPECT_TRUE(writer.close(true, "done", random.tie()));
    return path;
}

TEST(CircularRunFile, GivesBackPlanBarStatementAndStream) {
    const ScratchFolder scratch;
    const auto read = read_run_file_contents(write_file(scratch));
    ASSERT_TRUE(read) << read.error().detail;
    const auto* kept = std::get_if<CircularSetup>(&read->attachments.setup);
    ASSERT_NE(kept, nullptr);
    const CircularSetup &found = *kept, wanted = full_setup();
    EXPECT_EQ(found.plan.plane, wanted.plan.plane);
    EXPECT_EQ(found.plan.senses, wanted.plan.senses);
    EXPECT_EQ(found.plan.feed_mm_per_s, wanted.plan.feed_mm_per_s);
    EXPECT_EQ(found.plan.repeats, 3);
    EXPECT_EQ(found.plan.warm_up, 1);
    EXPECT_EQ(found.plan.start_deg, -20);
    EXPECT_EQ(found.plan.arc_deg, 220);
    EXPECT_EQ(found.plan.overshoot_deg, 10);
    EXPECT_EQ(found.plan.feed_in_mm, 0.8);
    EXPECT_FALSE(found.plan.feed_in_outside);
    EXPECT_EQ(found.plan.centre_mm, wanted.plan.centre_mm);
    EXPECT_EQ(found.plan.work_offset, "Z 150 mm");
    EXPECT_EQ(found.plan.start, StartMethod::trigger);
    EXPECT_EQ(found.plan.trigger_delay_s, 0.008);
    EXPECT_EQ(found.capture.sample_rate_hz, 1000);
    EXPECT_EQ(found.capture.low_pass_hz, 40);
    EXPECT_EQ(found.capture.averaged, 4);
    EXPECT_EQ(found.bar_instrument, "ballbar");
    EXPECT_EQ(found.bar_sign, -1);
    EXPECT_EQ(found.bar_length_mm, 150.0123);
    EXPECT_EQ(found.bar_alpha_per_K, 0.5e-6);
    EXPECT_FALSE(found.machine_alpha_per_K);
    EXPECT_EQ(found.bar_temperature_channel, 7);
    EXPECT_EQ(found.uncertainty.device_width_um, 0.5);
    EXPECT_FALSE(found.uncertainty.eve_um);
    EXPECT_EQ(found.uncertainty.runs, 3);
    ASSERT_EQ(read->streams.size(), 1U);
    EXPECT_EQ(read->streams[0].channel, 4);
    const auto samples = samples_of(read->blocks, 0);
    ASSERT_TRUE(samples);
    const auto first = ballbar_values(1000);
    ASSERT_EQ(samples->value.size(), 1900U);
    EXPECT_TRUE(std::equal(first.begin(), first.end(), samples->value.begin()));
    ASSERT_EQ(samples->times.size(), 2U);
    EXPECT_EQ(samples->times[0].time_uncertainty, std::chrono::microseconds{40});
    EXPECT_EQ(samples->times[1].from, 1000U);
    EXPECT_EQ(samples->times[1].time_uncertainty, Duration{});
}

void run_sql(const std::string& path, const std::string& sql) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(connection);
}

TEST(CircularRunFile, AChangedByteOfTheStreamBreaksTheChain) {
    const ScratchFolder scratch;
    const std::string path = write_file(scratch);
    run_sql(path, "UPDATE stream_block SET data = zeroblob(length(data)) WHERE block = 1");
    const auto read = read_run_file_contents(path);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().detail.find("stream_block"), std::string::npos);
}

TEST(CircularRunFile, AValueThatIsNoNumberIsNotWritten) {
    const ScratchFolder scratch;
    RandomRun random{12};
    auto writer = RunFileWriter::create(scratch.file("r.axiscal"), random.header()).value();
    RunBatch batch;
    batch.streams.push_back({0, 4, "ballbar", "m", std::nan("")});
    const auto written = writer.write(batch);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().fault, Fault::internal);
}

} // namespace
} // namespace axiscal::stream_packing_test

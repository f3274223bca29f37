#include "acquisition/capture/min_max_pyramid.hpp"
#include "acquisition/capture/stream_chunker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace axiscal::stream_chunker_test {
namespace {

using namespace std::chrono_literals;

MonotonicTime at_ms(std::int64_t ms) {
    return monotonic_from_ns(1'000'000'000 + ms * 1'000'000);
}
Sample sample(std::uint64_t count, double value = 1e-6, std::uint32_t epoch = 1) {
    return {0, at_ms(static_cast<std::int64_t>(count)), value, count, epoch};
}

/// Every chunk that comes out of these samples.
std::vector<StreamChunk> chunks_of(StreamChunker& chunker, const std::vector<Sample>& samples) {
    std::vector<StreamChunk> chunks;
    for (const Sample& one : samples)
        if (auto chunk = chunker.push(one)) chunks.push_back(*std::move(chunk));
    if (auto rest = chunker.finish()) chunks.push_back(*std::move(rest));
    return chunks;
}

TEST(StreamChunker, EverySampleComesOutOnceAndInOrder) {
    StreamChunker chunker{3};
    std::vector<Sample> samples;
    for (std::uint64_t i = 1; i <= 2500; ++i)
        samples.push_back(sample(i, static_cast<double>(i)));
    const auto chunks = chunks_of(chunker, samples);
    ASSERT_EQ(chunks.size(), 3U); // a chunk ends after one second
    double next = 1;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        EXPECT_EQ(chunks[i].head.stream, 3);
        EXPECT_EQ(chunks[i].head.index, static_cast<std::int64_t>(i));
        EXPECT_EQ(chunks[i].head.before, "");
        for (const double value : chunks[i].value)
            EXPECT_EQ(value, next++);
    }
    EXPECT_EQ(next, 2501);
    EXPECT_EQ(chunker.gaps(), 0U);
}

TEST(StreamChunker, ALostNumberEndsAChunkAndIsCounted) {
    StreamChunker chunker{0};
    const auto chunks = chunks_of(chunker, {sample(1), sample(2), sample(7), sample(8)});
    ASSERT_EQ(chunks.size(), 2U);
    EXPECT_EQ(chunks[1].head.before, "gap");
    EXPECT_EQ(chunks[1].head.missing, 4U);
    EXPECT_EQ(chunks[1].head.first_count, 7U);
    EXPECT_EQ(chunker.gaps(), 1U);
    EXPECT_EQ(chunker.missing(), 4U);
}

TEST(StreamChunker, AChunkBearsTheLargestUncertaintyOfItsTimes) {
    const auto uncertain = [](std::uint64_t ms, int microseconds) {
        Sample one = sample(ms);
        one.time_uncertainty = std::chrono::microseconds{microseconds};
        return one;
    };
    StreamChunker chunker{0};
    const auto chunks = chunks_of(chunker, {uncertain(1, 5), uncertain(2, 9), uncertain(3, 7)});
    ASSERT_EQ(chunks.size(), 1U);
    EXPECT_EQ(chunks[0].head.time_uncertainty, std::chrono::microseconds{9});
    StreamChunker partly{0};
    EXPECT_EQ(
        chunks_of(partly, {uncertain(1, 5), sample(2), uncertain(3, 7)})[0].head.time_uncertainty,
        Duration{})
        << "not stated, never the smaller one";
}

TEST(StreamChunker, BehindAnInterruptedRecordTheHoleIsNamedAndCounted) {
    StreamBlock last;
    last.stream = 3;
    last.index = 7;
    last.first_count = 1001;
    last.samples = 500;
    last.end = at_ms(1500);
    StreamChunker chunker{last, true};
    const auto chunks = chunks_of(chunker, {sample(4000), sample(4001)});
    ASSERT_EQ(chunks.size(), 1U);
    EXPECT_EQ(chunks[0].head.stream, 3);
    EXPECT_EQ(chunks[0].head.index, 8);
    EXPECT_EQ(chunks[0].head.before, "interrupted");
    EXPECT_EQ(chunks[0].head.missing, 2499U); // 1501 to 3999
    StreamChunker renumbered{last, false};
    EXPECT_EQ(chunks_of(renumbered, {sample(4000)})[0].head.missing, 0U);
}

TEST(StreamChunker, ABadSampleAndANewEpochAreHolesWithTheirNames) {
    StreamChunker chunker{0};
    const auto chunks = chunks_of(
        chunker, {sample(1), Sample::bad(0, at_ms(2), Quality::absent, 2, 1),
                  Sample::bad(0, at_ms(3), Quality::absent, 3, 1), sample(4), sample(5, 1e-6, 2)});
    ASSERT_EQ(chunks.size(), 3U);
    EXPECT_EQ(chunks[1].head.before, "absent");
    EXPECT_EQ(chunks[2].head.before, "epoch");
    EXPECT_EQ(chunker.gaps(), 2U);
}

TEST(StreamChunker, TimesAlwaysAscend) {
    StreamChunker chunker{0};
    Sample early = sample(3); // its clock was corrected back by 2 ms
    early.at = at_ms(1);
    const auto chunks = chunks_of(chunker, {sample(1), sample(2), early, sample(4)});
    ASSERT_EQ(chunks.size(), 1U);
    ASSERT_EQ(chunks[0].at.size(), 4U);
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_LT(chunks[0].at[i - 1], chunks[0].at[i]);
    StreamChunker unnumbered{0};
    const auto kept = chunks_of(unnumbered, {Sample{0, at_ms(5), 1}, Sample{0, at_ms(4), 2}});
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].value, std::vector<double>{1});
    EXPECT_EQ(unnumbered.disordered(), 1U);
}

TEST(StreamChunker, NoChunkGrowsBeyondItsBound) {
    StreamChunker chunker{0};
    std::size_t longest = 0, all = 0;
    for (std::uint64_t i = 1; i <= 50'000; ++i) { // 50 kHz
        Sample one{0, monotonic_from_ns(static_cast<std::int64_t>(i) * 20'000), 1e-3, i, 1};
        if (const auto chunk = chunker.push(one)) {
            longest = std::max(longest, chunk->value.size());
            all += chunk->value.size();
        }
    }
    EXPECT_EQ(longest, StreamChunker::most_samples);
    EXPECT_EQ(all + chunker.finish()->value.size(), 50'000U);
}

TEST(MinMaxPyramid, ShowsEveryPeakHoweverLongTheStream) {
    MinMaxPyramid pyramid{64};
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> value{-1, 1};
    std::vector<double> all;
    for (int i = 0; i < 100'003; ++i) {
        all.push_back(i == 71'234 ? 9 : value(random));
        pyramid.push(all.back());
    }
    const auto seen = pyramid.view(64);
    ASSERT_LE(seen.size(), 64U);
    ASSERT_GE(seen.size(), 32U);
    const auto width = static_cast<std::size_t>(pyramid.samples_a_stretch());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(i * width);
        const auto to =
            all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), (i + 1) * width));
        EXPECT_EQ(seen[i].low, *std::min_element(from, to));
        EXPECT_EQ(seen[i].high, *std::max_element(from, to));
    }
    EXPECT_EQ(pyramid.samples(), all.size());
    EXPECT_EQ(pyramid.view(1).size(), 1U);
    EXPECT_EQ(pyramid.view(1)[0].high, 9);
}

TEST(MinMaxPyramid, ShowsTheSameHoweverTheStreamWasCut) {
    std::mt19937_64 random{6};
    std::normal_distribution<double> value{0, 1};
    std::vector<double> all(20'011);
    std::ranges::generate(all, [&] { return value(random); });
    MinMaxPyramid one_by_one{64}, in_pieces{64};
    for (const double each : all)
        one_by_one.push(each);
    for (std::span<const double> rest = all; !rest.empty();) {
        const auto piece = rest.first(std::min<std::size_t>(rest.size(), random() % 1000));
        in_pieces.push(piece);
        rest = rest.subspan(piece.size());
    }
    EXPECT_EQ(in_pieces.view(64), one_by_one.view(64));
    EXPECT_EQ(in_pieces.samples(), all.size());
}

TEST(MinMaxPyramid, AShortStreamIsShownSampleBySample) {
    MinMaxPyramid pyramid{8};
    EXPECT_TRUE(pyramid.view(10).empty());
    for (const double value : {3.0, -1.0, 2.0})
        pyramid.push(value);
    EXPECT_EQ(pyramid.view(10), (std::vector<MinMax>{{3, 3}, {-1, -1}, {2, 2}}));
    EXPECT_EQ(pyramid.view(2), (std::vector<MinMax>{{-1, 3}, {2, 2}}));
}

} // namespace
} // namespace axiscal::stream_chunker_test

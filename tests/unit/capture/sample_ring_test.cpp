#include "acquisition/capture/sample_ring.hpp"

#include "axis_signal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace axiscal::sample_ring_test {
namespace {

using testing::at_s;

TEST(SampleRing, HoldsItsSamplesSideBySideHoweverOftenItHasGoneRound) {
    constexpr std::size_t kept = 300;
    SampleRing ring{kept + 1};
    for (int i = 0; i < 10'000; ++i) {
        ring.push(Sample{0, at_s(i), 1.0 * i});
        if (ring.size() > kept) ring.pop();
        const auto samples = ring.all();
        ASSERT_EQ(samples.size(), std::min<std::size_t>(kept, static_cast<std::size_t>(i) + 1));
        double expected = i - static_cast<double>(samples.size()) + 1;
        for (const Sample& sample : samples)
            ASSERT_EQ(sample.value(), expected++) << "of " << i;
    }
}

/// Pushes `pushes` samples of which the last `kept` stay, and looks at all of them now and then.
void expect_kept(std::size_t capacity, std::size_t kept, int pushes) {
    SampleRing ring{capacity};
    for (int i = 0; i < pushes; ++i) {
        ring.push(Sample{0, at_s(i), 1.0 * i});
        if (ring.size() > kept) ring.pop();
        if (i % 997 != 0) continue;
        double expected = i - static_cast<double>(ring.size()) + 1;
        for (const Sample& sample : ring.all())
            ASSERT_EQ(sample.value(), expected++) << "of " << i << ", " << kept << " kept";
    }
}

TEST(SampleRing, KeepsEverySampleThatIsAliveWhereverItGivesMemoryBack) {
    for (const std::size_t kept : {1U, 3'000U, 6'000U, 12'000U, 16'000U, 19'999U})
        expect_kept(20'000, kept, 100'000);
}

TEST(SampleRing, FilledAndEmptiedHoldsWhatIsPushedNext) {
    SampleRing ring{20'000};
    double next = 0;
    for (int round = 0; round < 5; ++round) {
        while (ring.size() < 20'000)
            ring.push(Sample{0, at_s(next), next}), ++next;
        double expected = next - 20'000;
        for (const Sample& sample : ring.all())
            ASSERT_EQ(sample.value(), expected++) << "round " << round;
        while (ring.size() > 7)
            ring.pop();
        EXPECT_EQ(ring.all().back().value(), next - 1);
    }
}

/// Of the pages from `begin` on, those that are in memory.
std::size_t resident_bytes(const void* begin, std::size_t bytes) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    std::vector<unsigned char> pages(bytes / page);
    EXPECT_EQ(::mincore(const_cast<void*>(begin), pages.size() * page, pages.data()), 0);
    return page * static_cast<std::size_t>(std::ranges::count_if(
                      pages, [](unsigned char one) { return (one & 1U) != 0; }));
}

// The history of a laser of 10 kHz: room for a minute, of which a third of a second is kept.
TEST(SampleRing, HoldsNoMoreMemoryThanItsSamplesNeedHoweverOftenItHasGoneRound) {
    constexpr std::size_t capacity = 600'000, kept = 3'000;
    SampleRing ring{capacity};
    ring.push(Sample{0, at_s(0), 0.0});
    const Sample* const begin = ring.all().data();
    std::size_t most = 0;
    for (int i = 1; i < 2'000'000; ++i) {
        ring.push(Sample{0, at_s(i), 1.0 * i});
        if (ring.size() > kept) ring.pop();
        if (i % 50'000 == 0)
            most = std::max(most, resident_bytes(begin, capacity * sizeof(Sample)));
    }
    EXPECT_GE(most, kept * sizeof(Sample));
    EXPECT_LE(most, kept * sizeof(Sample) + 512 * 1024) << "of " << capacity * sizeof(Sample);
}

TEST(SampleRing, IsMovedWithoutItsSamples) {
    SampleRing ring{10};
    ring.push(Sample{0, at_s(1), 2.5});
    const Sample* const place = ring.all().data();
    const SampleRing moved{std::move(ring)};
    EXPECT_EQ(moved.all().data(), place);
    EXPECT_EQ(moved.all().front().value(), 2.5);
}

TEST(SampleRing, SaysThatThereIsNoMemory) {
    constexpr std::size_t beyond_any_address_space = std::size_t{1} << 50U;
    EXPECT_THROW(SampleRing{beyond_any_address_space}, std::bad_alloc);
}

} // namespace
} // namespace axiscal::sample_ring_test

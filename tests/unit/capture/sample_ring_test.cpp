#include "acquisition/capture/sample_ring.hpp"

#include "axis_signal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <utility>

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

// What is missing in a stream without numbers: told by the times of its frames alone.
#include "drivers/canopen/pdo_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace axiscal::pdo_stream_test {
namespace {

using namespace std::chrono_literals;

constexpr Duration period = 1ms;

MonotonicTime at(Duration since) {
    return monotonic_from_ns(1'000'000'000) + since;
}

class PdoStreamTest : public ::testing::Test {
protected:
    void take(Duration when, std::uint64_t dropped = 0) {
        PdoArrival arrival;
        arrival.at = at(when);
        arrival.dropped = dropped;
        for (const auto& one : stream.take(arrival))
            got.push_back(one);
    }
    /// Frame n was made at n periods and arrives `late` after that.
    void take_all(int begin, int end, Duration late = 0ms) {
        for (int n = begin; n < end; ++n)
            take(n * period + late);
    }
    PdoStream stream{period};
    std::vector<PdoStream::Numbered> got;
};

TEST_F(PdoStreamTest, NumbersEveryFrameAtOnce) {
    take_all(0, 1000);
    ASSERT_EQ(got.size(), 1000U);
    EXPECT_EQ(got.front().number, 1U);
    EXPECT_EQ(got.back().number, 1000U);
    EXPECT_EQ(got.back().at, at(999ms));
    EXPECT_EQ(stream.lost(), 0U);
}

TEST_F(PdoStreamTest, FindsOneFrameThatIsMissing) {
    take_all(0, 100);
    take_all(101, 200);
    ASSERT_EQ(got.size(), 199U);
    EXPECT_EQ(stream.lost(), 1U);
    EXPECT_EQ(got[99].number, 100U);
    EXPECT_EQ(got[100].number, 102U) << "the first after the hole, not one after some thirty";
    EXPECT_EQ(got[100].at, at(101ms));
    EXPECT_EQ(got.back().number, 200U);
}

TEST_F(PdoStreamTest, FindsFortyFramesThatAreMissing) {
    take_all(0, 100);
    take_all(140, 240);
    EXPECT_EQ(stream.lost(), 40U);
    EXPECT_EQ(got.back().number, 240U);
}

TEST_F(PdoStreamTest, TakesAHoldUpForNoLoss) {
    take_all(0, 100);
    // The computer stood for 20 ms: what waited is stamped at once.
    for (int n = 100; n < 120; ++n)
        take(120ms + n * 1us);
    take_all(121, 300);
    EXPECT_EQ(stream.lost(), 1U) << "frame 120 alone is missing";
    EXPECT_EQ(got.back().number, 300U);
    for (std::size_t i = 1; i < got.size(); ++i)
        EXPECT_LT(
            std::abs(seconds_of(got[i].at - at(static_cast<int>(got[i].number - 1) * period))),
            2e-3);
}

TEST_F(PdoStreamTest, IsNotMisledByABusyBus) {
    std::mt19937 random{7};
    std::uniform_int_distribution<int> late_us{0, 600};
    for (int n = 0; n < 60'000; ++n)
        take(n * period + late_us(random) * 1us);
    EXPECT_EQ(stream.lost(), 0U);
    ASSERT_EQ(got.size(), 60'000U);
    // Between the least delay and the mean one.
    for (std::size_t i = 1000; i < got.size(); ++i)
        EXPECT_NEAR(seconds_of(got[i].at - at(static_cast<int>(i) * period)), 150e-6, 150e-6);
}

TEST_F(PdoStreamTest, FollowsACrystalThatIsOff) {
    for (int n = 0; n < 60'000; ++n)
        take(n * 1'000'300ns); // 300 ppm slow
    EXPECT_EQ(stream.lost(), 0U);
    EXPECT_NEAR(seconds_of(got.back().at - at(59'999 * 1'000'300ns)), 0, 50e-6);
}

TEST_F(PdoStreamTest, BelievesTheKernelsOwnCount) {
    take_all(0, 10);
    take(30ms, 20);
    EXPECT_EQ(stream.lost(), 20U);
    ASSERT_EQ(got.size(), 11U) << "nothing is held back: the number is known";
    EXPECT_EQ(got.back().number, 31U);
}

TEST_F(PdoStreamTest, HandsOutWhatItHeldWhenTheStreamEnds) {
    take_all(0, 10);
    take_all(15, 20);
    EXPECT_EQ(got.size(), 10U);
    const auto rest = stream.finish();
    ASSERT_EQ(rest.size(), 5U);
    EXPECT_EQ(rest.front().number, 16U);
    EXPECT_EQ(stream.lost(), 5U);
}

} // namespace
} // namespace axiscal::pdo_stream_test

#include "analysis/record/stream_rate.hpp"

#include <gtest/gtest.h>

namespace axiscal::stream_rate_test {
namespace {

using namespace std::chrono_literals;

StreamSamples sampled_at(std::initializer_list<Duration> times) {
    StreamSamples stream;
    for (const Duration time : times) {
        stream.at.emplace_back(time);
        stream.value.push_back(0);
    }
    return stream;
}

TEST(StreamRate, CountsWhatTheNumberingLeftOut) {
    StreamSamples stream = sampled_at({0ms, 1ms, 2ms, 6ms, 7ms});
    stream.gaps = {{3, 3, "gap"}};
    EXPECT_EQ(nominal_rate_hz(stream), 1000);
}

TEST(StreamRate, LeavesOutWhatIsMissingBeforeTheFirstSample) {
    StreamSamples stream = sampled_at({5ms, 6ms, 7ms});
    stream.gaps = {{0, 5, "gap"}};
    EXPECT_EQ(nominal_rate_hz(stream), 1000);
}

TEST(StreamRate, IsRoundedToThreeDigits) {
    EXPECT_EQ(nominal_rate_hz(49'983, 1s), 50'000);
    EXPECT_EQ(nominal_rate_hz(1234, 1s), 1230);
    EXPECT_EQ(nominal_rate_hz(1, 800ms), 1.25);
}

TEST(StreamRate, IsNotKnownOfOneSample) {
    EXPECT_EQ(nominal_rate_hz(sampled_at({})), 0);
    EXPECT_EQ(nominal_rate_hz(sampled_at({1ms})), 0);
    EXPECT_EQ(nominal_rate_hz(sampled_at({1ms, 1ms})), 0);
}

} // namespace
} // namespace axiscal::stream_rate_test

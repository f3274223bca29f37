#include "acquisition/capture/sample_history.hpp"

#include "axis_signal.hpp"

#include <gtest/gtest.h>

namespace axiscal::sample_history_test {
namespace {

using testing::at_s;

TEST(SampleHistory, KeepsTheLastMinutesAndNothingOlder) {
    SampleHistory history{{std::chrono::seconds{10}, 100'000}};
    for (int i = 0; i <= 60; ++i)
        history.push(Sample{0, at_s(i), 1.0});
    ASSERT_EQ(history.all().size(), 11u);
    EXPECT_EQ(history.all().front().at, at_s(50));
    EXPECT_TRUE(history.reaches_back_to(at_s(50)));
    EXPECT_FALSE(history.reaches_back_to(at_s(49)));
}

TEST(SampleHistory, NeverHoldsMoreThanItsCapacity) {
    SampleHistory history{{std::chrono::hours{10}, 50}};
    for (int i = 0; i < 10'000; ++i) {
        history.push(Sample{0, at_s(i * 1e-3), 1.0});
        ASSERT_LE(history.all().size(), 50u);
    }
    EXPECT_EQ(history.all().back().at, at_s(9.999));
}

TEST(SampleHistory, DoesNotReachBackBeforeItsFirstSample) {
    SampleHistory history;
    EXPECT_FALSE(history.reaches_back_to(at_s(1)));
    history.push(Sample{0, at_s(5), 1.0});
    EXPECT_FALSE(history.reaches_back_to(at_s(4.9)));
    EXPECT_TRUE(history.reaches_back_to(at_s(5)));
}

TEST(SampleHistory, DropsAndCountsSamplesThatComeFromThePast) {
    SampleHistory history;
    history.push(Sample{0, at_s(2), 2.0});
    history.push(Sample{0, at_s(1), 1.0});
    history.push(Sample{0, at_s(2), 3.0});
    EXPECT_EQ(history.all().size(), 2u);
    EXPECT_EQ(history.disordered(), 1u);
}

TEST(SampleHistory, WindowIncludesBothItsEnds) {
    SampleHistory history;
    for (int i = 0; i < 10; ++i)
        history.push(Sample{0, at_s(i), 1.0 * i});
    const auto window = history.between(at_s(3), at_s(6));
    ASSERT_EQ(window.size(), 4u);
    EXPECT_EQ(window.front().at, at_s(3));
    EXPECT_EQ(window.back().at, at_s(6));
    EXPECT_TRUE(history.between(at_s(3.1), at_s(3.9)).empty());
    EXPECT_TRUE(history.between(at_s(20), at_s(30)).empty());
}

TEST(SampleHistory, KnowsGapsInTheDevicesOwnNumbering) {
    SampleHistory history;
    for (const std::uint64_t count : std::initializer_list<std::uint64_t>{10, 11, 12, 15, 16, 18})
        history.push(Sample{0, at_s(static_cast<double>(count)), 1.0, count});
    EXPECT_EQ(history.gaps(), 2u);
}

TEST(SampleHistory, CountsNoGapWhereTheCounterLostItsZero) {
    SampleHistory history;
    history.push(Sample{0, at_s(1), 1.0, 10, 1});
    history.push(Sample{0, at_s(2), 0.0, 12, 2});
    EXPECT_EQ(history.gaps(), 0u);
}

TEST(SampleHistory, LawEveryWindowHoldsExactlyTheYoungSamplesInside) {
    std::mt19937_64 random{7};
    for (int round = 0; round < 50; ++round) {
        SampleHistory history{{std::chrono::seconds{5}, 200}};
        std::vector<double> pushed;
        double now = 0;
        for (int i = 0; i < 400; ++i) {
            now += static_cast<double>(random() % 100) * 1e-3;
            pushed.push_back(now);
            history.push(Sample{0, at_s(now), now});
        }
        const double begin = now - static_cast<double>(random() % 4000) * 1e-3;
        const double end = begin + static_cast<double>(random() % 2000) * 1e-3;
        std::size_t expected = 0;
        for (std::size_t i = 200; i < pushed.size(); ++i)
            if (at_s(pushed[i]) >= at_s(begin) && at_s(pushed[i]) <= at_s(end)) ++expected;
        if (history.reaches_back_to(at_s(begin))) {
            EXPECT_EQ(history.between(at_s(begin), at_s(end)).size(), expected);
        }
    }
}

TEST(LongestSilence, CountsTheEndsOfTheSpanToo) {
    const std::vector<Sample> samples{Sample{0, at_s(1), 0}, Sample{0, at_s(1.5), 0}};
    EXPECT_EQ(longest_silence(summary_of(samples), at_s(0), at_s(2)), std::chrono::seconds{1});
    EXPECT_EQ(longest_silence(summary_of(samples), at_s(1), at_s(4)),
              std::chrono::milliseconds{2500});
    EXPECT_EQ(longest_silence(SampleSummary{}, at_s(1), at_s(4)), std::chrono::seconds{3});
}

} // namespace
} // namespace axiscal::sample_history_test

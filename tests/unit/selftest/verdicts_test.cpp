#include "tools/axiscal/selftest/selftest.hpp"

#include <gtest/gtest.h>

namespace axiscal::verdicts_test {
namespace {

bool says(const SelftestVerdict& verdict, const std::string& words) {
    return verdict.sentence.find(words) != std::string::npos;
}

TEST(SelfTest, OrdersItsTrials) {
    std::vector<double> hundred_and_one;
    for (int i = 100; i >= 0; --i)
        hundred_and_one.push_back(i);
    const Delays delays = delays_of(hundred_and_one);
    EXPECT_EQ(delays.count, 101);
    EXPECT_EQ(delays.median_us, 50);
    EXPECT_EQ(delays.p99_us, 99);
    EXPECT_EQ(delays.worst_us, 100);
    EXPECT_EQ(delays_of({}).count, 0);
}

TEST(SelfTest, CallsADiskThatIsTooFastToBeOneUnsafe) {
    EXPECT_FALSE(judge_commit({200, 12, 20, 40}).ok);
    EXPECT_TRUE(says(judge_commit({200, 12, 20, 40}), "power cut"));
    EXPECT_TRUE(judge_commit({200, 180, 400, 900}).ok);
    EXPECT_FALSE(judge_commit({200, 25'000, 40'000, 90'000}).ok);
}

// 1 ms at 1000 mm/min is 16.7 um of travel.
TEST(SelfTest, SaysLatenessInTravel) {
    EXPECT_TRUE(says(judge_timer({200, 60, 1000, 2000}), "16.7 um"));
    EXPECT_TRUE(judge_timer({200, 60, 1000, 2000}).ok);
    EXPECT_FALSE(judge_timer({200, 60, 8000, 9000}).ok);
}

TEST(SelfTest, TellsWhatAnAdapterHoldsBack) {
    const SelftestVerdict slow = judge_port({"/dev/ttyUSB0", 16, ""});
    EXPECT_FALSE(slow.ok);
    EXPECT_TRUE(says(slow, "16 ms"));
    EXPECT_TRUE(says(slow, "267 um"));
    EXPECT_TRUE(judge_port({"/dev/ttyUSB0", 1, ""}).ok);
    EXPECT_TRUE(says(judge_port({"/dev/ttyS0", {}, ""}), "not known"));
    EXPECT_FALSE(judge_port({"/dev/ttyS0", {}, "No such file or directory"}).ok);
}

TEST(SelfTest, MeasuresThisComputer) {
    for (const auto& measured :
         {measure_commit("/tmp", 10), measure_timer(20), measure_serial(20)}) {
        ASSERT_TRUE(measured) << describe(measured.error());
        EXPECT_GE(measured->count, 10);
        EXPECT_GT(measured->median_us, 0);
        EXPECT_GE(measured->p99_us, measured->median_us);
        EXPECT_GE(measured->worst_us, measured->p99_us);
    }
    EXPECT_FALSE(measure_commit("/nowhere", 10));
}

} // namespace
} // namespace axiscal::verdicts_test

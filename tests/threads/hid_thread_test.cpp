// The threads of HID links: each owns its stick, and hidapi, which keeps state for the whole
// process, is entered by one thread at a time.
#include "drivers/wire/hid_link.hpp"
#include "tests/threads/link_bench.hpp"
#include "tests/threads/usb_doubles.hpp"

#include <gtest/gtest.h>

namespace axiscal {
namespace {

using OpenedLink = Result<std::unique_ptr<ByteLink>>;

class HidThread : public ::testing::Test {
protected:
    HidThread() { testing::seen_at("1-2") = testing::seen_at("1-3") = {}; }
    Task<OpenedLink> opening(const std::string& port) {
        UsbPlace place;
        place.port = port;
        place.interface = 1;
        return open_hid(bench.scheduler, *bench.threads, place, bench.soon());
    }
    /// The stick answers each report with its first byte.
    int ask(ByteLink& link, int value) {
        std::vector<std::byte> report{static_cast<std::byte>(value)};
        if (!bench.wait(link.write_all(std::move(report), bench.soon()))) return -1;
        const auto answer = bench.wait(link.read_some(bench.soon()));
        return answer && answer->bytes.size() == 1 ? std::to_integer<int>(answer->bytes[0]) : -1;
    }
    testing::LinkBench bench;
};

TEST_F(HidThread, TwoSticksAreOpenedAtOnceAndEachKeepsToItsOwnThread) {
    std::optional<OpenedLink> second;
    bench.begin(opening("1-3"), second);
    auto first = bench.wait(opening("1-2"));
    ASSERT_TRUE(testing::loop_until(bench.loop, [&] { return second.has_value(); }));
    ASSERT_TRUE(first && *second);
    for (int value = 0; value < 50; ++value) {
        EXPECT_EQ(ask(**first, value), value);
        EXPECT_EQ(ask(***second, value), value);
    }
    first->reset();
    second->value().reset();
    bench.end_threads();
    const auto& one = testing::seen_at("1-2");
    const auto& other = testing::seen_at("1-3");
    EXPECT_EQ(one.closed, 1);
    EXPECT_EQ(other.closed, 1);
    ASSERT_EQ(one.threads.size(), 1U);
    ASSERT_EQ(other.threads.size(), 1U);
    EXPECT_NE(*one.threads.begin(), *other.threads.begin());
    EXPECT_FALSE(one.threads.contains(std::this_thread::get_id()));
}

TEST_F(HidThread, ASilentStickIsToldAndItsLinkCanBeDroppedWhileItIsRead) {
    auto link = bench.wait(opening("1-2"));
    ASSERT_TRUE(link);
    const auto silent = bench.wait((*link)->read_some(bench.scheduler.now()));
    ASSERT_FALSE(silent);
    EXPECT_EQ(silent.error().fault, Fault::link_timeout);
    std::optional<Result<TimedBytes>> late;
    bench.begin((*link)->read_some(bench.scheduler.now() + std::chrono::milliseconds{200}), late);
    bench.loop.restart();
    bench.loop.poll(); // the job is on its way
    link->reset();
    ASSERT_TRUE(testing::loop_until(bench.loop, [&] { return late.has_value(); }));
    EXPECT_FALSE(*late);
    bench.end_threads();
    EXPECT_EQ(testing::seen_at("1-2").closed, 1);
}

} // namespace
} // namespace axiscal

// The thread of a USB link: every call of the device is made on it, packets that it reads ahead
// reach the loop in order and whole, and it ends with the link.
#include "drivers/wire/usb_link.hpp"
#include "tests/threads/link_bench.hpp"
#include "tests/threads/usb_doubles.hpp"

#include <gtest/gtest.h>

namespace axiscal {
namespace {

constexpr int bulk_endpoint = 0x81;
constexpr std::size_t packet_size = 64;

class UsbThread : public ::testing::Test {
protected:
    UsbThread() {
        testing::seen_at("1-1") = {};
        UsbPlace place;
        place.port = "1-1";
        link = bench.wait(open_usb_device(bench.scheduler, *bench.threads, place, bench.soon()))
                   .value();
    }
    int begin_stream() {
        UsbRequest request;
        request.value = 7;
        const auto reply = bench.wait(link->control_in(request, bench.soon()));
        return reply ? std::to_integer<int>(reply->bytes.at(0)) : -1;
    }
    int next_number() {
        const auto packet = bench.wait(link->next_packet(bulk_endpoint, packet_size, bench.soon()));
        if (!packet || packet->bytes.size() != 2) return -1;
        return std::to_integer<int>(packet->bytes[0]) +
               256 * std::to_integer<int>(packet->bytes[1]);
    }
    const testing::SeenByDevice& end() {
        link.reset();
        bench.end_threads();
        return testing::seen_at("1-1");
    }
    testing::LinkBench bench;
    std::unique_ptr<UsbLink> link;
};

TEST_F(UsbThread, HandsOverEveryPacketThatItReadAheadInOrder) {
    ASSERT_EQ(begin_stream(), 7);
    const int first = next_number();
    for (int i = 1; i < testing::packets_of_a_stream; ++i)
        ASSERT_EQ(next_number(), first + i);
    const auto silent =
        bench.wait(link->next_packet(bulk_endpoint, packet_size, bench.scheduler.now()));
    ASSERT_FALSE(silent);
    EXPECT_EQ(silent.error().fault, Fault::link_timeout);
}

TEST_F(UsbThread, IsTheOnlyOneThatTouchesTheDeviceAndClosesIt) {
    ASSERT_EQ(begin_stream(), 7);
    EXPECT_GE(next_number(), 0);
    EXPECT_TRUE(bench.wait(link->bulk_out(1, {std::byte{1}}, bench.soon())));
    ASSERT_EQ(begin_stream(), 7); // ends the reading ahead
    EXPECT_GE(next_number(), 0);
    const auto& seen = end();
    EXPECT_EQ(seen.opened, 1);
    EXPECT_EQ(seen.closed, 1);
    EXPECT_EQ(seen.threads.size(), 1U);
    EXPECT_FALSE(seen.threads.contains(std::this_thread::get_id()));
}

TEST_F(UsbThread, EndsWithALinkThatIsDroppedInTheMiddleOfAStream) {
    ASSERT_EQ(begin_stream(), 7);
    EXPECT_GE(next_number(), 0);
    EXPECT_EQ(end().closed, 1); // packets on their way to the loop die with it
}

} // namespace
} // namespace axiscal

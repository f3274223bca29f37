#include "config/address_range.hpp"

#include <gtest/gtest.h>

namespace axiscal::address_range_test {
namespace {

bool covers(const char* range, const char* address) {
    const auto parsed = parse_address_range(range);
    EXPECT_TRUE(parsed) << range;
    return parsed && parsed->covers(address);
}

TEST(AddressRange, OneAddressCoversItselfAlone) {
    EXPECT_TRUE(covers("192.168.10.20", "192.168.10.20"));
    EXPECT_FALSE(covers("192.168.10.20", "192.168.10.21"));
    EXPECT_TRUE(covers("fd00::1", "fd00:0:0:0:0:0:0:1"));
}

TEST(AddressRange, ANetworkCoversFromItsFirstToItsLastAddress) {
    for (const char* inside : {"192.168.10.128", "192.168.10.191"})
        EXPECT_TRUE(covers("192.168.10.128/26", inside)) << inside;
    for (const char* outside : {"192.168.10.127", "192.168.10.192", "193.168.10.128"})
        EXPECT_FALSE(covers("192.168.10.128/26", outside)) << outside;
    EXPECT_TRUE(covers("0.0.0.0/0", "8.8.8.8"));
    EXPECT_FALSE(covers("0.0.0.0/0", "fd00::1"));
    EXPECT_TRUE(covers("fd00::/8", "fdff::1"));
}

TEST(AddressRange, KnowsAnIpv4ClientOfAnIpv6Listener) {
    EXPECT_TRUE(covers("192.168.10.0/24", "::ffff:192.168.10.7"));
}

TEST(AddressRange, RefusesSlipsOfThePen) {
    for (const char* wrong : {"", "cnc", "192.168.10", "192.168.10.20/24", "192.168.10.0/33",
                              "192.168.10.0/", "192.168.10.0/-1", "192.168.10.0/2x", "fd00::/129"})
        EXPECT_FALSE(parse_address_range(wrong)) << wrong;
}

TEST(AddressRange, KnowsThisComputer) {
    for (const char* home : {"127.0.0.1", "127.9.9.9", "::1", "::ffff:127.0.0.1"})
        EXPECT_TRUE(is_loopback(home)) << home;
    for (const char* other : {"0.0.0.0", "::", "192.168.10.20", "128.0.0.1"})
        EXPECT_FALSE(is_loopback(other)) << other;
}

} // namespace
} // namespace axiscal::address_range_test

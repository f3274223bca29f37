#include "acquisition/console/pairing.hpp"

#include "acquisition/console/session_cookie.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <map>

namespace axiscal::pairing_test {
namespace {

using namespace std::chrono_literals;

/// Bytes that count on, so that no two tokens are the same.
RandomBytes counting() {
    return [next = std::uint32_t{0}](std::span<std::uint8_t> bytes) mutable {
        ++next;
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = i < 4 ? static_cast<std::uint8_t>(next >> (24 - 8 * i)) : 0;
        return true;
    };
}

/// These numbers one after the other, and nothing behind them.
RandomBytes drawing(std::deque<std::uint32_t> numbers) {
    return [numbers = std::move(numbers)](std::span<std::uint8_t> bytes) mutable {
        if (numbers.empty()) return false;
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<std::uint8_t>(numbers.front() >> (24 - 8 * (i % 4)));
        numbers.pop_front();
        return true;
    };
}

PairingTime after(Duration span) {
    constexpr std::int64_t begin_utc_ns = 1'795'000'000'000'000'000;
    return {monotonic_from_ns(1'000'000'000) + span, begin_utc_ns + span.count()};
}

std::string another_than(const std::string& digits) {
    std::string wrong = digits;
    wrong.back() = wrong.back() == '0' ? '1' : '0';
    return wrong;
}

/// The token of a browser that is paired at `when`.
std::string pair_one(PairingDesk& desk, const std::string& name, const PairingTime& when) {
    const auto code = desk.offer(name, when);
    if (!code) return {};
    const auto opened = desk.open(code->digits, when);
    return opened ? opened->token : std::string{};
}

TEST(PairingCodes, HaveEightDigitsAndNoneIsLikelier) {
    EXPECT_EQ(random_code(drawing({42})).value(), "00000042");
    EXPECT_EQ(random_code(drawing({4'199'999'999U})).value(), "99999999");
    // 42 * 10^8 numbers are fair; what lies above is drawn again.
    EXPECT_EQ(random_code(drawing({4'200'000'000U, 4'294'967'295U, 7})).value(), "00000007");
}

TEST(PairingCodes, WithoutRandomBytesThereIsNone) {
    EXPECT_EQ(random_code(drawing({})).error().fault, Fault::internal);
    PairingDesk desk{drawing({7})};
    const auto code = desk.offer("", after(0s));
    ASSERT_TRUE(code);
    EXPECT_EQ(desk.open(code->digits, after(0s)).error().fault, Fault::internal);
    EXPECT_TRUE(desk.paired(after(0s)).empty());
}

TEST(Pairing, ACodeLetsOneBrowserInUnderItsName) {
    PairingDesk desk{counting()};
    const auto code = desk.offer("tablet 2", after(0s));
    ASSERT_TRUE(code);
    const auto opened = desk.open(code->digits, after(1s));
    ASSERT_TRUE(opened) << describe(opened.error());
    EXPECT_EQ(opened->name, "tablet 2");
    EXPECT_EQ(opened->token.size(), token_letters);
    const PairedBrowser* found = desk.find(opened->token, after(2s));
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->name, "tablet 2");
    EXPECT_EQ(found->token_hash.find(opened->token), std::string::npos);
    EXPECT_EQ(desk.find(std::string(token_letters, 'A'), after(2s)), nullptr);
    EXPECT_EQ(desk.find("", after(2s)), nullptr);
}

TEST(Pairing, WithoutANameItIsThePage) {
    PairingDesk desk{counting()};
    pair_one(desk, "", after(0s));
    EXPECT_EQ(desk.paired(after(0s)).at(0).name, "page");
}

TEST(Pairing, ACodeCountsOnce) {
    PairingDesk desk{counting()};
    const auto code = desk.offer("", after(0s));
    ASSERT_TRUE(desk.open(code->digits, after(1s)));
    const auto again = desk.open(code->digits, after(1s));
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().fault, Fault::refused);
    EXPECT_NE(again.error().detail.find("axiscal pair"), std::string::npos);
}

TEST(Pairing, ACodeCountsForFiveMinutesWhateverTheWallClockDoes) {
    PairingDesk desk{counting()};
    const auto code = desk.offer("", after(0s));
    PairingTime set_back = after(5min);
    set_back.utc_ns = after(0s).utc_ns;
    EXPECT_FALSE(desk.open(code->digits, set_back));
    const auto next = desk.offer("", after(0s));
    PairingTime set_forward = after(5min - 1ns);
    set_forward.utc_ns += Duration{24h}.count();
    EXPECT_TRUE(desk.open(next->digits, set_forward));
}

TEST(Pairing, AFurtherCodeMakesTheEarlierOneVoid) {
    PairingDesk desk{counting()};
    const auto first = desk.offer("first", after(0s)), second = desk.offer("second", after(1s));
    ASSERT_NE(first->digits, second->digits);
    EXPECT_FALSE(desk.open(first->digits, after(2s)));
    EXPECT_EQ(desk.open(second->digits, after(2s)).value().name, "second");
}

TEST(Pairing, FiveWrongCodesMakeItVoid) {
    PairingDesk desk{counting()};
    const auto code = desk.offer("", after(0s));
    const std::string wrong = another_than(code->digits);
    EXPECT_EQ(desk.open(wrong, after(1s)).error().detail, "the code is wrong; 4 tries left");
    for (const char* left : {"3 tries", "2 tries", "1 try"})
        EXPECT_NE(desk.open(wrong, after(1s)).error().detail.find(left), std::string::npos);
    const auto fifth = desk.open(wrong, after(1s));
    EXPECT_EQ(fifth.error().fault, Fault::refused);
    EXPECT_NE(fifth.error().detail.find("ask for a new one"), std::string::npos);
    EXPECT_FALSE(desk.open(code->digits, after(1s)));
}

TEST(Pairing, TheFifthTryMayBeTheRightOne) {
    PairingDesk desk{counting()};
    const auto code = desk.offer("", after(0s));
    for (int i = 0; i < most_wrong_codes - 1; ++i)
        EXPECT_FALSE(desk.open(another_than(code->digits), after(1s)));
    EXPECT_TRUE(desk.open(code->digits, after(1s)));
}

TEST(Pairing, TheSeventeenthIsRefusedWithTheWayOut) {
    PairingDesk desk{counting()};
    for (std::size_t i = 0; i < most_paired; ++i)
        ASSERT_NE(pair_one(desk, "tablet " + std::to_string(i), after(0s)), "");
    const auto refused = desk.offer("one more", after(0s));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::busy);
    EXPECT_NE(refused.error().detail.find("--end"), std::string::npos);
    EXPECT_EQ(desk.end_name("tablet 3"), 1U);
    EXPECT_TRUE(desk.offer("one more", after(0s)));
}

TEST(Pairing, ThirtyDaysWithoutAnOrderEndIt) {
    PairingDesk desk{counting()};
    const std::string idle = pair_one(desk, "idle", after(0s));
    const std::string used = pair_one(desk, "used", after(0s));
    desk.note_order(used, after(24h * 20));
    EXPECT_NE(desk.find(idle, after(24h * 30 - 1ns)), nullptr);
    EXPECT_EQ(desk.find(idle, after(24h * 30)), nullptr);
    EXPECT_NE(desk.find(used, after(24h * 50 - 1ns)), nullptr);
    EXPECT_EQ(desk.find(used, after(24h * 50)), nullptr);
    ASSERT_EQ(desk.paired(after(24h * 30)).size(), 1U);
    EXPECT_EQ(desk.paired(after(24h * 30)).at(0).name, "used");
}

TEST(Pairing, TheFirstOrderOfADayIsWorthAWrite) {
    PairingDesk desk{counting()};
    const std::string token = pair_one(desk, "", after(0s));
    EXPECT_TRUE(desk.note_order(token, after(1s)));
    EXPECT_FALSE(desk.note_order(token, after(2s)));
    EXPECT_TRUE(desk.note_order(token, after(24h)));
    EXPECT_FALSE(desk.note_order("nobody's", after(24h)));
}

TEST(Pairing, EndsByTokenByNameAndAltogether) {
    PairingDesk desk{counting()};
    const std::string one = pair_one(desk, "tablet", after(0s));
    pair_one(desk, "tablet", after(0s));
    const std::string page = pair_one(desk, "", after(0s));
    EXPECT_EQ(desk.end_token(page), 1U);
    EXPECT_EQ(desk.find(page, after(0s)), nullptr);
    EXPECT_EQ(desk.end_name("nobody"), 0U);
    EXPECT_EQ(desk.end_name("tablet"), 2U);
    EXPECT_EQ(desk.find(one, after(0s)), nullptr);
    pair_one(desk, "a", after(0s));
    const auto waiting = desk.offer("b", after(0s));
    EXPECT_EQ(desk.end_all(), 1U);
    EXPECT_FALSE(desk.open(waiting->digits, after(0s))) << "a code that waits goes, too";
}

TEST(Pairing, WhatWasKeptStillHolds) {
    PairingDesk before{counting()};
    const std::string token = pair_one(before, "tablet", after(0s));
    const PairingDesk later{counting(), before.paired(after(0s))};
    ASSERT_NE(later.find(token, after(1h)), nullptr);
}

} // namespace
} // namespace axiscal::pairing_test

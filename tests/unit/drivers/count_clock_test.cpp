#include "drivers/laser/count_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal {
namespace {

using namespace std::chrono_literals;

constexpr MonotonicTime begin{1000s};
constexpr Duration period = 1ms;

/// True instant of record n of a counter whose crystal is fast by `ppm`.
MonotonicTime taken_at(std::int64_t n, std::int64_t ppm = 0) {
    return begin + 1ns * (n * (1'000'000 - ppm));
}

MonotonicTime
place(CountClock& clock, std::int64_t n, MonotonicTime read_at, std::int64_t behind = 0) {
    return clock.place(static_cast<std::uint64_t>(n), read_at, period, behind);
}

TEST(CountClock, PlacesRecordsOfAStalledHostWhereTheyWereTaken) {
    CountClock clock;
    for (std::int64_t n = 0; n < 1000; ++n)
        place(clock, n, taken_at(n));
    // The host looks away for 300 ms and then reads 4 KiB, about 100 records, at a time.
    for (std::int64_t n = 1000; n < 1300; ++n) {
        const MonotonicTime read_at = taken_at(1300) + 50us * (n / 100);
        EXPECT_EQ(place(clock, n, read_at), taken_at(n));
    }
}

TEST(CountClock, SpreadsTheFirstBurstBackwards) {
    CountClock clock;
    for (std::int64_t n = 0; n < 10; ++n)
        EXPECT_EQ(place(clock, n, taken_at(9), 9 - n), taken_at(n));
}

TEST(CountClock, NeverPlacesARecordAfterItsArrival) {
    CountClock clock;
    std::uint64_t random = 1;
    for (std::int64_t n = 0; n < 20000; ++n) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        const MonotonicTime read_at =
            taken_at(n) + Duration{static_cast<std::int64_t>(random >> 38)};
        EXPECT_LE(place(clock, n, read_at), read_at);
    }
}

TEST(CountClock, FollowsACrystalThatRunsSlowOrFast) {
    for (const std::int64_t ppm : {-100, 100}) {
        CountClock clock;
        Duration worst{};
        for (std::int64_t n = 0; n < 60000; ++n) {
            const Duration off = place(clock, n, taken_at(n, ppm)) - taken_at(n, ppm);
            worst = std::max(worst, std::chrono::abs(off));
        }
        EXPECT_LE(worst, 1001us) << ppm; // 100 ppm of 10 s
    }
}

TEST(CountClock, BeginsAnewAfterARestart) {
    CountClock clock;
    for (std::int64_t n = 0; n < 1000; ++n)
        place(clock, n, taken_at(n));
    clock.restart();
    EXPECT_EQ(place(clock, 1, begin + 5s), begin + 5s);
    EXPECT_EQ(place(clock, 2, begin + 5s + 40ms), begin + 5s + 1ms);
}

} // namespace
} // namespace axiscal

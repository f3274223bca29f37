#include "drivers/clock/device_clock.hpp"
#include "tests/support/loaded_host.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace axiscal::device_clock_test {
namespace {

using namespace std::chrono_literals;

constexpr MonotonicTime begin{1000s};
constexpr Duration period = 1ms;
constexpr Duration least_delay = 25us; // the middle of what the class takes for unknown

/// True instant of record n of a counter whose crystal is fast by `ppm`.
MonotonicTime taken_at(std::int64_t n, std::int64_t ppm = 0) {
    return begin + 1ns * (n * (1'000'000 - ppm));
}

MonotonicTime
place(DeviceClock& clock, std::int64_t n, MonotonicTime read_at, std::int64_t behind = 0) {
    return clock.place(static_cast<std::uint64_t>(n), read_at, period, behind).at;
}

TEST(DeviceClock, PlacesRecordsOfAStalledHostWhereTheyWereTaken) {
    DeviceClock clock{0ms};
    for (std::int64_t n = 0; n < 2000; ++n)
        place(clock, n, taken_at(n) + least_delay);
    // The host looks away for 300 ms and then reads 4 KiB, about 100 records, at a time.
    for (std::int64_t n = 2000; n < 2300; ++n) {
        const MonotonicTime read_at = taken_at(2300) + 50us * (n / 100);
        EXPECT_LE(std::chrono::abs(place(clock, n, read_at) - taken_at(n)), 1us);
    }
}

/// A computer so busy that for two seconds it reads nothing in time: 25 ms late and more.
TEST(DeviceClock, AHostThatIsLateForSecondsMovesNoRecord) {
    for (const Duration step : {20us, 1000us}) {
        DeviceClock clock{1ms};
        std::mt19937_64 random{7};
        std::uniform_int_distribution<std::int64_t> jitter_us{0, 400}, more_us{0, 5000};
        const std::int64_t in_frame = 1ms / step;
        Duration worst{};
        for (std::int64_t frame = 0; frame < 8000; ++frame) {
            const bool late = frame >= 3000 && frame < 5000;
            const MonotonicTime ready = begin + 1ms * (frame + 1);
            const MonotonicTime read_at =
                ready + 1us * jitter_us(random) + (late ? 25ms + 1us * more_us(random) : 0ms);
            for (std::int64_t i = 0; i < in_frame; ++i) {
                const std::int64_t n = frame * in_frame + i;
                const auto placed =
                    clock.place(static_cast<std::uint64_t>(n), read_at, step, in_frame - 1 - i);
                worst = std::max<Duration>(worst, std::chrono::abs(placed.at - (begin + step * n)));
            }
        }
        EXPECT_LE(worst, 2ms) << step.count() << " ns";
    }
}

TEST(DeviceClock, SpreadsTheFirstBurstBackwards) {
    DeviceClock clock{0ms};
    for (std::int64_t n = 0; n < 10; ++n)
        EXPECT_EQ(place(clock, n, taken_at(9) + least_delay, 9 - n), taken_at(n));
}

TEST(DeviceClock, NeverPlacesARecordAfterItsArrival) {
    for (const Duration frame : {0ms, 1ms}) {
        DeviceClock clock{frame};
        std::mt19937_64 random{1};
        for (std::int64_t n = 0; n < 20000; ++n) {
            const auto late = Duration{static_cast<std::int64_t>(random() >> 38U)};
            EXPECT_LE(place(clock, n, taken_at(n) + late), taken_at(n) + late);
        }
    }
}

TEST(DeviceClock, FollowsACrystalThatRunsSlowOrFast) {
    for (const std::int64_t ppm : {-100, 100}) {
        DeviceClock clock{0ms};
        Duration worst{};
        for (std::int64_t n = 0; n < 60000; ++n) {
            const auto off = place(clock, n, taken_at(n, ppm) + least_delay) - taken_at(n, ppm);
            if (n > 2000) worst = std::max(worst, std::chrono::abs(off));
        }
        EXPECT_LE(worst, 5us) << ppm; // a bucket of 50 ms at 100 ppm
    }
}

TEST(DeviceClock, BeginsAnewAfterARestart) {
    DeviceClock clock{0ms};
    for (std::int64_t n = 0; n < 1000; ++n)
        place(clock, n, taken_at(n));
    clock.restart();
    EXPECT_EQ(place(clock, 1, begin + 5s), begin + 5s - least_delay);
    EXPECT_EQ(place(clock, 2, begin + 5s + 40ms), begin + 5s + 1ms - least_delay);
}

struct Wire {
    double rate_Hz = 1000, frame_s = 0, seconds = 30, ppm = 50;
    double judged_from_s = 10;
};

struct Found {
    double rms_us = 0;   ///< about a constant, from judged_from_s on
    double worst_us = 0; ///< the same, the largest
    double covered = 0;  ///< share of all records whose truth lies within 2 u(t)
    double largest_u_us = 0, last_u_us = 0;
};

/// Crystal fast by `ppm` that swings by 0.5 ppm in 300 s.
double true_time_s(double device_s, double ppm) {
    const double turn = 2 * std::numbers::pi / 300;
    return device_s * (1 - ppm * 1e-6) + 0.5e-6 / turn * std::sin(turn * device_s);
}

Found follow(const Wire& wire, std::uint64_t seed) {
    const Duration step{std::llround(1e9 / wire.rate_Hz)};
    DeviceClock clock{from_seconds(wire.frame_s)};
    testing::LoadedHost host{seed};
    std::mt19937_64 phases{seed + 77};
    const double phase_s = wire.frame_s * std::uniform_real_distribution<>{}(phases);
    std::vector<double> late_us;
    Found found;
    std::int64_t covered = 0, next = 0;
    const auto count = static_cast<std::int64_t>(wire.seconds * wire.rate_Hz);
    while (next < count) {
        // All that is ready at the same poll is read together.
        const auto ready = [&](std::int64_t n) {
            const double at = true_time_s(static_cast<double>(n) / wire.rate_Hz, wire.ppm);
            return wire.frame_s > 0
                       ? std::ceil((at - phase_s) / wire.frame_s) * wire.frame_s + phase_s
                       : at;
        };
        const double read_s = host.reads(ready(next));
        std::int64_t end = next + 1;
        while (end < count && ready(end) + host.least_s() <= read_s)
            ++end;
        for (std::int64_t n = next; n < end; ++n) {
            const auto placed = clock.place(static_cast<std::uint64_t>(n + 1),
                                            begin + from_seconds(read_s), step, end - 1 - n);
            const double truth_s = true_time_s(static_cast<double>(n) / wire.rate_Hz, wire.ppm);
            const double off_us = (seconds_of(placed.at - begin) - truth_s) * 1e6;
            found.last_u_us = seconds_of(placed.uncertainty) * 1e6;
            if (std::abs(off_us) <= 2 * found.last_u_us) ++covered;
            if (truth_s < wire.judged_from_s) continue;
            late_us.push_back(off_us);
            found.largest_u_us = std::max(found.largest_u_us, found.last_u_us);
        }
        next = end;
    }
    found.covered = static_cast<double>(covered) / static_cast<double>(count);
    double mean = 0, squares = 0;
    for (const double off : late_us)
        mean += off / static_cast<double>(late_us.size());
    for (const double off : late_us) {
        squares += (off - mean) * (off - mean);
        found.worst_us = std::max(found.worst_us, std::abs(off - mean));
    }
    found.rms_us = std::sqrt(squares / static_cast<double>(late_us.size()));
    return found;
}

TEST(DeviceClock, PlacesASerialLineOfALoadedHostWithinTenMicroseconds) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Found found = follow({.rate_Hz = 1000}, seed);
        EXPECT_LT(found.rms_us, 10) << seed;
        EXPECT_LT(found.worst_us, 20) << seed;
        EXPECT_GE(found.covered, 0.95) << seed;
        EXPECT_LT(found.largest_u_us, 30) << seed;
    }
}

TEST(DeviceClock, PlacesAFastStreamOverFramesWithinTenMicroseconds) {
    for (const double rate_Hz : {10e3, 50e3})
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const Found found = follow({.rate_Hz = rate_Hz, .frame_s = 1e-3, .seconds = 20}, seed);
            EXPECT_LT(found.rms_us, 10) << rate_Hz << ' ' << seed;
            EXPECT_LT(found.worst_us, 20) << rate_Hz << ' ' << seed;
            EXPECT_GE(found.covered, 0.95) << rate_Hz << ' ' << seed;
        }
}

/// 50 ppm against frames of 1 ms: a beat of 20 s, the third floor at the latest after 60 s.
TEST(DeviceClock, FindsTheFloorOfFramesAfterTwoBeats) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Found found = follow({.frame_s = 1e-3, .seconds = 180, .judged_from_s = 65}, seed);
        EXPECT_LT(found.rms_us, 15) << seed;
        EXPECT_LT(found.largest_u_us, 150) << seed;
        EXPECT_GE(found.covered, 0.95) << seed;
    }
}

/// 1 ppm: a beat of 1000 s, which no window sees.
TEST(DeviceClock, ClaimsNoMoreThanAFrameWhereTheBeatIsLong) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Found found = follow({.frame_s = 1e-3, .seconds = 120, .ppm = 1}, seed);
        EXPECT_NEAR(found.last_u_us, 1000 / std::sqrt(12.0), 25) << seed;
        EXPECT_GE(found.covered, 0.95) << seed;
    }
}

TEST(LowerHull, IsTheLineOfLeastSumBelowAllPoints) {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<> noise{0, 1e-3};
    for (int trial = 0; trial < 200; ++trial) {
        std::deque<ClockPoint> points;
        for (int i = 0; i < 30; ++i)
            points.push_back({i * 0.05, noise(random)});
        const auto sum_under = [&](const ClockLine& line) {
            double sum = 0;
            for (const auto& p : points)
                sum += p.delay_s - line.at(p.device_s);
            return sum;
        };
        const ClockLine found = line_below(points, 1);
        for (const auto& p : points)
            EXPECT_GE(p.delay_s - found.at(p.device_s), -1e-15);
        // Every line through two points that lies below all of them is no nearer.
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = i + 1; j < points.size(); ++j) {
                const double slope = (points[j].delay_s - points[i].delay_s) /
                                     (points[j].device_s - points[i].device_s);
                const ClockLine other{points[i].delay_s - slope * points[i].device_s, slope};
                const bool below = std::ranges::all_of(points, [&](const ClockPoint& p) {
                    return p.delay_s >= other.at(p.device_s) - 1e-15;
                });
                EXPECT_TRUE(!below || sum_under(found) <= sum_under(other) + 1e-12);
            }
    }
}

} // namespace
} // namespace axiscal::device_clock_test

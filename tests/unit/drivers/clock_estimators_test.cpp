// Two robust lines through the arrivals of a steady clock, in what a host makes of it: the lower
// hull, which DeviceClock takes, and Huber's estimator, which stands here for comparison only. Why
// the hull alone is in the product: docs/performance.md.
#include "drivers/clock/device_clock.hpp"
#include "tests/support/loaded_host.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace axiscal::clock_estimators_test {
namespace {

using namespace std::chrono_literals;

using Cloud = std::deque<ClockPoint>;
/// How late the record of this instant is read; s.
using Delay = std::function<double(double taken_s)>;

struct Weighted {
    double weight = 0, time = 0, delay = 0, time_time = 0, time_delay = 0;
    void add(const ClockPoint& point, double w) {
        weight += w;
        time += w * point.device_s;
        delay += w * point.delay_s;
        time_time += w * point.device_s * point.device_s;
        time_delay += w * point.device_s * point.delay_s;
    }
    [[nodiscard]] ClockLine line() const {
        const double slope =
            (weight * time_delay - time * delay) / (weight * time_time - time * time);
        return {(delay - slope * time) / weight, slope};
    }
};

/// Normal scatter has this median of absolute deviations from its median.
constexpr double normal_mad = 0.6745;

double scale_about(const ClockLine& line, const Cloud& points) {
    std::vector<double> off;
    off.reserve(points.size());
    for (const ClockPoint& point : points)
        off.push_back(std::abs(point.delay_s - line.at(point.device_s)));
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::ranges::nth_element(off, middle);
    return std::max(*middle / normal_mad, 1e-12);
}

/// Huber (1964) with k = 1.345, by least squares with weights that are set anew each time.
ClockLine huber_line(const Cloud& points) {
    constexpr double k = 1.345;
    Weighted begin;
    for (const ClockPoint& point : points)
        begin.add(point, 1);
    ClockLine line = begin.line();
    for (int i = 0; i < 50; ++i) {
        const double limit_s = k * scale_about(line, points);
        Weighted next;
        for (const ClockPoint& point : points) {
            const double off_s = std::abs(point.delay_s - line.at(point.device_s));
            next.add(point, off_s <= limit_s ? 1 : limit_s / off_s);
        }
        line = next.line();
    }
    return line;
}

ClockLine hull_line(const Cloud& points) {
    return line_below(points, 200e-6);
}

struct Window {
    double seconds = 10, rate_Hz = 1000;
};

/// The least delay of each 50 ms, as DeviceClock keeps them. The clock itself is the line of 0.
Cloud least_delays(const Window& window, const Delay& delay_s) {
    Cloud cloud;
    double bucket = -1;
    for (int n = 0; n < static_cast<int>(window.seconds * window.rate_Hz); ++n) {
        const ClockPoint point{n / window.rate_Hz, delay_s(n / window.rate_Hz)};
        const double in = std::floor(point.device_s / 0.05);
        if (std::exchange(bucket, in) != in)
            cloud.push_back(point);
        else if (point.delay_s < cloud.back().delay_s)
            cloud.back() = point;
    }
    return cloud;
}

/// Of a line at the end of its window, where it is used, over many hosts; us. The mean is what no
/// fit can find (the least delay), the scatter about it what the estimator adds.
struct Found {
    double mean = 0, scatter = 0;
};

Found over_hosts(const std::function<ClockLine(const Cloud&)>& estimator,
                 const Window& window,
                 const std::function<Delay(std::uint64_t seed)>& host) {
    constexpr int hosts = 60;
    double sum = 0, squares = 0;
    for (int seed = 1; seed <= hosts; ++seed) {
        const Cloud cloud = least_delays(window, host(static_cast<std::uint64_t>(seed)));
        const double off_us = estimator(cloud).at(window.seconds) * 1e6;
        sum += off_us / hosts;
        squares += off_us * off_us / hosts;
    }
    return {sum, std::sqrt(std::max(squares - sum * sum, 0.0))};
}

/// A host that does nothing else: jitter with two sides, above a least delay far below it.
Delay idle_host(std::uint64_t seed) {
    return [random = std::mt19937_64{seed}](double) mutable {
        return std::max(0.0, std::normal_distribution<>{31e-6, 5e-6}(random));
    };
}

/// Its own least delay taken away: what is left begins at 0.
Delay loaded_host(std::uint64_t seed) {
    return [host = testing::LoadedHost{seed}](double taken_s) mutable {
        return host.reads(taken_s) - host.least_s() - taken_s;
    };
}

/// 1 kHz, fast by 50 ppm against frames of 1 ms: a beat of 20 s that begins anywhere.
Delay host_with_frames(std::uint64_t seed) {
    constexpr double frame_s = 1e-3, fast = 50e-6;
    std::mt19937_64 random{seed + 77};
    const double phase_s = frame_s * std::uniform_real_distribution<>{}(random);
    return [phase_s, host = testing::LoadedHost{seed}](double device_s) mutable {
        const double taken_s = device_s * (1 - fast);
        const double polled_s = std::ceil((taken_s - phase_s) / frame_s) * frame_s + phase_s;
        return host.reads(polled_s) - host.least_s() - taken_s;
    };
}

/// Jitter with two sides has no floor that the hull could find: Huber's line is nearer, and both
/// are nearer than what a line must be.
TEST(ClockEstimators, HuberIsNearerOnAnIdleHostWithJitterOfTwoSides) {
    const Found hull = over_hosts(hull_line, {}, idle_host);
    const Found huber = over_hosts(huber_line, {}, idle_host);
    RecordProperty("hull_us", std::to_string(hull.scatter));
    RecordProperty("huber_us", std::to_string(huber.scatter));
    EXPECT_LT(huber.scatter, 1);
    EXPECT_LT(huber.scatter, hull.scatter);
    EXPECT_LT(hull.scatter, 10);
}

TEST(ClockEstimators, TheHullIsNearerOnALoadedHost) {
    for (const double rate_Hz : {100.0, 1000.0}) {
        const Window window{.rate_Hz = rate_Hz};
        const Found hull = over_hosts(hull_line, window, loaded_host);
        const Found huber = over_hosts(huber_line, window, loaded_host);
        EXPECT_LT(hull.scatter, huber.scatter) << rate_Hz;
        EXPECT_LT(hull.scatter, 1) << rate_Hz;
    }
}

/// Between a quiet moment and a busy one the same record must not move.
TEST(ClockEstimators, TheHullMovesLessBetweenAnIdleHostAndALoadedOne) {
    const auto shift = [](const auto& estimator) {
        return std::abs(over_hosts(estimator, {}, idle_host).mean -
                        over_hosts(estimator, {}, loaded_host).mean);
    };
    EXPECT_LT(shift(hull_line), shift(huber_line));
}

/// Over three beats of the frames: a saw-tooth has a floor, but the line through its middle leans
/// with its phase, at the end by 6 / (2 pi 3) / pi of a frame for its first harmonic: 100 us.
TEST(ClockEstimators, TheHullAloneSeesThroughTheBeatOfFrames) {
    const Window window{.seconds = 60};
    const Found hull = over_hosts(hull_line, window, host_with_frames);
    const Found huber = over_hosts(huber_line, window, host_with_frames);
    RecordProperty("hull_us", std::to_string(hull.scatter));
    RecordProperty("huber_us", std::to_string(huber.scatter));
    EXPECT_LT(hull.scatter, 15);
    EXPECT_GT(huber.scatter, 30);
}

/// Where Huber's line would be nearer, the product's u(t) holds the truth all the same.
TEST(ClockEstimators, OnAnIdleHostTheStatedUncertaintyHoldsTheTruth) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        DeviceClock clock{0ms};
        const Delay delay_s = idle_host(seed);
        int covered = 0;
        constexpr int records = 30'000;
        for (int n = 0; n < records; ++n) {
            const MonotonicTime taken{1000s + 1ms * n};
            const auto placed = clock.place(static_cast<std::uint64_t>(n + 1),
                                            taken + from_seconds(delay_s(n * 1e-3)), 1ms);
            if (std::chrono::abs(placed.at - taken) <= 2 * placed.uncertainty) ++covered;
        }
        EXPECT_GE(covered, records * 95 / 100) << seed;
    }
}

} // namespace
} // namespace axiscal::clock_estimators_test

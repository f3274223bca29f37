// What the loop does at 50 kHz on eight channels. CPU time is read, not the clock: what else the
// computer does is none of it. It is told in usual milliseconds (fifty callbacks of a sample on
// each channel), so that a slower computer answers alike.
#include "station_bench.hpp"

#include <ctime>

namespace axiscal::station_rate_test {
namespace {

using namespace testing;

double cpu_ms() {
    timespec spent{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
    return static_cast<double>(spent.tv_sec) * 1e3 + static_cast<double>(spent.tv_nsec) * 1e-6;
}

template <class Work> double cost_ms(Work work) {
    const double before = cpu_ms();
    work();
    return cpu_ms() - before;
}

/// Of thousands: now and then the kernel works on the thread's account.
double tenth_longest(std::vector<double> costs) {
    std::ranges::nth_element(costs, costs.begin() + 9, std::greater{});
    return costs[9];
}

double median(std::vector<double> costs) {
    const auto middle = costs.begin() + std::ssize(costs) / 2;
    std::ranges::nth_element(costs, middle);
    return *middle;
}

struct FastShop : Shop {
    FastShop() {
        laser_period = 20us;
        further_axes = 7;
        config.capture.window = 1s;
        config.capture.timeout = 30s;
        shorten();
    }
};

TEST(StationAt50Kilohertz, IsNeverHeldWhileItWaitsForTheAxisToStand) {
    FastShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    const PlannedPoint point = shop.plan().points.front();
    life.drive_to(point);
    const MonotonicTime since = life.scheduler.now();
    bool creeps = true; // 20 um/s: never still
    shop.drift_um = [&](MonotonicTime at) { return creeps ? 20 * seconds_of(at - since) : 0.0; };
    life.ask(Life::request_for(point, 1));
    std::vector<double> costs, views;
    for (int i = 0; i < 9000; ++i) { // of a millisecond: fifty callbacks and a look at times
        costs.push_back(cost_ms([&] { life.run(1ms); }));
        if (i % 100 == 0) views.push_back(cost_ms([&] { (void)life.status(); }));
    }
    EXPECT_EQ(life.port->done, 0);
    // 3.3 and 0.6 as measured; a search through the whole window of a second costs 30.
    EXPECT_LT(tenth_longest(costs), 12 * median(costs));
    EXPECT_LT(tenth_longest(views), 12 * median(costs));
    creeps = false;
    life.run(1500ms);
    EXPECT_EQ(life.port->done, 1) << "and the point is taken once the axis stands";
}

/// From the request to `done`: the longest millisecond against a usual one.
double longest_while_taken(Life& life, const PlannedPoint& point, std::uint16_t number) {
    life.drive_to(point);
    life.ask(Life::request_for(point, number));
    std::vector<double> costs;
    for (int i = 0; i < 30'000 && life.port->done != number; ++i)
        costs.push_back(cost_ms([&] { life.run(1ms); }));
    EXPECT_EQ(life.port->done, number);
    return *std::ranges::max_element(costs) / median(costs);
}

// The window of a second is fifty thousand samples: copied, weighed and handed on when it is found.
TEST(StationAt50Kilohertz, IsNotHeldWhenItTakesAPoint) {
    FastShop shop;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    std::vector<double> longest;
    for (std::uint16_t number = 1; number <= 6; ++number)
        longest.push_back(longest_while_taken(life, shop.plan().points[number - 1U], number));
    // 45 as measured (1.6 ms), a thousandth of what the fifty thousand samples cost on their way in.
    // What taking costs is in each of the six; what the kernel does on this thread's account is not.
    EXPECT_LT(*std::ranges::min_element(longest), 100);
}

} // namespace
} // namespace axiscal::station_rate_test

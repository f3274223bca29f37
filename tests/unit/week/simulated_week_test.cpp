// A week of runs round the clock, with cables out, drift, a clock that is set, a share that is
// lost, seven midnights and the end of summer time.
//
//   AXISCAL_ALL=1    four more weeks of other seeds, one with the laser at 200 Hz day and night
//   AXISCAL_SEED=N   the week of that seed instead (tools/soak)
#include "tests/support/asked_seed.hpp"
#include "tests/unit/week/week.hpp"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <ctime>
#include <iostream>

namespace axiscal::testing::simulated_week_test {
namespace {

constexpr int hours_of_a_week = 168;

/// Summer time ends in this week, for everything that asks for local time.
// NOLINTBEGIN(concurrency-mt-unsafe): there is one thread
class Berlin {
public:
    Berlin() { live_in("Europe/Berlin"); }
    ~Berlin() { live_in("UTC"); }
    Berlin(const Berlin&) = delete;
    Berlin& operator=(const Berlin&) = delete;

private:
    static void live_in(const char* zone) {
        ::setenv("TZ", zone, 1);
        ::tzset();
    }
};

bool all_of_it() {
    return std::getenv("AXISCAL_ALL") != nullptr;
}
// NOLINTEND(concurrency-mt-unsafe)

std::string summary_of(const Tally& tally) {
    std::string words = std::to_string(tally.complete) + " of " + std::to_string(tally.armed) +
                        " runs complete, " + std::to_string(tally.requests) + " requests, " +
                        std::to_string(tally.acknowledged) + " done, " +
                        std::to_string(tally.refused) + " refused (";
    for (const auto& [fault, count] : tally.faults)
        words += fault + " " + std::to_string(count) + " ";
    words += "), " + std::to_string(tally.unplugged) + " cables out, " +
             std::to_string(tally.steps) + " clock steps (" +
             std::to_string(tally.steps_while_waiting) + " while results waited, " +
             std::to_string(tally.left_standing) + " left until a run was closed), " +
             std::to_string(tally.losses) + " shares lost, " + std::to_string(tally.published) +
             " published; bytes at midnight";
    for (const auto bytes : tally.bytes_at_midnight)
        words += " " + std::to_string(bytes);
    return words;
}

void expect_a_good_week(const Tally& tally) {
    EXPECT_EQ(tally.armed, hours_of_a_week);
    EXPECT_EQ(tally.complete, tally.armed);
    EXPECT_EQ(tally.published, tally.complete) << "each certificate reaches the share, once";
    EXPECT_EQ(tally.acknowledged, 10 * tally.armed);
    EXPECT_EQ(tally.requests, tally.acknowledged + tally.refused);
    EXPECT_EQ(tally.unanswered, 0);
    EXPECT_EQ(tally.refused_for_nothing, 0);
    EXPECT_EQ(tally.left_open, 0);
    EXPECT_EQ(tally.unseen, 0);
    EXPECT_EQ(tally.late_back, 0);
    EXPECT_EQ(tally.disturbed, 0);
    EXPECT_EQ(tally.wrong_points, 0);
    EXPECT_EQ(tally.wrong_dates, 0);
    EXPECT_EQ(tally.wrong_times, 0);
    EXPECT_EQ(tally.untold_waits, 0);
    EXPECT_EQ(tally.false_alarms, 0);
    EXPECT_EQ(tally.too_many_notes, 0);
    // That something happened at all.
    EXPECT_GT(tally.unplugged, 20);
    EXPECT_GT(tally.steps, 10);
    EXPECT_GT(tally.left_standing, 0);
    EXPECT_GT(tally.losses, 5);
    EXPECT_GT(tally.alarms, 0);
    EXPECT_GT(tally.steps_while_waiting, 0);
    EXPECT_GT(tally.refused, 0);
}

/// Sanitizers bring an allocator of their own, of which mallinfo2 knows nothing: they tell leaks.
constexpr bool heap_is_counted() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return false;
#elif defined(__clang__)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    return false;
#else
    return true;
#endif
#else
    return true;
#endif
}

/// The first day fills the histories; from then on the heap must not grow.
void expect_flat(const std::vector<std::size_t>& bytes) {
    constexpr std::size_t allowed = 64 << 10; // a leak of 400 bytes an hour
    ASSERT_EQ(bytes.size(), 7U) << "a midnight each";
    if (!heap_is_counted()) return;
    for (const std::size_t in_use : bytes)
        EXPECT_GT(in_use, 0U) << "mallinfo2 tells nothing: flatness would prove nothing";
    for (std::size_t day = 2; day < bytes.size(); ++day)
        EXPECT_LT(bytes[day], bytes[1] + allowed) << "on day " << day;
}

void live_a_week(std::uint64_t seed, Duration laser_idle_period) {
    const Berlin berlin;
    spdlog::set_level(spdlog::level::warn); // a week of notes is 10 MB
    Week week{seed, laser_idle_period};
    for (int hour = 0; hour < hours_of_a_week; ++hour)
        week.hour();
    week.settle();
    std::cout << "week " << seed << ": " << summary_of(week.tally()) << "\n";
    expect_a_good_week(week.tally());
    expect_flat(week.tally().bytes_at_midnight);
}

TEST(SimulatedWeek, EveryRunIsFinishedAndEveryTroubleIsTold) {
    const auto seed = asked_seed();
    live_a_week(seed.value_or(1), 100ms);
    if (seed || !all_of_it()) return;
    for (std::uint64_t other = 2; other < 5; ++other)
        live_a_week(other, 100ms);
    live_a_week(5, 5ms);
}

} // namespace
} // namespace axiscal::testing::simulated_week_test

#include "drivers/trigger/dwell_detector.hpp"
#include "drivers/trigger/trigger_ports.hpp"
#include "tests/support/port_bench.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace axiscal::cnc_dwell_test {
namespace {

using namespace std::chrono_literals;
using State = DwellDetector::State;

constexpr MonotonicTime begin = monotonic_from_ns(1'000'000'000);

/// An axis read 100 times a second; window 0.5 mm, 1 um over 0.5 s, 1 s halt, 0.1 mm hysteresis.
class Dwell : public ::testing::Test {
protected:
    /// Reads `position_mm(t in s)` for a while; @returns the number of requests.
    template <class Position> int read(Duration span, Position position_mm) {
        int requests = 0;
        const MonotonicTime from = now;
        for (; now < from + span; now += 10ms) {
            if (!detector.position(now, position_mm(seconds_of(now - from)))) continue;
            ++requests;
            requested_at = now;
        }
        return requests;
    }
    int stand(Duration span, double position_mm) {
        return read(span, [position_mm](double) { return position_mm; });
    }

    DwellDetector detector{DwellLimits{}};
    MonotonicTime now = begin, requested_at;
};

TEST_F(Dwell, AsksOnceAfterTheMinimumHalt) {
    detector.aim(100.0);
    EXPECT_EQ(stand(10s, 100.2), 1);
    EXPECT_EQ(requested_at, begin + 1s);
    EXPECT_EQ(detector.state(), State::requested);
}

TEST_F(Dwell, IgnoresAnAxisThatStandsElsewhere) {
    detector.aim(100.0);
    EXPECT_EQ(stand(10s, 100.51), 0);
    EXPECT_EQ(detector.state(), State::armed);
}

TEST_F(Dwell, WithoutATargetDoesNothing) {
    EXPECT_EQ(stand(10s, 0.0), 0);
    detector.aim(0.0);
    detector.aim(std::nullopt);
    EXPECT_EQ(stand(10s, 0.0), 0);
    EXPECT_EQ(detector.state(), State::off);
}

TEST_F(Dwell, WaitsUntilTheAxisHasComeToRest) {
    detector.aim(0.0);
    // settles with 20 um amplitude and a time constant of 1 s: within 1 um p-p over 0.5 s only
    // after t = ln(20 um * (1 - e^-0.5) / 1 um) + 0.5 s = 2.56 s
    EXPECT_EQ(read(10s, [](double t) { return 0.020 * std::exp(-t); }), 1);
    EXPECT_NEAR(seconds_of(requested_at - begin), 2.56, 0.03);
}

TEST_F(Dwell, NeverAsksWhileTheAxisDrifts) {
    detector.aim(0.0);
    EXPECT_EQ(read(10s, [](double t) { return 0.003 * t; }), 0); // 1.5 um in each 0.5 s
}

TEST_F(Dwell, NeverAsksWhileTheAxisPassesThrough) {
    detector.aim(0.0);
    EXPECT_EQ(read(10s, [](double t) { return -5 + t; }), 0);
}

TEST_F(Dwell, DemandsThatTheAxisLeavesBetweenTwoVisits) {
    detector.aim(0.0);
    EXPECT_EQ(stand(2s, 0.0), 1);
    detector.finished();
    detector.aim(0.0); // the reversal comes back to the same target
    EXPECT_EQ(stand(5s, 0.0), 0);
    EXPECT_EQ(stand(1s, 0.59), 0); // outside the window, within the hysteresis
    EXPECT_EQ(stand(5s, 0.0), 0);
    EXPECT_EQ(stand(1s, 0.61), 0);
    EXPECT_EQ(stand(2s, 0.0), 1);
}

TEST_F(Dwell, TakesTheNextTargetOnlyAfterLeaving) {
    detector.aim(0.0);
    EXPECT_EQ(stand(2s, 0.0), 1);
    detector.finished();
    detector.aim(50.0);
    EXPECT_EQ(detector.state(), State::leave);
    EXPECT_EQ(stand(1s, 25.0), 0);
    EXPECT_EQ(detector.state(), State::armed);
    EXPECT_EQ(stand(2s, 50.0), 1);
}

TEST_F(Dwell, RemembersThatTheAxisLeftBeforeThePointWasStored) {
    detector.aim(0.0);
    EXPECT_EQ(stand(2s, 0.0), 1);
    EXPECT_EQ(stand(1s, 25.0), 0);
    detector.finished();
    detector.aim(25.0);
    EXPECT_EQ(stand(2s, 25.0), 1);
}

TEST_F(Dwell, TriesAgainOnlyWhereWaitingHelps) {
    detector.aim(0.0);
    EXPECT_EQ(stand(1500ms, 0.0), 1);
    detector.failed(true);
    EXPECT_EQ(stand(1500ms, 0.0), 1);
    detector.failed(false);
    EXPECT_EQ(stand(5s, 0.0), 0);
    EXPECT_EQ(stand(1s, 2.0), 0);
    EXPECT_EQ(stand(2s, 0.0), 1);
}

TEST_F(Dwell, BeginsAnewAfterAHoleInTheReadings) {
    detector.aim(0.0);
    EXPECT_EQ(stand(900ms, 0.0), 0);
    now += 200ms; // more than a quarter of the period: anything may have happened
    const MonotonicTime again = now;
    EXPECT_EQ(stand(3s, 0.0), 1);
    EXPECT_EQ(requested_at, again + 1s);
}

TEST_F(Dwell, CountsNoAbsentReading) {
    detector.aim(0.0);
    EXPECT_EQ(stand(5s, std::numeric_limits<double>::quiet_NaN()), 0);
}

// The law of a cycle: each halt at its target gives one request, whatever the halts' lengths.
TEST_F(Dwell, CountsEachVisitOfABidirectionalCycleOnce) {
    std::mt19937 random{230};
    int requests = 0;
    for (int visit = 0; visit < 100; ++visit) {
        const int leg = visit % 20;
        const double target = 10.0 * (leg < 10 ? leg : 19 - leg);
        detector.aim(target);
        const int here = stand(1100ms + std::chrono::milliseconds{random() % 3000}, target + 0.01);
        EXPECT_EQ(here, 1) << visit;
        requests += here;
        detector.finished();
        EXPECT_EQ(stand(200ms, target + (leg < 10 ? 2.0 : -2.0)), 0);
    }
    EXPECT_EQ(requests, 100);
}

/// The first request of an axis that stays in the window, every reading looked at each time.
std::optional<std::size_t> plain_halt(const std::vector<std::pair<MonotonicTime, double>>& read,
                                      const DwellLimits& limits) {
    std::size_t entered = 0;
    for (std::size_t i = 1; i < read.size(); ++i) {
        const MonotonicTime now = read[i].first;
        if (now - read[i - 1].first > limits.stability_period / 4) entered = i;
        std::size_t first = i; // the last one at or before the begin of the period
        while (first > entered && read[first].first > now - limits.stability_period)
            --first;
        double low = read[i].second, high = low;
        for (std::size_t k = first; k < i; ++k) {
            low = std::min(low, read[k].second);
            high = std::max(high, read[k].second);
        }
        const bool whole = read[first].first <= now - limits.stability_period;
        const bool halted = now - read[entered].first >= limits.minimum_halt;
        if (halted && whole && high - low <= limits.stability_range_mm) return i;
    }
    return std::nullopt;
}

TEST(DwellDetector, LawAsksWhenALookAtEveryReadingWould) {
    const DwellLimits limits{0.5, 1e-3, 100ms, 200ms, 0.1};
    int asked = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        std::mt19937 random{seed};
        std::vector<std::pair<MonotonicTime, double>> read;
        MonotonicTime at = begin;
        double place_mm = 0;
        for (int i = 0; i < 2000; ++i) {
            at += std::chrono::microseconds{random() % 800};
            if (random() % 700 == 0) at += 30ms;
            if (random() % 300 == 0) place_mm = 1e-3 * static_cast<double>(random() % 100);
            read.emplace_back(at, place_mm + 1e-5 * static_cast<double>(random() % 101));
        }
        DwellDetector detector{limits};
        detector.aim(0.0);
        std::optional<std::size_t> request;
        for (std::size_t i = 0; i < read.size() && !request; ++i)
            if (detector.position(read[i].first, read[i].second)) request = i;
        ASSERT_EQ(request, plain_halt(read, limits)) << "seed " << seed;
        asked += request ? 1 : 0;
    }
    EXPECT_GT(asked, 20);
    EXPECT_LT(asked, 200);
}

TEST(DwellTriggerPort, ReportsAHaltAsARequestOfTheNextNumber) {
    TriggerConfig config;
    config.shape = TriggerShape::dwell;
    config.transport = TriggerTransport::none;
    config.hysteresis = mm(0.1);
    const auto port = make_trigger_port(config);
    testing::VirtualScheduler scheduler;
    testing::RunningPort running{*port, scheduler};
    scheduler.run_for(0ns);
    PortStatus status;
    status.next_target = 3;
    status.next_nominal_mm = -25.4;
    port->publish_armed();
    const auto stand = [&](double position_mm) {
        for (int reading = 0; reading < 150; ++reading) {
            scheduler.run_for(10ms);
            port->publish(status); // as often as the station likes
            port->position(scheduler.now(), position_mm);
        }
    };
    stand(-25.3);
    ASSERT_EQ(running.sink.events.size(), 1U);
    const auto& event = running.sink.events[0];
    EXPECT_EQ(event.origin, TriggerOrigin::dwell);
    EXPECT_EQ(event.command, TriggerCommand::capture);
    EXPECT_EQ(event.sequence, 1);
    EXPECT_EQ(event.target_index, 3);
    EXPECT_EQ(event.nominal_counts, -254000);
    port->refuse(1, Fault::not_still);
    stand(-25.3);
    ASSERT_EQ(running.sink.events.size(), 2U);
    EXPECT_EQ(running.sink.events[1].sequence, 1) << "the number was not used up";
    port->refuse(1, Fault::wrong_direction);
    stand(-25.3);
    EXPECT_EQ(running.sink.events.size(), 2U) << "standing on does not heal this";
    running.cancel();
    scheduler.run_for(0ns);
    EXPECT_TRUE(running.result.has_value());
    EXPECT_FALSE(running.threw);
}

} // namespace
} // namespace axiscal::cnc_dwell_test

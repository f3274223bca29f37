// The clock of the station's computer is set in mid-run and left so, through events, retakes and
// the closing: what is printed goes on by the clock of the opening.
#include "tests/unit/station/station_bench.hpp"

#include "analysis/positioning/positioning_certificate.hpp"
#include "analysis/record/run_clock.hpp"

namespace axiscal::testing::station_clock_test {
namespace {

class ClockOfAStation : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static RevisionRequest of_target(int target) {
        RevisionRequest request;
        request.selection.target = target;
        request.reason = "coolant";
        return request;
    }
    [[nodiscard]] RunFileContents contents() const {
        return read_run_file_contents(shop.run_files().at(0)).value();
    }
    static Certificate printed(const RunFileContents& file) {
        return make_certificate(file.run, file.revisions, "").value();
    }
    void run_with_a_retake(Life& life, Duration set_by) {
        ASSERT_TRUE(life.arm());
        for (int step = 0; step < 10; ++step) {
            if (step == 4) life.scheduler.utc_at_zero_ns += set_by.count();
            ASSERT_TRUE(life.take(step)) << step;
        }
        life.run(2s);
        ASSERT_TRUE(life.retake(of_target(2)));
        ASSERT_TRUE(life.take(2, 11));
        ASSERT_TRUE(life.take(7, 12));
        life.run(2s);
    }
    Shop shop;
};

class StationClock : public ClockOfAStation, public ::testing::WithParamInterface<Duration> {};
using StationClockBetweenRuns = ClockOfAStation;

TEST_P(StationClock, SetInMidRunMovesNothingOnPaperAndTheFileKeepsWhatItSaid) {
    Life life{shop};
    const std::int64_t right = life.scheduler.utc_at_zero_ns;
    run_with_a_retake(life, GetParam());
    const RunFileContents file = contents();
    const auto by_right_clock = [&](MonotonicTime at) {
        return iso8601_utc(right + nanoseconds_of(at));
    };
    EXPECT_EQ(file.run.closed.utc_ns,
              right + GetParam().count() + nanoseconds_of(file.run.closed.before));
    const Certificate paper = printed(file);
    EXPECT_EQ(paper.started_utc, by_right_clock(file.run.opened.before));
    EXPECT_EQ(paper.finished_utc, by_right_clock(file.run.closed.before));
    EXPECT_LE(paper.started_utc, paper.finished_utc);
    EXPECT_EQ(paper.issued_on, paper.finished_utc.substr(0, 10));
    ASSERT_EQ(paper.revisions.retakes.size(), 1U);
    EXPECT_EQ(iso8601_utc(paper.revisions.retakes[0].utc_ns),
              by_right_clock(file.revisions.retakes[0].at));
    EXPECT_FALSE(paper.run.events.empty());
    for (const EventRecord& event : paper.run.events)
        EXPECT_EQ(iso8601_utc(event.utc_ns), by_right_clock(event.at)) << event.text;
}

INSTANTIATE_TEST_SUITE_P(ByHours, StationClock, ::testing::Values(-1h, 1h, -9000h));

/// The run of before the step bears the later date in its name and in its file.
TEST_F(StationClockBetweenRuns, SetBackTheLaterRunIsTheNewestAfterARestart) {
    const auto hour_ns = std::chrono::nanoseconds{1h}.count();
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        for (int step = 0; step < 10; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        life.run(2s);
        life.scheduler.utc_at_zero_ns -= hour_ns;
        run_with_a_retake(life, 0s); // its last request is 12
    }
    shop.utc_at_zero_ns -= hour_ns;
    shop.now += 60s;
    Life life{shop};
    EXPECT_EQ(life.port->done_before_open, 12);
    life.run(2s);
    ASSERT_TRUE(life.retake(of_target(1)));
    ASSERT_EQ(shop.run_files().size(), 2U);
    const auto earlier = read_run_file_contents(shop.run_files().at(1)).value();
    const auto later = read_run_file_contents(shop.run_files().at(0)).value();
    ASSERT_GT(earlier.run.opened.utc_ns, later.run.opened.utc_ns);
    EXPECT_TRUE(earlier.closed && earlier.revisions.retakes.empty());
    EXPECT_TRUE(!later.closed && later.revisions.retakes.size() == 2);
}

class StationClockOfAnotherBoot : public StationClock {
protected:
    void leave_out_a_reading_in_another_boot(const BootId& first_boot, const BootId& later_boot);
};

/// The uptime is longer than the first boot's ever was: no number shows that it is another.
TEST_P(StationClockOfAnotherBoot, TellsTheClosingOfThatBootByItsOwnClock) {
    leave_out_a_reading_in_another_boot({"boot-1"}, {"boot-2"});
}

/// Empty equalled empty, and the dates of the paper went by the clock of a boot that was over.
TEST_P(StationClockOfAnotherBoot, DoesSoWhereNobodyKnowsTheBoots) {
    leave_out_a_reading_in_another_boot({}, {});
}

void StationClockOfAnotherBoot::leave_out_a_reading_in_another_boot(const BootId& first_boot,
                                                                    const BootId& later_boot) {
    shop.boot_id = first_boot;
    shop.config.cycle.approaches = 3;
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        for (int step = 0; step < 30; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        life.run(2s);
    }
    const Certificate first = printed(contents());
    shop.boot_id = later_boot;
    shop.now += GetParam();
    shop.utc_at_zero_ns += std::chrono::nanoseconds{30 * 24h}.count();
    const std::int64_t of_this_boot = shop.utc_at_zero_ns;
    Life life{shop};
    RevisionRequest request = of_target(1);
    request.selection.direction = Direction::positive;
    request.selection.approach = 0;
    ASSERT_TRUE(life.exclude(request));
    const RunFileContents file = contents();
    ASSERT_TRUE(file.closed);
    const Certificate paper = printed(file);
    EXPECT_EQ(paper.started_utc, first.started_utc);
    EXPECT_EQ(paper.finished_utc,
              iso8601_utc(of_this_boot + nanoseconds_of(file.run.closed.before)));
    EXPECT_EQ(nanoseconds_of(tie_of_points(file.run.opened, file.run.events).before),
              nanoseconds_of(file.run.opened.before))
        << "the points were measured in the first boot";
}

/// It was taken for a clock that was set: what came afterwards was told too early by the whole
/// sleep.
TEST_F(ClockOfAStation, CountsTheTimeOfASuspendAndTheRunSaysSo) {
    Life life{shop};
    const std::int64_t right = life.scheduler.utc_at_zero_ns;
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 10; ++step) {
        ASSERT_TRUE(life.take(step)) << step;
        if (step == 9) break;
        if (step == 4) life.scheduler.suspend(1h);
        life.run(2s);
    }
    life.run(2s);
    const RunFileContents file = contents();
    const Certificate paper = printed(file);
    EXPECT_EQ(paper.finished_utc, iso8601_utc(right + nanoseconds_of(file.run.closed.before)));
    for (const EventRecord& event : paper.run.events)
        EXPECT_EQ(iso8601_utc(event.utc_ns), iso8601_utc(right + nanoseconds_of(event.at)))
            << event.text;
    const auto slept = std::ranges::count_if(file.run.events, [](const EventRecord& event) {
        return event.text ==
               "The computer was suspended for 3600 s; nothing was recorded meanwhile.";
    });
    EXPECT_EQ(slept, 1);
}

TEST_F(ClockOfAStation, GoesOnInTheSameDaemonWhoseBootIsUnknown) {
    shop.boot_id = {};
    shop.config.cycle.approaches = 3;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 30; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run(2s);
    RevisionRequest request = of_target(1);
    request.selection.direction = Direction::positive;
    request.selection.approach = 0;
    ASSERT_TRUE(life.exclude(request));
    for (const EventRecord& event : contents().run.events)
        EXPECT_FALSE(begins_another_boot(event)) << event.text;
}

INSTANTIATE_TEST_SUITE_P(LaterAndMuchLater,
                         StationClockOfAnotherBoot,
                         ::testing::Values(60s, 5000s));

} // namespace
} // namespace axiscal::testing::station_clock_test

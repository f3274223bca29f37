// What paper tells of a run's times when the clock is set in mid-run or the computer restarted.
#include "analysis/record/run_clock.hpp"

#include "analysis/positioning/positioning_certificate.hpp"
#include "simulated_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace axiscal::run_clock_test {
namespace {

using test::at_seconds;
using test::simulated_run;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t opened_utc_ns = 1'767'225'600 * second_ns; // 2026-01-01T00:00:00Z

EventRecord event_at(double at_s, std::int64_t utc_s, const std::string& text = "") {
    return {EventKind::interrupted,
            at_seconds(at_s),
            opened_utc_ns + utc_s * second_ns,
            text,
            Fault::none,
            0};
}

/// Opened at 0 s, closed 3600 s later. Its clock says after 500 s that it is `by_s` later.
RunRecord run_with_a_clock_set_by(std::int64_t by_s) {
    RunRecord run = simulated_run({});
    run.events = {event_at(400, 400), event_at(600, 600 + by_s)};
    run.closed.utc_ns = opened_utc_ns + (3600 + by_s) * second_ns;
    return run;
}

bool holds(const std::vector<std::string>& remarks, const std::string& words) {
    return std::ranges::any_of(
        remarks, [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

class AClockThatWasSet : public ::testing::TestWithParam<std::int64_t> {};

TEST_P(AClockThatWasSet, MovesNoTimeOnPaper) {
    RunRevisions revisions;
    revisions.retakes = {
        {1, at_seconds(700), opened_utc_ns + (700 + GetParam()) * second_ns, "coolant", {}}};
    const auto certificate = make_certificate(run_with_a_clock_set_by(GetParam()), revisions, "");
    ASSERT_TRUE(certificate);
    EXPECT_EQ(certificate->started_utc, "2026-01-01T00:00:00Z");
    EXPECT_EQ(certificate->finished_utc, "2026-01-01T01:00:00Z");
    EXPECT_EQ(certificate->issued_on, "2026-01-01");
    EXPECT_EQ(certificate->next_due, "2027-01-01");
    EXPECT_EQ(iso8601_utc(certificate->run.events.at(1).utc_ns), "2026-01-01T00:10:00Z");
    EXPECT_EQ(iso8601_utc(certificate->revisions.retakes.at(0).utc_ns), "2026-01-01T00:11:40Z");
    EXPECT_TRUE(holds(certificate->remarks, "was interrupted at 2026-01-01T00:06:40Z"));
    EXPECT_TRUE(holds(certificate->remarks, "was interrupted at 2026-01-01T00:10:00Z"));
    const std::string by = std::to_string(std::abs(GetParam())) + " s";
    EXPECT_TRUE(holds(certificate->remarks, "was set in mid-run, by up to " + by));
}

INSTANTIATE_TEST_SUITE_P(ByAnHour, AClockThatWasSet, ::testing::Values(-3600, 3600, -86'400 * 400));

TEST(RunClock, SaysNothingOfAClockThatNobodySet) {
    const auto certificate = make_certificate(run_with_a_clock_set_by(1), "");
    EXPECT_FALSE(holds(certificate->remarks, "was set in mid-run"));
}

/// The second boot's clock begins at 0: 100 s after its start two hours have passed.
TEST(RunClock, TellsWhatAnotherBootWroteByThatBootsFirstEvent) {
    RunRecord run = simulated_run({});
    run.events = {
        event_at(400, 400),
        event_at(100, 7200, "The station recorded nothing while the computer was restarted."),
        event_at(160, 0)}; // set back meanwhile
    run.closed = {at_seconds(1000), 0, at_seconds(1000)};
    const auto certificate = make_certificate(run, "");
    EXPECT_EQ(certificate->started_utc, "2026-01-01T00:00:00Z");
    EXPECT_EQ(iso8601_utc(certificate->run.events.at(0).utc_ns), "2026-01-01T00:06:40Z");
    EXPECT_EQ(iso8601_utc(certificate->run.events.at(1).utc_ns), "2026-01-01T02:00:00Z");
    EXPECT_EQ(iso8601_utc(certificate->run.events.at(2).utc_ns), "2026-01-01T02:01:00Z");
    EXPECT_EQ(certificate->finished_utc, "2026-01-01T02:15:00Z");
    const ClockTie tie = tie_of_points(certificate->run.opened, certificate->run.events);
    EXPECT_EQ(iso8601_utc(tie.utc_ns_at(at_seconds(130))), "2026-01-01T02:00:30Z")
        << "what was measured was measured there";
}

/// A reading left out of a closed run after the computer was restarted; its points stand.
TEST(RunClock, LeavesPointsOfTheFirstBootWhereTheyWereMeasured) {
    RunRecord run = simulated_run({});
    EventRecord mark =
        event_at(9000, 90'000, "What follows was written after the computer was restarted.");
    mark.kind = EventKind::note;
    run.events = {mark};
    run.closed = {at_seconds(9001), opened_utc_ns + 90'001 * second_ns, at_seconds(9001)};
    const auto certificate = make_certificate(run, "");
    EXPECT_EQ(certificate->finished_utc, "2026-01-02T01:00:01Z");
    const ClockTie tie = tie_of_points(certificate->run.opened, certificate->run.events);
    EXPECT_EQ(iso8601_utc(tie.utc_ns_at(at_seconds(130))), "2026-01-01T00:02:10Z");
}

/// Of a file in which nothing tells of the restart.
TEST(RunClock, BelievesTheClockWhereTheMonotonicTimeIsEarlierThanTheOpening) {
    RunRecord run = simulated_run({});
    run.opened = {at_seconds(50), opened_utc_ns, at_seconds(50)};
    run.closed = {at_seconds(20), opened_utc_ns + 7200 * second_ns, at_seconds(20)};
    EXPECT_EQ(make_certificate(run, "")->finished_utc, "2026-01-01T02:00:00Z");
}

TEST(RunClock, NumbersThatFitInNoClockStayAsTheyAre) {
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    constexpr auto least = std::numeric_limits<std::int64_t>::min();
    for (const std::int64_t strange : {most, least, most - 1, least + 1}) {
        const ClockTie opened{monotonic_from_ns(least), strange, monotonic_from_ns(most)};
        std::vector<EventRecord> events{
            {EventKind::note, monotonic_from_ns(most), 7, "", Fault::none, 0}};
        std::vector<RetakeRecord> retakes;
        ClockTie closed{monotonic_from_ns(0), strange, monotonic_from_ns(0)};
        tell_times_by_one_clock(opened, events, retakes, closed);
        EXPECT_EQ(events[0].utc_ns, 7);
        EXPECT_EQ(closed.utc_ns, strange);
    }
}

} // namespace
} // namespace axiscal::run_clock_test

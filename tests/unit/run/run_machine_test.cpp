#include "bench.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <variant>
#include <vector>

namespace axiscal::run_machine_test {
namespace {

using testing::at_s;
using testing::Bench;
using testing::expect_refused;
using testing::small_setup;

TEST(Arming, TiesTheDatumDurablyBeforeTheRunIsOpen) {
    Bench bench;
    bench.give(Arm{bench.tick(), true});
    EXPECT_EQ(bench.open_window.expected, bench.setup.plan.datum);
    EXPECT_FALSE(bench.open_window.approach) << "no claim is made at the datum";
    EXPECT_FALSE(bench.saw<PublishArmed>());
    bench.window_here();
    const auto datum = bench.the<CommitDatum>().datum;
    EXPECT_EQ(datum.id, "UMD-17/1/1");
    EXPECT_EQ(datum.coordinate, bench.setup.plan.datum);
    EXPECT_EQ(datum.reading, bench.reading_zero);
    EXPECT_EQ(datum.device_count, 77u);
    EXPECT_FALSE(bench.saw<PublishArmed>());
    bench.commit();
    EXPECT_TRUE(bench.saw<PublishArmed>());
    EXPECT_FALSE(bench.saw<Acknowledge>()) << "the CNC asked for nothing";
    EXPECT_EQ(bench.machine.view().state, PortState::armed);
}

TEST(Arming, ByTheCncsPrepareIsAcknowledgedWhenDurable) {
    Bench bench;
    bench.give(Arm{bench.tick(), false});
    EXPECT_TRUE(bench.saw<PublishArmed>());
    expect_refused(bench.trigger(1), Fault::no_run_armed, "No datum is tied yet: send prepare");
    bench.trigger(1, TriggerCommand::prepare).window_here();
    EXPECT_EQ(bench.the<CommitDatum>().datum.sequence, 1);
    EXPECT_FALSE(bench.saw<Acknowledge>());
    bench.commit();
    EXPECT_EQ(bench.acknowledged, std::vector<std::uint16_t>{1});
    bench.point(2);
    EXPECT_EQ(bench.acknowledged, (std::vector<std::uint16_t>{1, 2}));
    EXPECT_EQ(bench.points.front().step, 0);
}

TEST(Arming, RefusesAPrepareThatClaimsAnotherPlaceThanTheDatum) {
    Bench bench; // its datum lies at 0 mm
    bench.give(Arm{bench.tick(), false});
    auto event = Bench::request(1, TriggerCommand::prepare);
    event.nominal_counts = 20'000; // 2 mm: counts of 0.1 um
    expect_refused(bench.trigger(event), Fault::wrong_target, "the plan's datum is at");
    EXPECT_FALSE(bench.saw<OpenWindow>());
    event.nominal_counts = 0;
    bench.trigger(event).window_here().commit();
    EXPECT_EQ(bench.acknowledged, std::vector<std::uint16_t>{1});
}

TEST(Arming, RefusesTriggersBeforeTheDatumIsDurable) {
    Bench bench;
    expect_refused(bench.trigger(1), Fault::no_run_armed);
    bench.give(Arm{bench.tick(), true});
    expect_refused(bench.trigger(1), Fault::no_run_armed);
    bench.window_here();
    expect_refused(bench.trigger(1), Fault::no_run_armed);
}

TEST(Arming, FailsAloudAndMayBeTriedAgain) {
    Bench bench;
    bench.give(Arm{bench.tick(), true}).window(fail(Fault::not_still, "The axis drifts."));
    expect_refused(bench, Fault::not_still, "drifts");
    EXPECT_EQ(bench.the<Refuse>().origin, TriggerOrigin::manual);
    bench.arm();
    EXPECT_TRUE(bench.saw<PublishArmed>());
    expect_refused(bench.give(Arm{bench.tick(), true}), Fault::busy);
}

TEST(Arming, RefusesANewDatumAfterTheFirstPoint) {
    Bench bench;
    bench.arm().point(1);
    expect_refused(bench.trigger(2, TriggerCommand::prepare), Fault::bad_command, "new run");
}

TEST(Point, IsAcknowledgedOnlyAfterItsCommit) {
    Bench bench;
    bench.arm().trigger(1);
    EXPECT_EQ(bench.the<SetState>().state, PortState::settling);
    EXPECT_EQ(bench.open_window.from, at_s(bench.now_s));
    EXPECT_EQ(bench.open_window.deadline - bench.open_window.from, std::chrono::seconds{10});
    ASSERT_TRUE(bench.open_window.approach);
    EXPECT_EQ(bench.open_window.approach->direction, Direction::positive);
    EXPECT_EQ(bench.open_window.approach->since, bench.machine.view().datum->at);
    bench.window_here();
    EXPECT_TRUE(bench.saw<CommitPoint>());
    EXPECT_FALSE(bench.saw<Acknowledge>());
    bench.commit();
    EXPECT_EQ(bench.the<Acknowledge>().sequence, 1);
    EXPECT_EQ(bench.the<Acknowledge>().step, 0);
    EXPECT_EQ(bench.machine.view().state, PortState::captured);
}

TEST(Point, KeepsWhatTheWindowShowed) {
    Bench bench;
    bench.arm().trigger(1).window(bench.capture_at(20.003_mm));
    const auto point = bench.the<CommitPoint>().point;
    EXPECT_EQ(point.sequence, 1);
    EXPECT_EQ(point.planned, bench.setup.plan.points[0]);
    EXPECT_EQ(point.datum_id, "UMD-17/1/1");
    EXPECT_EQ(point.reading, bench.reading_at(20.003_mm));
    EXPECT_NEAR(point.live_deviation.in(um), 3, 1e-6);
    EXPECT_EQ(point.approach_travel, 10.0_mm);
    EXPECT_EQ(point.samples.size(), 2u);
    EXPECT_LE(point.triggered_at, point.window_begin);
}

TEST(Point, LivePositionFollowsTheSign) {
    auto setup = small_setup();
    setup.reading = along_the_axis(testing::small_laser(-1));
    Bench bench{setup};
    bench.arm().trigger(1).window(bench.capture_at(20.003_mm));
    EXPECT_NEAR(bench.the<CommitPoint>().point.live_deviation.in(um), 3, 1e-6);
    EXPECT_EQ(bench.open_window.approach->sign, -1);
}

TEST(Point, TheLastDurableOneClosesTheRunComplete) {
    Bench bench;
    bench.arm();
    for (std::uint16_t i = 1; i < 10; ++i) {
        bench.point(i);
        EXPECT_FALSE(bench.saw<Close>());
    }
    bench.point(10);
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_TRUE(bench.the<Close>().complete);
    EXPECT_EQ(bench.acknowledged.size(), 10u);
    EXPECT_TRUE(std::holds_alternative<Close>(bench.last.back())) << "acknowledged first";
    EXPECT_TRUE(bench.trigger(10).saw<RepublishDone>());
    expect_refused(bench.trigger(11), Fault::no_run_armed);
}

TEST(Refusal, MayBeTriedAgainWithTheSameNumber) {
    Bench bench;
    bench.arm().trigger(1).window(fail(Fault::not_still, "Spread 4 um."));
    expect_refused(bench, Fault::not_still, "Spread 4 um");
    EXPECT_EQ(bench.the<Refuse>().sequence, 1);
    EXPECT_EQ(bench.machine.view().state, PortState::armed);
    auto again = Bench::request(1);
    again.standing = true;
    EXPECT_TRUE(bench.trigger(again).saw<OpenWindow>());
    bench.window_here().commit();
    EXPECT_EQ(bench.acknowledged, std::vector<std::uint16_t>{1});
}

TEST(Refusal, ALateWindowChangesNothing) {
    Bench bench;
    bench.arm().trigger(1).window(fail(Fault::not_still, ""));
    EXPECT_TRUE(bench.window_here().last.empty());
    EXPECT_EQ(bench.machine.view().counters.stray, 1);
    bench.trigger(1);
    const auto old = bench.open_window.window - 1;
    bench.give(WindowResult{old, bench.capture_at(20.0_mm), bench.tick()});
    EXPECT_FALSE(bench.saw<CommitPoint>());
}

TEST(Refusal, ACaptureThatNeverAnswersIsGivenUp) {
    Bench bench;
    bench.arm().trigger(1);
    EXPECT_TRUE(bench.give(Tick{at_s(bench.now_s + 11)}).last.empty());
    bench.give(Tick{at_s(bench.now_s + 13)});
    expect_refused(bench, Fault::not_still);
    EXPECT_TRUE(bench.saw<CloseWindow>());
}

TEST(Skip, IsAcknowledgedWhenDurableAndItsPointWaitsForARetake) {
    Bench bench;
    bench.arm().point(1).trigger(2, TriggerCommand::skip);
    ASSERT_TRUE(bench.saw<CommitEvent>());
    EXPECT_EQ(bench.the<CommitEvent>().step, 1);
    EXPECT_EQ(bench.the<CommitEvent>().event.kind, EventKind::skipped);
    EXPECT_FALSE(bench.saw<Acknowledge>());
    EXPECT_EQ(bench.machine.view().state, PortState::settling) << "nobody may move yet";
    EXPECT_TRUE(bench.commit().the<Acknowledge>().skipped);
    EXPECT_TRUE(bench.trigger(2).the<RepublishDone>().skipped);
    EXPECT_EQ(bench.machine.view().next->step, 2);
    for (std::uint16_t i = 3; i <= 10; ++i)
        bench.point(i);
    EXPECT_FALSE(bench.saw<Close>()) << "what is missing can still be taken";
    EXPECT_FALSE(bench.give(Tick{bench.tick()}).saw<Close>());
    EXPECT_EQ(bench.machine.view().without_point, 1);
    Retake retake;
    retake.selection.target = bench.setup.plan.points[1].target_index;
    retake.selection.direction = bench.setup.plan.points[1].direction;
    retake.reason = "the CNC skipped it";
    ASSERT_TRUE(bench.give(retake).saw<RecordRetake>());
    bench.point(11);
    EXPECT_EQ(bench.machine.view().without_point, 0);
    EXPECT_TRUE(bench.the<Close>().complete);
}

TEST(Skip, IsOfThePointThatItNamesAndNeedsTheDatum) {
    Bench bench;
    bench.give(Arm{bench.tick(), false});
    expect_refused(bench.trigger(1, TriggerCommand::skip), Fault::no_run_armed, "prepare");
    bench.trigger(1, TriggerCommand::prepare).window_here().commit();
    auto skip = Bench::request(2, TriggerCommand::skip);
    skip.target_index = 3;
    expect_refused(bench.trigger(skip), Fault::wrong_target, "target index 3");
    skip.target_index = 0;
    EXPECT_TRUE(bench.trigger(skip).saw<CommitEvent>());
}

TEST(Skip, ThatIsNotTakenAgainLeavesTheRunIncomplete) {
    Bench bench;
    bench.arm();
    for (std::uint16_t i = 1; i <= 9; ++i)
        bench.point(i);
    bench.trigger(10, TriggerCommand::skip).commit();
    EXPECT_FALSE(bench.saw<Close>());
    bench.give(Abort{"The customer left.", bench.tick()});
    EXPECT_FALSE(bench.the<Close>().complete);
}

TEST(Claim, OfAnotherApproachThanThePlansNextIsRefused) {
    Bench bench;
    bench.arm();
    auto event = Bench::request(1);
    event.run_index = 1;
    expect_refused(bench.trigger(event), Fault::wrong_target, "RUN_INDEX");
    event.run_index = 0;
    EXPECT_TRUE(bench.trigger(event).saw<OpenWindow>());
}

TEST(Closing, OfARunThatWasBrokenOffPublishesNoNumberAgain) {
    Bench bench;
    bench.arm().point(1);
    bench.give(Abort{"enough", bench.tick()});
    EXPECT_FALSE(bench.the<Close>().answers_cnc);
    expect_refused(bench.trigger(1), Fault::no_run_armed);
}

TEST(End, BeforeTheLastPointIsAcknowledgedAndClosesIncomplete) {
    Bench bench;
    bench.arm().point(1).trigger(2, TriggerCommand::end).commit();
    EXPECT_TRUE(bench.the<Close>().answers_cnc);
    EXPECT_EQ(bench.acknowledged, (std::vector<std::uint16_t>{1, 2}));
    EXPECT_FALSE(bench.the<Close>().complete);
}

TEST(Abort, OfTheCncIsHeardWhateverItsNumber) {
    for (const auto sequence : {std::uint16_t{2}, std::uint16_t{9}}) {
        Bench bench;
        bench.arm().point(1).trigger(sequence, TriggerCommand::abort);
        if (bench.saw<CommitEvent>()) bench.commit();
        ASSERT_TRUE(bench.saw<Close>()) << sequence;
        EXPECT_FALSE(bench.the<Close>().complete);
    }
}

TEST(Abort, DuringAWindowClosesItAndTheRun) {
    Bench bench;
    bench.arm().trigger(1).give(Abort{"Stopped by the technician.", bench.tick()});
    EXPECT_TRUE(bench.saw<CloseWindow>());
    EXPECT_EQ(bench.the<Close>().reason, "Stopped by the technician.");
    EXPECT_TRUE(bench.window_here().last.empty());
}

TEST(Abort, DuringACommitWaitsForTheDisk) {
    Bench bench;
    bench.arm().trigger(1).window_here().give(Abort{"Stop.", bench.tick()});
    EXPECT_FALSE(bench.saw<Close>());
    bench.commit();
    EXPECT_TRUE(bench.saw<Acknowledge>());
    EXPECT_FALSE(bench.the<Close>().complete);
}

TEST(Manual, CaptureTakesTheNextNumberAndIsMarked) {
    Bench bench;
    TriggerEvent manual;
    manual.origin = TriggerOrigin::manual;
    bench.arm().point(1).trigger(manual).window_here();
    EXPECT_EQ(bench.points.back().origin, TriggerOrigin::manual);
    EXPECT_EQ(bench.points.back().sequence, 2);
    bench.commit();
    EXPECT_TRUE(bench.trigger(2).saw<RepublishDone>()) << "the CNC's own request 2 is answered";
    EXPECT_TRUE(bench.point(3).saw<Acknowledge>());
}

TEST(Manual, CaptureIsRefusedWhileOneIsUnderWay) {
    Bench bench;
    TriggerEvent manual;
    manual.origin = TriggerOrigin::manual;
    expect_refused(bench.arm().trigger(1).trigger(manual), Fault::busy);
    EXPECT_EQ(bench.the<Refuse>().origin, TriggerOrigin::manual);
    EXPECT_TRUE(bench.window_here().commit().saw<Acknowledge>());
}

TEST(Dwell, TriggersCarryNoNumberOfTheirOwn) {
    Bench bench;
    TriggerEvent dwell;
    dwell.origin = TriggerOrigin::dwell;
    bench.arm().trigger(dwell);
    EXPECT_TRUE(bench.trigger(dwell).last.empty()) << "doubled";
    bench.window_here().commit();
    EXPECT_EQ(bench.acknowledged, std::vector<std::uint16_t>{1});
    EXPECT_EQ(bench.points.back().origin, TriggerOrigin::dwell);
}

} // namespace
} // namespace axiscal::run_machine_test

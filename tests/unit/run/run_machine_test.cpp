#include "bench.hpp"

#include "acquisition/run/sequence.hpp"

#include <gtest/gtest.h>

namespace axiscal {
namespace {

using testing::at_s;
using testing::Bench;
using testing::small_setup;

void expect_refused(const Bench& bench, Fault fault, const std::string& words = {}) {
    ASSERT_TRUE(bench.saw<Refuse>());
    const auto refusal = bench.the<Refuse>();
    EXPECT_EQ(refusal.fault, fault) << refusal.sentence;
    EXPECT_NE(refusal.sentence.find(words), std::string::npos) << refusal.sentence;
    EXPECT_FALSE(bench.saw<Acknowledge>());
}

TEST(Sequence, SixtyFiveThousandFiveHundredThirtyFiveIsFollowedByOne) {
    EXPECT_EQ(next_sequence(0), 1);
    EXPECT_EQ(next_sequence(1), 2);
    EXPECT_EQ(next_sequence(65535), 1);
}

TEST(Sequence, NamesWhatWentWrongWithTheNumber) {
    EXPECT_EQ(describe_disorder(8, 5),
              "Request 8 came, but request 6 is awaited: requests 6 to 7 were missed.");
    EXPECT_EQ(describe_disorder(7, 5),
              "Request 7 came, but request 6 is awaited: request 6 was missed.");
    EXPECT_EQ(describe_disorder(3, 5), "Request 3 came late: it was finished before, request 6 is "
                                       "awaited (last durable: 5).");
    EXPECT_NE(describe_disorder(1, 5).find("counter was restarted"), std::string::npos);
    EXPECT_NE(describe_disorder(2, 65535).find("request 1 was missed"), std::string::npos);
    EXPECT_NE(describe_disorder(65534, 65535).find("late"), std::string::npos);
    EXPECT_NE(describe_disorder(1, 65534).find("counter was restarted"), std::string::npos);
}

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
    setup.laser.sign = -1;
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

TEST(Order, ZeroIsIdle) {
    Bench bench;
    EXPECT_TRUE(bench.arm().trigger(0).last.empty());
    bench.point(1);
    EXPECT_TRUE(bench.trigger(0).last.empty());
}

TEST(Order, WhatStandsThereWhenTheRunIsArmedIsTheBaseline) {
    Bench bench;
    bench.arm();
    auto old = Bench::request(110);
    old.standing = true;
    EXPECT_TRUE(bench.trigger(old).last.empty());
    old.sequence = 1;
    EXPECT_TRUE(bench.trigger(old).last.empty());
    EXPECT_TRUE(bench.trigger(1).saw<OpenWindow>());
}

TEST(Order, TheLastFinishedRequestIsPublishedAgainAndTakesNoPoint) {
    Bench bench;
    bench.arm().point(1).trigger(1);
    EXPECT_EQ(bench.the<RepublishDone>().sequence, 1);
    EXPECT_EQ(bench.the<RepublishDone>().step, 0);
    EXPECT_FALSE(bench.saw<OpenWindow>());
    bench.trigger(2).trigger(1);
    EXPECT_TRUE(bench.saw<RepublishDone>()) << "also while the next one is under way";
    EXPECT_EQ(bench.points.size(), 1u);
    EXPECT_EQ(bench.machine.view().counters.republished, 2);
}

TEST(Order, TheRequestUnderWayIsCountedWhenItComesAgain) {
    Bench bench;
    bench.arm().trigger(1);
    EXPECT_TRUE(bench.trigger(1).last.empty());
    bench.window_here();
    EXPECT_TRUE(bench.trigger(1).last.empty());
    bench.commit();
    EXPECT_EQ(bench.points.size(), 1u);
    EXPECT_EQ(bench.machine.view().counters.doubled, 2);
}

TEST(Order, EverythingElseIsOutOfOrderAndNamed) {
    Bench bench;
    bench.arm().point(1).point(2).point(3);
    expect_refused(bench.trigger(6), Fault::out_of_order, "requests 4 to 5 were missed");
    expect_refused(bench.trigger(2), Fault::out_of_order, "came late");
    expect_refused(bench.trigger(1), Fault::out_of_order, "counter was restarted");
    EXPECT_EQ(bench.the<Refuse>().sequence, 1);
    EXPECT_EQ(bench.machine.view().counters.out_of_order, 3);
    EXPECT_EQ(bench.machine.view().last_durable, 3);
    EXPECT_TRUE(bench.point(4).saw<Acknowledge>()) << "the right one is still welcome";
}

TEST(Order, TheNextButOneWhileOneIsUnderWayWasMissed) {
    Bench bench;
    bench.arm().trigger(1);
    expect_refused(bench.trigger(2), Fault::out_of_order, "request 1 was missed");
    EXPECT_TRUE(bench.window_here().commit().saw<Acknowledge>());
}

TEST(Order, ARefusalRepeatedAtBusSpeedIsRecordedOnce) {
    Bench bench;
    bench.arm().trigger(5);
    EXPECT_TRUE(bench.saw<RecordEvent>());
    bench.trigger(5);
    EXPECT_TRUE(bench.saw<Refuse>());
    EXPECT_FALSE(bench.saw<RecordEvent>());
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

TEST(Claim, IsComparedWithThePlanBeforeAnyWindowOpens) {
    Bench bench;
    bench.arm();
    auto event = Bench::request(1);
    event.target_index = 3;
    expect_refused(bench.trigger(event), Fault::wrong_target,
                   "The CNC claims target index 3; the plan's next point is target index 0 at 20 "
                   "mm from the positive direction (point 1 of 10).");
    event = Bench::request(1);
    event.direction = Direction::negative;
    expect_refused(bench.trigger(event), Fault::wrong_direction, "claims the negative direction");
    event = Bench::request(1);
    event.nominal_counts = 1'200'000;
    expect_refused(bench.trigger(event), Fault::wrong_target, "claims the position 120 mm");
    EXPECT_FALSE(bench.saw<OpenWindow>());
    event.nominal_counts = 200'000;
    event.target_index = 0;
    event.direction = Direction::positive;
    EXPECT_TRUE(bench.trigger(event).saw<OpenWindow>());
}

TEST(Claim, OfARotaryAxisCountsHundredThousandthsOfADegree) {
    auto setup = small_setup();
    setup.plan.axis_kind = AxisKind::rotary;
    Bench bench{setup};
    bench.arm();
    auto event = Bench::request(1);
    event.nominal_counts = 200'000; // 2 degrees
    expect_refused(bench.trigger(event), Fault::wrong_target);
    event.nominal_counts = 2'000'000; // 20 degrees
    EXPECT_TRUE(bench.trigger(event).saw<OpenWindow>());
}

TEST(Place, WithinTheToleranceIsNear) {
    Bench bench;
    bench.arm().trigger(1).window(bench.capture_at(20.499_mm));
    EXPECT_TRUE(bench.saw<CommitPoint>());
    bench.commit().trigger(2).window(bench.capture_at(120.501_mm));
    expect_refused(bench, Fault::outside_window);
}

TEST(Place, LaterTargetsAreToldWhereTheAxisStands) {
    Bench bench;
    bench.arm().point(1).point(2).trigger(3).window(bench.capture_at(320.0_mm));
    expect_refused(bench, Fault::outside_window,
                   "The axis stands at 320 mm, 100 mm from the target at 220 mm; 0.5 mm are "
                   "allowed; it stands at the target at 320 mm.");
}

TEST(Place, AtTheFirstTargetsTheCauseIsNamed) {
    Bench bench;
    bench.arm().trigger(1).window(bench.capture_at(-20.0_mm));
    expect_refused(bench, Fault::wrong_direction, "the sign is turned");
    bench.trigger(1).window(bench.capture_at(508.0_mm));
    expect_refused(bench, Fault::outside_window, "inch");
    bench.trigger(1).window(bench.capture_at(0.0_mm));
    expect_refused(bench, Fault::wrong_target, "does not move");
    EXPECT_TRUE(bench.point(1).saw<Acknowledge>());
    bench.trigger(2).window(bench.capture_at(122.0_mm));
    expect_refused(bench, Fault::outside_window);
}

TEST(Place, TheSideIsJudgedAfterThePlace) {
    Bench bench;
    auto wrong_side = bench.arm().trigger(1).capture_at(20.0_mm);
    wrong_side.approach_travel = fail(Fault::wrong_direction, "Seen only 0 mm from below.");
    bench.window(wrong_side);
    expect_refused(bench, Fault::wrong_direction, "Seen only 0 mm from below");
    EXPECT_FALSE(bench.saw<CommitPoint>());
    wrong_side.mean = bench.reading_at(-20.0_mm);
    bench.trigger(1).window(wrong_side);
    expect_refused(bench, Fault::wrong_direction, "the sign is turned");
}

TEST(Environment, WithoutAFreshReadingNothingIsCaptured) {
    Bench bench;
    bench.arm();
    bench.give(EnvironmentNow{fail(Fault::environment_stale, "material 2 is 90 s old")});
    expect_refused(bench.trigger(1), Fault::environment_stale, "material 2 is 90 s old");
    EXPECT_FALSE(bench.saw<OpenWindow>());
    bench.give(EnvironmentNow{2.7e-4}).trigger(1);
    bench.give(EnvironmentNow{fail(Fault::environment_stale, "air is gone")}).window_here();
    expect_refused(bench, Fault::environment_stale, "air is gone");
}

TEST(Environment, CountsAsStaleBeforeItsFirstReading) {
    RunMachine machine{small_setup()};
    const auto actions = machine.handle(Arm{at_s(1), true});
    const auto* refusal = std::get_if<Refuse>(&actions.back());
    ASSERT_NE(refusal, nullptr);
    EXPECT_EQ(refusal->fault, Fault::environment_stale);
}

TEST(Laser, ALostBeamInTheWindowIsRefusedAndEndsTheRunAtTheNextRequest) {
    Bench bench;
    bench.arm().point(1).trigger(2).window(fail(Fault::beam_lost, "Interrupted."));
    expect_refused(bench, Fault::beam_lost);
    expect_refused(bench.trigger(2), Fault::datum_lost);
    EXPECT_FALSE(bench.the<Close>().complete);
    EXPECT_EQ(bench.the<Close>().fault, Fault::datum_lost);
}

TEST(Laser, AJumpInTheWindowEndsTheRunAtTheNextRequest) {
    Bench bench;
    bench.arm().trigger(1).window(fail(Fault::implausible_jump, "5 mm in 1 ms."));
    expect_refused(bench, Fault::implausible_jump);
    expect_refused(bench.trigger(1), Fault::datum_lost);
}

TEST(Laser, AnotherEpochThanTheDatumsClosesTheRun) {
    Bench bench;
    bench.arm().point(1).trigger(2);
    bench.epoch = 2;
    bench.window_here();
    expect_refused(bench, Fault::datum_lost, "restarted since the datum");
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_FALSE(bench.the<Close>().complete);
    expect_refused(bench.trigger(2), Fault::no_run_armed);
}

TEST(Laser, ALostZeroBetweenPointsClosesTheRun) {
    Bench bench;
    bench.arm().point(1).give(LaserFault{Fault::datum_lost, "Counter restarted.", bench.tick()});
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_EQ(bench.the<Close>().reason, "Counter restarted.");
}

TEST(Laser, ALostZeroWhileCommittingLetsThePointReachTheDisk) {
    Bench bench;
    bench.arm().trigger(1).window_here();
    bench.give(LaserFault{Fault::datum_lost, "Counter restarted.", bench.tick()});
    EXPECT_FALSE(bench.saw<Close>());
    bench.commit();
    EXPECT_EQ(bench.acknowledged, std::vector<std::uint16_t>{1});
    EXPECT_EQ(bench.the<Close>().fault, Fault::datum_lost);
}

TEST(Laser, AFaultDuringTheWindowIsToldAtOnce) {
    Bench bench;
    bench.arm().trigger(1).give(LaserFault{Fault::overspeed, "Slew error.", bench.tick()});
    expect_refused(bench, Fault::overspeed, "Slew error");
    EXPECT_TRUE(bench.saw<CloseWindow>());
    EXPECT_TRUE(bench.trigger(1).saw<OpenWindow>());
}

TEST(Disk, AFailedCommitIsFinal) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    bench.give(CommitFailed{"No space left.", bench.tick()});
    expect_refused(bench, Fault::not_durable, "No space left");
    EXPECT_EQ(bench.machine.view().state, PortState::error);
    EXPECT_FALSE(bench.saw<Close>()) << "the run stays open for the next start";
    expect_refused(bench.trigger(2), Fault::not_durable);
    expect_refused(bench.trigger(3), Fault::not_durable);
    EXPECT_TRUE(bench.trigger(1).saw<RepublishDone>()) << "what is durable stays so";
    EXPECT_TRUE(bench.commit().last.empty()) << "a late success is not believed";
    EXPECT_EQ(bench.machine.view().last_durable, 1);
}

std::shared_ptr<const RunRecord> disk_with_points(int count) {
    RunRecord run;
    for (int step = 0; step < count; ++step)
        run.points.emplace_back().step = step;
    return std::make_shared<const RunRecord>(std::move(run));
}

TEST(Disk, ARecordThatItRefusedIsWrittenWhenItIsBack) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    bench.give(CommitFailed{"No space left.", bench.tick()});
    bench.give(DiskBack{disk_with_points(1), bench.tick()});
    ASSERT_TRUE(bench.saw<CommitPoint>());
    EXPECT_EQ(bench.the<CommitPoint>().point.sequence, 2);
    EXPECT_FALSE(bench.saw<Acknowledge>());
    EXPECT_TRUE(bench.commit().saw<Acknowledge>());
    EXPECT_EQ(bench.machine.view().last_durable, 2);
    EXPECT_TRUE(bench.point(3).saw<Acknowledge>());
}

TEST(Disk, WhatIsKnownOfTheTimeOfACaptureGoesWithItAlsoTheSecondTime) {
    constexpr Synchronisation known{std::chrono::microseconds{48}, 12e-6};
    Bench bench;
    bench.arm().point(1).trigger(2);
    EXPECT_FALSE(bench.machine.view().last_synchronisation) << "of point 1: not stated";
    auto capture = bench.capture_at(bench.open_window.expected);
    capture.synchronisation = known;
    bench.window(std::move(capture));
    ASSERT_TRUE(bench.the<CommitPoint>().synchronisation);
    EXPECT_EQ(bench.the<CommitPoint>().synchronisation->error_um, known.error_um);
    EXPECT_EQ(bench.machine.view().last_synchronisation->error_um, known.error_um);
    bench.give(CommitFailed{"No space left.", bench.tick()});
    bench.give(DiskBack{disk_with_points(1), bench.tick()});
    ASSERT_TRUE(bench.the<CommitPoint>().synchronisation);
    EXPECT_EQ(bench.the<CommitPoint>().synchronisation->error_um, known.error_um);
}

TEST(Disk, ARecordThatIsThereAfterAllIsAcknowledgedAndNotWrittenTwice) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    bench.give(DiskBack{disk_with_points(2), bench.tick()});
    EXPECT_FALSE(bench.saw<CommitPoint>());
    EXPECT_TRUE(bench.saw<Acknowledge>());
    EXPECT_EQ(bench.machine.view().last_durable, 2);
}

TEST(Disk, ThatIsBackUncalledForChangesNothing) {
    Bench bench;
    bench.arm().point(1).trigger(2).window_here();
    EXPECT_TRUE(bench.give(DiskBack{disk_with_points(2), bench.tick()}).last.empty());
    EXPECT_EQ(bench.machine.view().last_durable, 1);
}

TEST(Disk, ACommitThatNobodyAskedForIsNeverAcknowledged) {
    Bench bench;
    bench.arm();
    EXPECT_TRUE(bench.give(Committed{1, 0, bench.tick()}).last.empty());
    bench.trigger(1);
    EXPECT_TRUE(bench.give(Committed{1, 0, bench.tick()}).last.empty());
    bench.window_here();
    EXPECT_TRUE(bench.give(Committed{1, 1, bench.tick()}).last.empty());
    EXPECT_TRUE(bench.give(Committed{2, 0, bench.tick()}).last.empty());
    EXPECT_TRUE(bench.commit().saw<Acknowledge>());
    EXPECT_TRUE(bench.commit().last.empty()) << "once";
}

TEST(Skip, IsAcknowledgedWhenDurableAndLeavesTheRunIncomplete) {
    Bench bench;
    bench.arm().point(1).trigger(2, TriggerCommand::skip);
    ASSERT_TRUE(bench.saw<CommitEvent>());
    EXPECT_EQ(bench.the<CommitEvent>().step, 1);
    EXPECT_EQ(bench.the<CommitEvent>().event.kind, EventKind::skipped);
    EXPECT_FALSE(bench.saw<Acknowledge>());
    EXPECT_TRUE(bench.commit().saw<Acknowledge>());
    EXPECT_EQ(bench.machine.view().next->step, 2);
    for (std::uint16_t i = 3; i <= 10; ++i)
        bench.point(i);
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_FALSE(bench.the<Close>().complete);
    EXPECT_EQ(bench.the<Close>().reason, "1 of the points were skipped.");
}

TEST(End, BeforeTheLastPointIsAcknowledgedAndClosesIncomplete) {
    Bench bench;
    bench.arm().point(1).trigger(2, TriggerCommand::end).commit();
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
} // namespace axiscal

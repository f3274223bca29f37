// Points taken again and readings left out: the trigger contract stays what it was.
#include "bench.hpp"

#include "acquisition/run/retake_plan.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <utility>

namespace axiscal::retake_test {
namespace {

using testing::Bench;
using testing::small_setup;

Retake of_target(int target, const std::string& reason = "coolant on the mirror") {
    Retake retake;
    retake.selection.target = target;
    retake.reason = reason;
    return retake;
}

Bench after(int points, RunSetup setup = small_setup()) {
    Bench bench{std::move(setup)};
    bench.arm();
    for (int k = 1; k <= points; ++k)
        bench.point(static_cast<std::uint16_t>(k));
    return bench;
}

/// Three approaches each way at two targets: twelve points.
RunSetup repeated_setup() {
    CycleConfig config;
    config.travel_low = 0.0_mm;
    config.travel_high = 500.0_mm;
    config.targets = std::vector<Length>{20.0_mm, 120.0_mm, 220.0_mm, 320.0_mm, 420.0_mm};
    config.overrun = 10.0_mm;
    config.approaches = 3;
    RunSetup setup = small_setup();
    setup.plan = plan_passes(config, 1)->front();
    return setup;
}

std::string refusal_of(Bench& bench) {
    return bench.saw<Refuse>() ? bench.the<Refuse>().sentence : "accepted";
}

TEST(RetakeOrder, FollowsThePlansPointsAndTheRequestsCountOn) {
    auto bench = after(3);
    bench.give(of_target(1)); // measured upwards only: point 2
    ASSERT_TRUE(bench.saw<RecordRetake>());
    const auto order = bench.the<RecordRetake>();
    EXPECT_FALSE(order.reopens);
    EXPECT_EQ(order.retake.number, 1);
    ASSERT_EQ(order.retake.points.size(), 1U);
    EXPECT_EQ(order.retake.points[0].step, 10);
    EXPECT_EQ(order.retake.points[0].planned_step, 1);
    for (std::uint16_t k = 4; k <= 10; ++k)
        bench.point(k);
    EXPECT_FALSE(bench.machine.view().closed);
    EXPECT_EQ(bench.machine.view().next->target_index, 1);
    bench.trigger(11);
    EXPECT_EQ(bench.open_window.expected, 120.0_mm);
    bench.window_here().commit();
    EXPECT_EQ(bench.acknowledged.back(), 11);
    EXPECT_EQ(bench.points.back().step, 10);
    EXPECT_EQ(bench.points.back().planned, bench.setup.plan.points[1]);
    EXPECT_TRUE(bench.machine.view().complete);
}

TEST(RetakeOrder, ReopensARunThatWasClosedComplete) {
    auto bench = after(10);
    ASSERT_TRUE(bench.machine.view().closed);
    bench.give(of_target(4));
    EXPECT_TRUE(bench.the<RecordRetake>().reopens);
    EXPECT_EQ(bench.machine.view().retakes_left, 2); // both directions
    EXPECT_FALSE(bench.machine.view().closed);
    bench.trigger(1);
    EXPECT_NE(refusal_of(bench).find("counter was restarted"), std::string::npos);
    bench.trigger(10);
    EXPECT_TRUE(bench.saw<RepublishDone>())
        << "the retake program asks whether the station is here";
    bench.point(11);
    EXPECT_FALSE(bench.machine.view().closed);
    bench.point(12);
    EXPECT_TRUE(bench.machine.view().complete);
    EXPECT_EQ(bench.the<Close>().complete, true);
}

TEST(RetakeOrder, HoldsTheClaimAndThePlaceAsEveryPointDoes) {
    auto bench = after(10);
    bench.give(of_target(0));
    auto request = Bench::request(11);
    request.target_index = 1;
    bench.trigger(request);
    EXPECT_NE(refusal_of(bench).find("to be taken again"), std::string::npos);
    bench.trigger(11).window(bench.capture_at(120.0_mm));
    EXPECT_NE(refusal_of(bench).find("it stands at the target at 120"), std::string::npos);
    bench.point(11).point(12);
    EXPECT_TRUE(bench.machine.view().complete);
}

TEST(RetakeOrder, NamesWhyItCannotBe) {
    auto bench = after(3);
    EXPECT_NE(refusal_of(bench.give(of_target(3))).find("Nothing of that is measured yet"),
              std::string::npos);
    EXPECT_NE(
        refusal_of(bench.give(of_target(7))).find("no such point; it has 5 targets and 1 cycle."),
        std::string::npos);
    EXPECT_NE(refusal_of(bench.give(of_target(1, ""))).find("reason"), std::string::npos);
    EXPECT_NE(refusal_of(bench.give(Retake{{}, "why", bench.tick()})).find("Say which"),
              std::string::npos);
    bench.give(of_target(1));
    EXPECT_NE(refusal_of(bench.give(of_target(1))).find("already"), std::string::npos);
    bench.give(LaserFault{Fault::datum_lost, "The beam was cut.", bench.tick()});
    EXPECT_NE(refusal_of(bench.give(of_target(0))).find("incomplete"), std::string::npos);
}

TEST(RetakeOrder, IsRefusedWhenTheDatumIsBroken) {
    auto bench = after(3);
    bench.give(LaserFault{Fault::beam_lost, "The beam was cut.", bench.tick()});
    bench.give(of_target(1));
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::datum_lost);
}

TEST(RetakeOrder, ThatIsNotDoneLeavesTheRunComplete) {
    auto bench = after(10);
    bench.give(of_target(4)).point(11);
    bench.give(Abort{"The customer left.", bench.tick()});
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_TRUE(bench.the<Close>().complete);
    EXPECT_NE(bench.the<Close>().reason.find("not every retake was done"), std::string::npos);
    auto young = after(3);
    young.give(of_target(0));
    young.give(Abort{"The customer left.", young.tick()});
    EXPECT_FALSE(young.the<Close>().complete) << "the plan itself is not done";
}

TEST(RetakeOrder, SurvivesTheDaemon) {
    auto bench = after(10);
    bench.give(of_target(4));
    RunRecord disk;
    disk.plan = bench.setup.plan;
    disk.points = bench.points;
    DatumRecord datum;
    datum.id = "UMD-17/1/1";
    datum.at = testing::at_s(100);
    datum.reading = bench.reading_zero;
    disk.datums.push_back(datum);
    RunSetup setup = bench.setup;
    setup.revisions.retakes.push_back(bench.the<RecordRetake>().retake);
    EXPECT_EQ(points_to_take_again(disk, setup.revisions).size(), 2U);
    bench.machine = RunMachine{setup, disk, bench.epoch, bench.tick()};
    bench.give(EnvironmentNow{testing::air_index_minus_1});
    bench.point(11);
    // The reading of planned point 4 is now the new one.
    setup.revisions.superseded.push_back(disk.points[4]);
    disk.points[4] = bench.points.back();
    EXPECT_EQ(points_to_take_again(disk, setup.revisions).size(), 1U);
    bench.machine = RunMachine{setup, disk, bench.epoch, bench.tick()};
    bench.give(EnvironmentNow{testing::air_index_minus_1});
    EXPECT_EQ(bench.machine.view().retakes_left, 1);
    bench.point(12);
    EXPECT_TRUE(bench.machine.view().complete);
}

TEST(RetakeOrder, OfAWholeCycleTakesItInThePlansOrder) {
    auto bench = after(30, repeated_setup());
    Retake cycle;
    cycle.selection.approach = 1;
    cycle.reason = "a door was opened";
    bench.give(cycle);
    const auto order = bench.the<RecordRetake>().retake;
    ASSERT_EQ(order.points.size(), 10U);
    for (std::size_t k = 0; k < order.points.size(); ++k)
        EXPECT_EQ(order.points[k].planned_step, 10 + static_cast<int>(k));
}

std::shared_ptr<const RunRecord> disk_with(int points) {
    RunRecord run;
    for (int step = 0; step < points; ++step)
        run.points.emplace_back().step = step;
    return std::make_shared<const RunRecord>(std::move(run));
}

TEST(RetakeOrder, ThatWasNotWrittenTakesBackOnlyWhatItAdded) {
    auto bench = after(3);
    bench.keeps_orders = false;
    bench.trigger(4).window_here(); // its commit is under way
    ASSERT_TRUE(bench.give(of_target(1)).saw<RecordRetake>());
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    bench.give(RevisionLost{bench.tick()});
    EXPECT_EQ(bench.machine.view().total, 10);
    EXPECT_EQ(bench.machine.view().retakes_asked, 0);
    EXPECT_TRUE(bench.machine.view().stopped) << "the failed commit is not forgotten";
    bench.give(DiskBack{disk_with(3), bench.tick()});
    EXPECT_EQ(bench.the<CommitPoint>().point.sequence, 4);
    bench.commit();
    for (std::uint16_t k = 5; k <= 10; ++k)
        bench.point(k);
    EXPECT_TRUE(bench.machine.view().complete);
}

TEST(RetakeOrder, ThatWasNotWrittenLetsTheRunBeAborted) {
    auto bench = after(3);
    bench.keeps_orders = false;
    bench.trigger(4).window_here();
    bench.give(of_target(1));
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    bench.give(RevisionLost{bench.tick()});
    EXPECT_TRUE(bench.give(Abort{"The disk is gone.", bench.tick()}).saw<Close>());
}

TEST(RetakeOrder, ThatWasNotWrittenTakesItsOwnPointsWithIt) {
    auto bench = after(10);
    bench.give(of_target(4)); // two points, written
    bench.point(11).keeps_orders = false;
    ASSERT_TRUE(bench.give(of_target(1)).saw<RecordRetake>());
    bench.point(12).trigger(13).window_here(); // of the order that is not known to be written
    EXPECT_EQ(bench.points.back().step, 12);
    bench.give(RevisionLost{bench.tick()});
    EXPECT_EQ(bench.machine.view().total, 12);
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    bench.give(DiskBack{disk_with(10), bench.tick()});
    EXPECT_FALSE(bench.saw<CommitPoint>()) << "nobody ordered it";
    EXPECT_TRUE(bench.give(Tick{bench.tick()}).the<Close>().complete);
}

TEST(RetakeOrder, OpensAClosedRunOnlyOnceItIsWritten) {
    auto bench = after(10);
    bench.keeps_orders = false;
    bench.give(of_target(4));
    EXPECT_TRUE(bench.machine.view().closed);
    bench.trigger(11);
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::no_run_armed);
    bench.give(of_target(1));
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::busy);
    bench.give(RevisionLost{bench.tick()});
    EXPECT_TRUE(bench.machine.view().closed && bench.machine.view().complete);
    EXPECT_EQ(bench.machine.view().total, 10);
    bench.give(of_target(4)).give(RevisionKept{bench.tick()});
    EXPECT_FALSE(bench.machine.view().closed);
    EXPECT_EQ(bench.the<SetState>().state, PortState::armed);
}

TEST(RetakeOrder, ThatIsRefusedChangesNothingOfTheRun) {
    auto bench = after(3);
    bench.trigger(7); // refused, and told to the CNC
    const int refused = bench.machine.view().counters.refused;
    bench.give(of_target(99));
    ASSERT_TRUE(bench.saw<Refuse>());
    EXPECT_EQ(bench.last.size(), 1U) << "no event, no state: the answer alone";
    EXPECT_EQ(bench.machine.view().counters.refused, refused);
    bench.trigger(7);
    EXPECT_FALSE(bench.saw<RecordEvent>()) << "the CNC's repetition is still known as one";
}

RetakeRecord first_order(std::vector<RetakePoint> points) {
    RetakeRecord order;
    order.points = std::move(points);
    return order;
}

DiskBack disk_with_orders(int points, RunRevisions orders, MonotonicTime at) {
    return {disk_with(points), at, std::make_shared<const RunRevisions>(std::move(orders))};
}

/// A sync that fails may have written all the same, and the next daemon would find it there.
TEST(RetakeOrder, ThatWasLostIsTakenUpWhereTheDiskHeldItAfterAll) {
    auto bench = after(3);
    bench.keeps_orders = false;
    bench.give(of_target(1)).give(RevisionLost{bench.tick()});
    RunRevisions orders;
    orders.retakes.push_back(first_order({{10, 1}}));
    bench.give(disk_with_orders(3, orders, bench.tick()));
    EXPECT_EQ(bench.machine.view().retakes_asked, 1);
    bench.keeps_orders = true;
    EXPECT_EQ(bench.give(of_target(0)).the<RecordRetake>().retake.number, 2);
    for (std::uint16_t k = 4; k <= 12; ++k)
        bench.point(k);
    EXPECT_TRUE(bench.machine.view().complete);
    EXPECT_EQ(bench.points.back().planned, bench.setup.plan.points[0]);
}

TEST(RetakeOrder, OfAClosedRunOpensItWhereTheDiskHeldItAfterAll) {
    auto bench = after(10);
    bench.keeps_orders = false;
    bench.give(of_target(4)).give(RevisionLost{bench.tick()});
    RunRevisions orders;
    orders.retakes.push_back(first_order({{10, 4}, {11, 5}}));
    DiskBack back = disk_with_orders(10, orders, bench.tick());
    back.reopened = true;
    bench.give(back);
    EXPECT_FALSE(bench.machine.view().closed);
    EXPECT_EQ(bench.the<SetState>().state, PortState::armed);
    bench.point(11).point(12);
    EXPECT_TRUE(bench.machine.view().complete);
}

/// The abort comes while the last record is on its way: it is kept, and the run is complete.
Bench aborted_too_late(int points, RunSetup setup = small_setup()) {
    auto bench = after(points - 1, std::move(setup));
    bench.trigger(static_cast<std::uint16_t>(points)).window_here();
    bench.give(Abort{"The customer left.", bench.tick()});
    EXPECT_FALSE(bench.saw<Close>()) << "a point on its way to the disk is not thrown away";
    bench.commit();
    EXPECT_TRUE(bench.the<Close>().complete);
    return bench;
}

TEST(RetakeOrder, IsTakenAfterAnAbortThatCameTooLate) {
    auto bench = aborted_too_late(10);
    ASSERT_TRUE(bench.give(of_target(4)).saw<RecordRetake>()) << refusal_of(bench);
    bench.point(11);
    EXPECT_FALSE(bench.machine.view().closed) << "the abort was of what is over";
    bench.point(12);
    EXPECT_TRUE(bench.machine.view().complete);
}

TEST(RetakeOrder, IsTakenAfterAnAbortDuringTheLastPointOfAnother) {
    auto bench = after(10);
    bench.give(of_target(4)).point(11).trigger(12).window_here();
    bench.give(Abort{"The customer left.", bench.tick()}).commit();
    ASSERT_TRUE(bench.the<Close>().complete);
    EXPECT_TRUE(bench.give(of_target(4)).saw<RecordRetake>()) << refusal_of(bench);
}

/// Its commit has come back, though nobody wants its point any more.
TEST(RetakeOrder, ThatWasNotWrittenDoesNotKeepTheAbortFromClosing) {
    auto bench = after(10);
    bench.give(of_target(4)); // written
    bench.point(11).keeps_orders = false;
    bench.give(of_target(1)).point(12).trigger(13).window_here();
    bench.give(Abort{"The customer left.", bench.tick()});
    bench.give(RevisionLost{bench.tick()}).commit();
    ASSERT_TRUE(bench.saw<Close>());
    EXPECT_TRUE(bench.the<Close>().complete);
}

TEST(RetakeOrder, IsTakenOnceTheDiskIsBackThatFailedUnderTheAbortOfAnother) {
    auto bench = after(10);
    bench.give(of_target(4)).point(11).trigger(12).window_here();
    bench.give(Abort{"The disk is gone.", bench.tick()});
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    ASSERT_TRUE(bench.the<Close>().complete);
    bench.give(DiskBack{disk_with(11), bench.tick()});
    EXPECT_FALSE(bench.saw<CommitPoint>()) << "the run is closed";
    ASSERT_TRUE(bench.give(of_target(1)).saw<RecordRetake>()) << refusal_of(bench);
    bench.trigger(12); // what was not written is still to be taken
    EXPECT_EQ(bench.open_window.expected, 420.0_mm);
}

/// A sync that fails may have written all the same.
TEST(RetakeOrder, CountsOnFromThePointThatTheDiskHeldAfterAll) {
    auto bench = after(10);
    bench.give(of_target(4)).point(11).trigger(12).window_here();
    bench.give(Abort{"The disk is gone.", bench.tick()});
    bench.give(CommitFailed{"Input/output error.", bench.tick()});
    bench.give(DiskBack{disk_with(12), bench.tick()});
    EXPECT_FALSE(bench.saw<Acknowledge>()) << "no run takes requests";
    EXPECT_EQ(bench.machine.view().last_durable, 12);
    ASSERT_TRUE(bench.give(of_target(1)).saw<RecordRetake>()) << refusal_of(bench);
    bench.trigger(13);
    EXPECT_EQ(bench.open_window.expected, 120.0_mm);
}

Exclude one_reading(int target, int approach) {
    Exclude exclude;
    exclude.selection.target = target;
    exclude.selection.direction = Direction::positive;
    exclude.selection.approach = approach;
    exclude.reason = "somebody leaned on the table";
    return exclude;
}

TEST(Exclusion, LeavesAtLeastTwoReadingsOfATargetAndDirection) {
    auto bench = after(30, repeated_setup());
    bench.give(one_reading(2, 1));
    ASSERT_TRUE(bench.saw<RecordExclusion>());
    EXPECT_TRUE(bench.the<RecordExclusion>().reopens);
    EXPECT_EQ(bench.the<RecordExclusion>().exclusions.at(0).step, 12);
    EXPECT_TRUE(bench.machine.view().closed) << "the CNC has nothing to do with it";
    EXPECT_NE(refusal_of(bench.give(one_reading(2, 1))).find("already"), std::string::npos);
    EXPECT_NE(refusal_of(bench.give(one_reading(2, 0))).find("At least two"), std::string::npos);
    EXPECT_EQ(refusal_of(bench.give(one_reading(3, 0))), "accepted");
}

TEST(Exclusion, IsOfTheReadingAndEndsWhenThePointIsTakenAgain) {
    auto bench = after(30, repeated_setup());
    bench.give(one_reading(2, 1));
    Retake again;
    again.selection = one_reading(2, 1).selection;
    again.reason = "once more";
    bench.give(again).point(31);
    EXPECT_EQ(refusal_of(bench.give(one_reading(2, 0))), "accepted")
        << "three readings count again";
}

TEST(Exclusion, ThatWasNotWrittenIsTakenBack) {
    auto bench = after(30, repeated_setup());
    bench.keeps_orders = false;
    bench.give(one_reading(2, 1));
    EXPECT_EQ(bench.machine.view().excluded, 1);
    bench.give(RevisionLost{bench.tick()});
    EXPECT_EQ(bench.machine.view().excluded, 0);
    EXPECT_TRUE(bench.give(one_reading(2, 0)).saw<RecordExclusion>());
}

TEST(Exclusion, ThatWasLostHoldsWhereTheDiskHeldItAfterAll) {
    auto bench = after(30, repeated_setup());
    bench.keeps_orders = false;
    const int step = bench.give(one_reading(2, 1)).the<RecordExclusion>().exclusions.at(0).step;
    bench.give(RevisionLost{bench.tick()});
    RunRevisions orders;
    orders.exclusions.emplace_back().step = step;
    bench.give(disk_with_orders(30, orders, bench.tick()));
    EXPECT_EQ(bench.machine.view().excluded, 1);
    EXPECT_NE(refusal_of(bench.give(one_reading(2, 1))).find("already"), std::string::npos);
    EXPECT_TRUE(bench.machine.view().closed) << "the CNC has nothing to do with it";
}

TEST(Exclusion, IsTakenAfterAnAbortThatCameTooLate) {
    auto bench = aborted_too_late(30, repeated_setup());
    EXPECT_TRUE(bench.give(one_reading(2, 1)).saw<RecordExclusion>()) << refusal_of(bench);
}

TEST(Exclusion, NeedsItsReason) {
    auto bench = after(30, repeated_setup());
    auto silent = one_reading(1, 1);
    silent.reason.clear();
    EXPECT_NE(refusal_of(bench.give(silent)).find("reason"), std::string::npos);
}

} // namespace
} // namespace axiscal::retake_test

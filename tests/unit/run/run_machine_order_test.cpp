#include "bench.hpp"

#include "acquisition/run/sequence.hpp"

#include <gtest/gtest.h>

namespace axiscal::run_machine_order_test {
namespace {

using testing::Bench;
using testing::expect_refused;
using testing::small_setup;

TEST(Sequence, SixtyFiveThousandFiveHundredThirtyFourIsFollowedByOne) {
    EXPECT_EQ(next_sequence(0), 1);
    EXPECT_EQ(next_sequence(1), 2);
    EXPECT_EQ(next_sequence(65534), 1);
}

TEST(Sequence, NamesWhatWentWrongWithTheNumber) {
    EXPECT_EQ(describe_disorder(8, 5),
              "Request 8 came, but request 6 is awaited: requests 6 to 7 were missed.");
    EXPECT_EQ(describe_disorder(7, 5),
              "Request 7 came, but request 6 is awaited: request 6 was missed.");
    EXPECT_EQ(describe_disorder(3, 5), "Request 3 came late: it was finished before, request 6 is "
                                       "awaited (last durable: 5).");
    EXPECT_NE(describe_disorder(1, 5).find("counter was restarted"), std::string::npos);
    EXPECT_NE(describe_disorder(2, 65534).find("request 1 was missed"), std::string::npos);
    EXPECT_NE(describe_disorder(65533, 65534).find("late"), std::string::npos);
    EXPECT_NE(describe_disorder(1, 65533).find("counter was restarted"), std::string::npos);
    EXPECT_NE(describe_disorder(65535, 5).find("no number of a request"), std::string::npos);
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

} // namespace
} // namespace axiscal::run_machine_order_test

#include "acquisition/measurement/circular/circle_order.hpp"

#include <gtest/gtest.h>

namespace axiscal::circle_order_test {
namespace {

TriggerEvent request(std::uint16_t sequence) {
    TriggerEvent event;
    event.sequence = sequence;
    return event;
}

CircleOrder order_of_two() {
    return CircleOrder{CircularPlan{}}; // ccw, cw
}

TEST(CircleOrder, TakesEachCircleOnceAndThenTheEnd) {
    CircleOrder order = order_of_two();
    EXPECT_EQ(order.judge(request(0)).answer, CircleAnswer::ignore);
    const auto first = order.judge(request(1));
    EXPECT_EQ(first.answer, CircleAnswer::begin);
    EXPECT_NE(first.sentence.find("Circle 1 of 2 begins: ccw, repeat 1"), std::string::npos);
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::ignore); // under way
    order.durable();
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::again);
    EXPECT_EQ(order.judge(request(2)).answer, CircleAnswer::begin);
    order.durable();
    EXPECT_EQ(order.begun(), 2);
    EXPECT_EQ(order.judge(request(3)).answer, CircleAnswer::end);
    order.durable();
    EXPECT_EQ(order.begun(), 2);
    EXPECT_EQ(order.judge(request(4)).answer, CircleAnswer::refuse);
}

TEST(CircleOrder, WhatIsOutOfOrderIsRefusedWithBothNumbers) {
    CircleOrder order = order_of_two();
    const auto verdict = order.judge(request(2));
    EXPECT_EQ(verdict.answer, CircleAnswer::refuse);
    EXPECT_NE(verdict.sentence.find("Request 2 came, 1 was expected"), std::string::npos);
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::begin);
}

TriggerEvent command(TriggerCommand what, std::uint16_t sequence) {
    TriggerEvent event = request(sequence);
    event.command = what;
    return event;
}

TEST(CircleOrder, ACommandThatNoCircleHasIsRefusedAndBeginsNone) {
    for (const auto what : {TriggerCommand::prepare, TriggerCommand::skip, TriggerCommand::end}) {
        CircleOrder order = order_of_two();
        const auto verdict = order.judge(command(what, 1));
        EXPECT_EQ(verdict.answer, CircleAnswer::refuse);
        EXPECT_EQ(verdict.fault, Fault::bad_command) << "RESULT 5";
        EXPECT_NE(verdict.sentence.find("only 2, capture"), std::string::npos);
        EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::begin) << "its number is free";
        order.durable();
        EXPECT_EQ(order.judge(command(what, 1)).answer, CircleAnswer::again)
            << "finished, whatever is asked by its number";
    }
}

TEST(CircleOrder, TheLastRequestEndsTheTestByCaptureAlone) {
    CircleOrder order = order_of_two();
    for (const std::uint16_t sequence : {std::uint16_t{1}, std::uint16_t{2}}) {
        EXPECT_EQ(order.judge(request(sequence)).answer, CircleAnswer::begin);
        order.durable();
    }
    EXPECT_EQ(order.judge(command(TriggerCommand::end, 3)).fault, Fault::bad_command);
    EXPECT_EQ(order.judge(request(3)).answer, CircleAnswer::end);
}

TEST(CircleOrder, AfterARestartACommandThatNoCircleHasDoesNotBeginOneAgain) {
    CircleOrder cut{CircularPlan{}, {1, false}};
    EXPECT_EQ(cut.judge(command(TriggerCommand::skip, 1)).fault, Fault::bad_command);
    EXPECT_EQ(cut.judge(request(1)).answer, CircleAnswer::begin);
}

/// A client that connects anew writes what it stands at, also of the program before.
TEST(CircleOrder, WhatStandsThereBeforeTheFirstCircleIsTheBaseline) {
    CircleOrder order = order_of_two();
    for (const auto what : {TriggerCommand::capture, TriggerCommand::abort}) {
        TriggerEvent standing = command(what, 7);
        standing.standing = true;
        EXPECT_EQ(order.judge(standing).answer, CircleAnswer::ignore);
    }
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::begin);
    order.durable();
    TriggerEvent abort = command(TriggerCommand::abort, 7);
    abort.standing = true;
    EXPECT_EQ(order.judge(abort).answer, CircleAnswer::abort);
}

TEST(CircleOrder, ARequestThatDidNotBecomeDurableMayComeAgain) {
    CircleOrder order = order_of_two();
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::begin);
    order.failed();
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::begin);
}

TEST(CircleOrder, AfterARestartACircleThatWasCutIsBegunAgainOrEndsTheTest) {
    CircleOrder cut{CircularPlan{}, {1, false}};
    EXPECT_EQ(cut.last_durable(), 1);
    const auto again = cut.judge(request(1));
    EXPECT_EQ(again.answer, CircleAnswer::begin);
    EXPECT_NE(again.sentence.find("Circle 1 of 2 begins again"), std::string::npos);
    EXPECT_EQ(cut.judge(request(1)).answer, CircleAnswer::ignore); // under way
    EXPECT_TRUE(again.once_more);
    cut.durable();
    EXPECT_EQ(cut.judge(request(1)).answer, CircleAnswer::again);
    cut.circle_seen();
    EXPECT_EQ(cut.judge(request(2)).answer, CircleAnswer::begin);
    CircleOrder driven{CircularPlan{}, {1, false}};
    const auto broken = driven.judge(request(2));
    EXPECT_EQ(broken.answer, CircleAnswer::broken);
    EXPECT_NE(broken.sentence.find("while the station was away"), std::string::npos);
    CircleOrder by_hand{CircularPlan{}, {1, false}};
    TriggerEvent press;
    press.origin = TriggerOrigin::manual;
    EXPECT_EQ(by_hand.judge(press).sequence, 1);
}

TEST(CircleOrder, AfterARestartTheNextCircleFollowsAWholeOne) {
    CircleOrder order{CircularPlan{}, {1, true}};
    EXPECT_EQ(order.judge(request(2)).answer, CircleAnswer::begin);
    order.durable();
    EXPECT_EQ(order.judge(request(3)).answer, CircleAnswer::end);
    CircleOrder fresh{CircularPlan{}, {0, false}};
    EXPECT_EQ(fresh.judge(request(1)).answer, CircleAnswer::begin);
}

/// A CNC that drives the circle still stands at its request, as one does that waits.
TEST(CircleOrder, AfterARestartACircleThatNobodySawDrivenAgainEndsTheTest) {
    for (const std::uint16_t last : {std::uint16_t{1}, std::uint16_t{2}}) {
        CircleOrder order{CircularPlan{}, {last, false}};
        EXPECT_EQ(order.judge(request(last)).answer, CircleAnswer::begin);
        order.durable();
        const auto verdict = order.judge(request(static_cast<std::uint16_t>(last + 1)));
        EXPECT_EQ(verdict.answer, CircleAnswer::broken);
        EXPECT_NE(verdict.sentence.find("Circle " + std::to_string(last) + " was driven while"),
                  std::string::npos);
    }
}

/// A client that connects anew writes what it stood at, and a moment later what it stands at.
TEST(CircleOrder, AfterARestartANextRequestThatDoesNotWaitForTheFirstEndsTheTest) {
    CircleOrder order{CircularPlan{}, {1, false}};
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::begin); // not durable yet
    EXPECT_EQ(order.judge(request(2)).answer, CircleAnswer::broken);
    CircleOrder undisturbed = order_of_two();
    EXPECT_EQ(undisturbed.judge(request(1)).answer, CircleAnswer::begin);
    EXPECT_EQ(undisturbed.judge(request(2)).answer, CircleAnswer::refuse);
}

TEST(CircleOrder, AfterARestartAWholeCircleIsNotBegunAgainWhereTheCncStandsAtIt) {
    CircleOrder order{CircularPlan{}, {1, true}};
    EXPECT_EQ(order.judge(request(1)).answer, CircleAnswer::again) << "it hears that it was taken";
    EXPECT_EQ(order.judge(request(2)).answer, CircleAnswer::begin);
}

TEST(CircleOrder, ByTriggerBothEndsOfEachArcAreWords) {
    CircularPlan plan;
    plan.start = StartMethod::trigger;
    CircleOrder order{plan};
    const char* told[] = {"Circle 1 of 2 begins: ccw",   "The arc of circle 1 begins.",
                          "The arc of circle 1 ends.",   "Circle 2 of 2 begins: cw",
                          "The arc of circle 2 begins.", "The arc of circle 2 ends."};
    for (std::uint16_t sequence = 1; sequence <= 6; ++sequence) {
        const auto verdict = order.judge(request(sequence));
        EXPECT_EQ(verdict.answer, CircleAnswer::begin);
        EXPECT_NE(verdict.sentence.find(told[sequence - 1]), std::string::npos);
        order.durable();
        EXPECT_EQ(order.begun(), sequence <= 3 ? 1 : 2);
    }
    EXPECT_EQ(order.judge(request(7)).answer, CircleAnswer::end);
    order.durable();
    EXPECT_EQ(order.begun(), 2);
    CircleOrder cut{plan, {5, false}};                            // died within the arc of circle 2
    EXPECT_EQ(cut.judge(request(5)).answer, CircleAnswer::again); // it stands there still
    EXPECT_EQ(cut.judge(request(7)).answer, CircleAnswer::broken);
    const auto again = cut.judge(request(4)); // a person began it again
    EXPECT_EQ(again.answer, CircleAnswer::begin);
    EXPECT_FALSE(again.once_more) << "its words tell whether it was driven";
    cut.durable();
    EXPECT_EQ(cut.judge(request(5)).answer, CircleAnswer::begin);
}

TEST(CircleOrder, APersonStepsThroughWithoutNumbersAndDwellsMeanNothing) {
    CircleOrder order = order_of_two();
    TriggerEvent dwell = request(1);
    dwell.origin = TriggerOrigin::dwell;
    EXPECT_EQ(order.judge(dwell).answer, CircleAnswer::ignore);
    TriggerEvent press;
    press.origin = TriggerOrigin::manual;
    for (const std::uint16_t sequence : {std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{3}}) {
        EXPECT_EQ(order.judge(press).sequence, sequence);
        order.durable();
    }
    TriggerEvent abort = request(9);
    abort.command = TriggerCommand::abort;
    EXPECT_EQ(order.judge(abort).answer, CircleAnswer::abort);
}

} // namespace
} // namespace axiscal::circle_order_test

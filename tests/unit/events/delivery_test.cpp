// Deliveries to a receiver that is a function, by a clock and a chance that the test turns.

#include "acquisition/events/delivery.hpp"
#include "acquisition/events/event_folder.hpp"
#include "tests/support/scratch_folder.hpp"

#include <chrono>
#include <deque>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace axiscal::delivery_test {
namespace {

using namespace std::chrono_literals;

class DeliveryTest : public ::testing::Test {
protected:
    DeliveryTest() { EXPECT_TRUE(open_events(state_.path(), {"bay 3", true, true})); }

    std::string lay(const std::string& run) {
        StationEvent event;
        event.about = StationEvent::About::fault;
        event.run_id = run;
        event.fault = Fault::beam_lost;
        EXPECT_TRUE(lay_event(state_.path(), event).value_or(false));
        return event_id(event);
    }

    EventDelivery make() {
        return EventDelivery{state_.path(),
                             {WebhookKey(32, 'k')},
                             {[this](const WebhookPost& post) {
                                  posts_.push_back(post);
                                  if (answers_.empty()) return WebhookAnswer{204, "", {}};
                                  const WebhookAnswer answer = answers_.front();
                                  answers_.pop_front();
                                  return answer;
                              },
                              [this] { return utc_s_; }, [this] { return chance_; },
                              [this] { return posts_.size() < most_posts_; }}};
    }

    testing::ScratchFolder state_;
    std::deque<WebhookAnswer> answers_; ///< then 204
    std::vector<WebhookPost> posts_;
    std::size_t most_posts_ = 1000; ///< then it is asked to end
    std::int64_t utc_s_ = 1'800'000'000;
    double chance_ = 0;
};

TEST_F(DeliveryTest, BringsTheOldestFirstAndEachOnce) {
    const std::string first = lay("a"), second = lay("b");
    EventDelivery delivery = make();
    EXPECT_EQ(delivery.pass(), 0U);
    EXPECT_EQ(delivery.pass(), 0U);
    ASSERT_EQ(posts_.size(), 2U);
    EXPECT_EQ(posts_[0].id, first);
    EXPECT_EQ(posts_[1].id, second);
    EXPECT_EQ(delivery.delivered(), 2U);
    EXPECT_EQ(delivery.trouble(), "");
}

TEST_F(DeliveryTest, SignsEachAttemptAnewUnderTheSameName) {
    lay("a");
    answers_ = {{500, "", {}}};
    EventDelivery delivery = make();
    EXPECT_EQ(delivery.pass(), 1U);
    utc_s_ += 400;
    EXPECT_EQ(delivery.pass(), 0U);
    ASSERT_EQ(posts_.size(), 2U);
    EXPECT_EQ(posts_[0].id, posts_[1].id);
    EXPECT_EQ(posts_[0].body, posts_[1].body);
    EXPECT_EQ(posts_[1].utc_s, utc_s_);
    EXPECT_NE(posts_[0].signatures, posts_[1].signatures);
}

TEST_F(DeliveryTest, OneThatIsRefusedHoldsUpNoOther) {
    const std::string refused = lay("a");
    lay("b");
    answers_ = {{400, "", {}}};
    EventDelivery delivery = make();
    EXPECT_EQ(delivery.pass(), 1U);
    EXPECT_EQ(waiting_events(state_.path()), std::vector<std::string>{refused});
    EXPECT_NE(delivery.trouble().find("400"), std::string::npos);
    EXPECT_EQ(event_trouble(state_.path()), delivery.trouble());
}

TEST_F(DeliveryTest, ARedirectIsARefusal) {
    lay("a");
    answers_ = {{301, "", {}}};
    EXPECT_EQ(make().pass(), 1U);
}

TEST_F(DeliveryTest, WithoutAnAnswerTheOthersAreNotTried) {
    lay("a");
    lay("b");
    answers_ = {{0, "connection refused", {}}};
    EXPECT_EQ(make().pass(), 2U);
    EXPECT_EQ(posts_.size(), 1U);
}

TEST_F(DeliveryTest, PausesGrowToFiveMinutesAndBeginAnewWithADelivery) {
    lay("a");
    EventDelivery delivery = make();
    for (const Duration wanted :
         {Duration{5s}, Duration{30s}, Duration{2min}, Duration{5min}, Duration{5min}}) {
        answers_ = {{0, "away", {}}};
        EXPECT_EQ(delivery.pass(), 1U);
        EXPECT_EQ(delivery.pause(), wanted);
    }
    lay("b");
    answers_ = {{204, "", {}}, {500, "", {}}};
    EXPECT_EQ(delivery.pass(), 1U);
    EXPECT_EQ(delivery.pause(), Duration{5s});
}

TEST_F(DeliveryTest, ChanceAddsUpToAFifth) {
    lay("a");
    answers_ = {{500, "", {}}};
    EventDelivery delivery = make();
    delivery.pass();
    chance_ = 0.5;
    EXPECT_EQ(delivery.pause(), Duration{5500ms});
}

TEST_F(DeliveryTest, ObeysAReceiverThatAsksForTimeUpToAnHour) {
    lay("a");
    lay("b");
    answers_ = {{503, "", Duration{10min}}, {429, "", Duration{24h}}};
    EventDelivery delivery = make();
    EXPECT_EQ(delivery.pass(), 2U);
    EXPECT_EQ(posts_.size(), 1U);
    EXPECT_EQ(delivery.pause(), Duration{10min});
    delivery.pass();
    EXPECT_EQ(delivery.pause(), Duration{1h});
}

TEST_F(DeliveryTest, EndsBetweenTwoAttemptsWhenAsked) {
    lay("a");
    lay("b");
    most_posts_ = 1;
    EXPECT_EQ(make().pass(), 1U);
    EXPECT_EQ(posts_.size(), 1U);
}

TEST_F(DeliveryTest, WhatCannotBeReadIsToldAndHoldsUpNoOther) {
    std::filesystem::create_directories(state_.file("events/waiting/evt_folder.json"));
    lay("a");
    EventDelivery delivery = make();
    EXPECT_EQ(delivery.pass(), 1U);
    EXPECT_EQ(delivery.delivered(), 1U);
    EXPECT_NE(delivery.trouble(), "");
}

TEST_F(DeliveryTest, AnotherSenderGoesOnWithWhatWaits) {
    const std::string id = lay("a");
    answers_ = {{500, "", {}}};
    make().pass();
    EXPECT_EQ(make().pass(), 0U);
    EXPECT_EQ(posts_.back().id, id);
}

} // namespace
} // namespace axiscal::delivery_test

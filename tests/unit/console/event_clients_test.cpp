#include "acquisition/console/event_clients.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal::event_clients_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class Listening : public ::testing::Test {
protected:
    /// Sends what may be sent now, and lets the client take it at once.
    std::optional<EventTopic> send(std::size_t place) {
        const auto turn = clients.turn(place, now);
        if (!turn.topic) return std::nullopt;
        clients.hand_over(place, *turn.topic, now);
        clients.taken(place);
        return turn.topic;
    }

    EventClients clients;
    MonotonicTime now = monotonic_from_ns(1'000'000'000);
};

TEST_F(Listening, StatusAndPointsAreNewToWhoEnters) {
    const std::size_t place = clients.enter(0).value();
    EXPECT_EQ(send(place), EventTopic::status);
    now += EventClients::pace;
    EXPECT_EQ(send(place), EventTopic::points);
    now += EventClients::pace;
    EXPECT_EQ(send(place), std::nullopt);
    EXPECT_FALSE(clients.turn(place, now).at) << "it waits for news, not for a time";
}

TEST_F(Listening, AClientGetsTwentyFramesASecondAtMost) {
    const std::size_t place = clients.enter(200).value();
    int sent = 0;
    for (const MonotonicTime end = now + seconds{10}; now < end; now += milliseconds{1}) {
        clients.news(EventTopic::status);
        clients.news_of_stream(200);
        if (send(place)) ++sent;
    }
    EXPECT_EQ(sent, 200);
}

TEST_F(Listening, WhoIsTooEarlyIsToldWhenToComeAgain) {
    const std::size_t place = clients.enter(0).value();
    send(place);
    const MonotonicTime first = now;
    now += milliseconds{20};
    const auto turn = clients.turn(place, now);
    EXPECT_FALSE(turn.topic);
    EXPECT_EQ(turn.at, first + EventClients::pace);
}

TEST_F(Listening, NothingIsQueuedForASlowClient) {
    const std::size_t place = clients.enter(0).value();
    clients.hand_over(place, EventTopic::status, now);
    for (int news = 0; news < 100; ++news) {
        now += milliseconds{200};
        clients.news(EventTopic::status);
        EXPECT_FALSE(clients.turn(place, now).topic) << "one is under way";
    }
    clients.taken(place);
    std::vector<EventTopic> got;
    for (; const auto topic = send(place); now += EventClients::pace)
        got.push_back(*topic);
    EXPECT_EQ(got, (std::vector{EventTopic::points, EventTopic::status}));
}

TEST_F(Listening, NoTopicKeepsAnotherFromASlowClient) {
    const std::size_t place = clients.enter(200).value();
    std::array<int, 4> got{};
    for (int turn = 0; turn < 400; ++turn, now += seconds{1}) {
        for (const auto topic : {EventTopic::status, EventTopic::points, EventTopic::heartbeat})
            clients.news(topic);
        clients.news_of_stream(200);
        ++got[static_cast<std::size_t>(send(place).value())];
    }
    for (const int times : got)
        EXPECT_EQ(times, 100);
}

TEST_F(Listening, TheStreamGoesToThoseAloneWhoAskedForThatManyStretches) {
    const std::size_t none = clients.enter(0).value(), few = clients.enter(10).value(),
                      many = clients.enter(200).value();
    for (const std::size_t place : {none, few, many}) {
        for (; send(place); now += EventClients::pace) {
        }
    }
    EXPECT_EQ(clients.stretches(), (std::set<std::size_t>{10, 200}));
    clients.news_of_stream(10);
    EXPECT_EQ(clients.waiting(), std::vector{few});
}

TEST_F(Listening, ThirtyTwoPlacesAndNoMore) {
    for (std::size_t nth = 0; nth < 32; ++nth)
        EXPECT_TRUE(clients.enter(0)) << nth;
    EXPECT_FALSE(clients.enter(0));
    clients.leave(7);
    EXPECT_EQ(clients.enter(0), 7U);
}

TEST_F(Listening, WhoDoesNotTakeAFrameForHalfAMinuteIsOverdue) {
    const std::size_t reads = clients.enter(0).value(), sleeps = clients.enter(0).value();
    send(reads);
    clients.hand_over(sleeps, EventTopic::status, now);
    EXPECT_TRUE(clients.overdue(now + seconds{30}).empty());
    EXPECT_EQ(clients.overdue(now + seconds{31}), std::vector{sleeps});
    clients.taken(sleeps);
    EXPECT_TRUE(clients.overdue(now + seconds{31}).empty());
}

} // namespace
} // namespace axiscal::event_clients_test

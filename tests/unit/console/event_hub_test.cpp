// The events in virtual time, over pairs of sockets.
#include "acquisition/console/event_hub.hpp"

#include "drivers/loop/spawn.hpp"
#include "drivers/loop/virtual_scheduler.hpp"
#include "tests/unit/console/shown_station.hpp"

#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <memory>
#include <optional>

namespace axiscal::event_hub_test {
namespace {

namespace asio = boost::asio;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Events : public ::testing::Test {
protected:
    using Pipe = asio::local::stream_protocol::socket;
    struct Client {
        std::unique_ptr<Pipe> pipe;
        std::string heard;
        bool ended = false;
    };

    ~Events() override {
        hub->end();
        scheduler.run_for(seconds{1});
    }

    Client connect(const EventsAsked& asked = {}) {
        Client client{std::make_unique<Pipe>(scheduler.loop()), {}, false};
        Pipe other{scheduler.loop()};
        asio::local::connect_pair(*client.pipe, other);
        client.pipe->non_blocking(true);
        auto seat = hub->take_seat(asked);
        EXPECT_TRUE(seat);
        if (seat) spawn(scheduler, hub->serve(std::move(other), *std::move(seat)));
        return client;
    }

    static void read(Client& client) {
        std::array<char, 4096> bytes{};
        boost::system::error_code error;
        while (!error) {
            const std::size_t got = client.pipe->read_some(asio::buffer(bytes), error);
            client.heard.append(bytes.data(), got);
        }
        client.ended = error != asio::error::would_block;
    }

    /// Every client reads at each millisecond.
    void listen(Duration span, std::initializer_list<Client*> clients) {
        for (const MonotonicTime end = scheduler.now() + span; scheduler.now() < end;) {
            scheduler.run_for(milliseconds{1});
            for (Client* const client : clients)
                read(*client);
        }
    }

    static std::vector<nlohmann::json> events(const Client& client, const std::string& name) {
        std::vector<nlohmann::json> found;
        const std::string head = "event: " + name + "\n";
        for (std::size_t at = client.heard.find(head); at != std::string::npos;
             at = client.heard.find(head, at + 1)) {
            const std::size_t data = client.heard.find("data: ", at) + 6;
            found.push_back(nlohmann::json::parse(
                client.heard.substr(data, client.heard.find('\n', data) - data)));
        }
        return found;
    }

    static std::size_t frames(const Client& client) {
        std::size_t number = 0;
        for (std::size_t at = client.heard.find("event: "); at != std::string::npos;
             at = client.heard.find("event: ", at + 1))
            ++number;
        return number;
    }

    static std::optional<PointsId> last_id(const Client& client) {
        const std::size_t at = client.heard.rfind("\nid: ") + 5;
        return points_id_of(client.heard.substr(at, client.heard.find('\n', at) - at));
    }

    VirtualScheduler scheduler;
    testing::ShownStation station;
    std::shared_ptr<EventHub> hub =
        std::make_shared<EventHub>(scheduler, station, [this] { return station.status(); });
};

TEST_F(Events, TheFirstStatusComesAtOnceBehindTheHead) {
    station.shown.station = "bench";
    Client client = connect();
    listen(milliseconds{1}, {&client});
    EXPECT_TRUE(client.heard.starts_with("HTTP/1.1 200")) << client.heard;
    EXPECT_NE(client.heard.find("Content-Type: text/event-stream"), std::string::npos);
    const auto shown = events(client, "status");
    ASSERT_EQ(shown.size(), 1U);
    EXPECT_EQ(shown.front().at("station"), "bench");
}

TEST_F(Events, AStatusComesWhenItChangedAndFiveTimesASecondAtMost) {
    Client client = connect();
    listen(seconds{10}, {&client});
    EXPECT_EQ(events(client, "status").size(), 1U);
    station.shown_change_each_time = true;
    listen(seconds{10}, {&client});
    EXPECT_GE(events(client, "status").size(), 49U);
    EXPECT_LE(events(client, "status").size(), 52U);
}

TEST_F(Events, AHeartbeatComesEachSecondAndIsCounted) {
    Client client = connect();
    listen(milliseconds{10'500}, {&client});
    const auto beats = events(client, "heartbeat");
    ASSERT_EQ(beats.size(), 10U);
    EXPECT_EQ(beats.front().at("count"), 1);
    EXPECT_EQ(beats.back().at("count"), 10);
    EXPECT_EQ(beats.back().at("utc").get<std::string>().size(), 20U);
}

TEST_F(Events, TheStreamComesTwentyTimesASecondAtMostTheOthersIncluded) {
    station.shown_change_each_time = true;
    station.streamed.emplace();
    Client client = connect({20, {}});
    listen(seconds{10}, {&client});
    EXPECT_LE(frames(client), 201U);
    EXPECT_GE(frames(client), 180U);
    EXPECT_GE(events(client, "heartbeat").size(), 9U) << "the stream keeps nothing else away";
    EXPECT_GE(events(client, "status").size(), 40U);
    EXPECT_EQ(events(client, "stream").back().at("low").size(), 20U);
}

TEST_F(Events, WhoDoesNotAskForTheStreamGetsNone) {
    station.streamed.emplace();
    Client client = connect();
    listen(seconds{2}, {&client});
    EXPECT_TRUE(events(client, "stream").empty());
    EXPECT_EQ(station.stream_looks, 0);
}

TEST_F(Events, TheStationIsLookedAtOnceForAllClients) {
    Client first = connect({20, {}}), second = connect({20, {}}), third = connect({20, {}});
    listen(seconds{10}, {&first, &second, &third});
    EXPECT_LE(station.looks, 52);
    EXPECT_LE(station.stream_looks, 203);
}

TEST_F(Events, NobodyWakesTheLoopOnceEverybodyHasGone) {
    std::optional<Client> client = connect();
    listen(seconds{2}, {&*client});
    client.reset();
    scheduler.run_for(seconds{5});
    const auto wakeups = scheduler.wakeups();
    const int looks = station.looks;
    scheduler.run_for(seconds{600});
    EXPECT_EQ(scheduler.wakeups(), wakeups);
    EXPECT_EQ(station.looks, looks);
    Client later = connect();
    listen(milliseconds{1}, {&later});
    EXPECT_EQ(events(later, "status").size(), 1U);
}

TEST_F(Events, WhoNeverReadsHoldsNothingUpAndIsHungUpOn) {
    station.shown_change_each_time = true;
    Client sleeper = connect(), reader = connect();
    listen(seconds{25}, {&reader});
    read(sleeper);
    EXPECT_FALSE(sleeper.ended);
    sleeper.heard.clear();
    listen(seconds{60}, {&reader});
    EXPECT_GE(events(reader, "heartbeat").size(), 84U);
    read(sleeper);
    EXPECT_TRUE(sleeper.ended);
}

TEST_F(Events, ASlowReaderGetsTheNewestStateAndNoQueue) {
    station.shown_change_each_time = true;
    Client client = connect();
    scheduler.run_for(seconds{20});
    read(client);
    client.heard.clear();
    listen(milliseconds{500}, {&client});
    const auto shown = events(client, "status");
    ASSERT_GE(shown.size(), 2U);
    EXPECT_GE(std::stoi(shown.back().at("utc").get<std::string>()), station.looks - 2);
    EXPECT_LE(shown.size(), 10U);
}

TEST_F(Events, PointsComeAsTheyBecomeDurableWithAnIdThatCountsThem) {
    station.run = "bench-1";
    station.accept(0, 1.5);
    Client client = connect();
    listen(milliseconds{300}, {&client});
    station.accept(1, -2.5);
    listen(milliseconds{300}, {&client});
    const auto shown = events(client, "points");
    ASSERT_EQ(shown.size(), 2U);
    EXPECT_EQ(shown.at(0).at("run"), "bench-1");
    EXPECT_EQ(shown.at(0).at("from"), 0);
    EXPECT_EQ(shown.at(1).at("from"), 1);
    EXPECT_EQ(shown.at(1).at("count"), 2);
    const auto& point = shown.at(1).at("points").at(0);
    EXPECT_EQ(point.at("step"), 1);
    EXPECT_EQ(point.at("target"), 1);
    EXPECT_EQ(point.at("direction"), "positive");
    EXPECT_EQ(point.at("approach"), 0);
    EXPECT_EQ(point.at("sequence"), 2);
    EXPECT_NEAR(point.at("nominal_mm").get<double>(), 100, 1e-9);
    EXPECT_EQ(point.at("excluded"), false);
    EXPECT_NEAR(point.at("deviation_um").get<double>(), -2.5, 1e-9);
    ASSERT_TRUE(last_id(client));
    EXPECT_EQ(last_id(client)->points, 2U);
}

TEST_F(Events, WhoComesBackGetsThePointsThatItMissed) {
    station.run = "bench-1";
    station.accept(0, 1);
    station.accept(1, 1);
    Client before = connect();
    listen(milliseconds{300}, {&before});
    const auto has = last_id(before);
    ASSERT_TRUE(has);
    Client same = connect({0, has});
    listen(milliseconds{300}, {&same});
    EXPECT_TRUE(events(same, "points").empty()) << "it missed none";
    station.accept(2, 1);
    Client behind = connect({0, has});
    listen(milliseconds{300}, {&behind});
    ASSERT_EQ(events(behind, "points").size(), 1U);
    EXPECT_EQ(events(behind, "points").front().at("from"), 2);
    EXPECT_EQ(events(behind, "points").front().at("points").size(), 1U);
}

TEST_F(Events, AnIdOfAnotherRunOrAnotherDaemonBringsAllPoints) {
    station.run = "bench-1";
    station.accept(0, 1);
    Client before = connect();
    listen(milliseconds{300}, {&before});
    const PointsId old = last_id(before).value();
    station.run = "bench-2";
    station.accept(1, 1);
    Client of_old_run = connect({0, old});
    Client of_other_daemon = connect({0, PointsId{old.daemon + 1, old.run + 1, 2}});
    Client ahead = connect({0, PointsId{old.daemon, old.run + 1, 7}});
    listen(milliseconds{300}, {&before, &of_old_run, &of_other_daemon, &ahead});
    for (const Client* client : {&of_old_run, &of_other_daemon, &ahead}) {
        ASSERT_EQ(events(*client, "points").size(), 1U);
        EXPECT_EQ(events(*client, "points").front().at("from"), 0);
        EXPECT_EQ(events(*client, "points").front().at("run"), "bench-2");
        EXPECT_EQ(events(*client, "points").front().at("points").size(), 2U);
    }
    EXPECT_EQ(events(before, "points").back().at("from"), 0);
}

TEST_F(Events, AnExclusionSendsAllPointsAnewAndNoIdOfBeforeHolds) {
    station.run = "bench-1";
    for (const int target : {0, 1, 2})
        station.accept(target, 1);
    Client before = connect(), gone = connect();
    listen(milliseconds{300}, {&before, &gone});
    const auto has = last_id(gone);
    ASSERT_TRUE(has);
    station.exclude(1);
    listen(milliseconds{300}, {&before});
    const auto shown = events(before, "points");
    ASSERT_EQ(shown.size(), 2U);
    EXPECT_EQ(shown.back().at("run"), "bench-1");
    EXPECT_EQ(shown.back().at("from"), 0);
    EXPECT_EQ(shown.back().at("count"), 3);
    ASSERT_EQ(shown.back().at("points").size(), 3U);
    EXPECT_EQ(shown.back().at("points").at(1).at("excluded"), true);
    EXPECT_EQ(shown.back().at("points").at(2).at("excluded"), false);
    EXPECT_NE(last_id(before)->run, has->run);
    Client back = connect({0, has});
    Client knows = connect({0, last_id(before)});
    listen(milliseconds{300}, {&back, &knows});
    ASSERT_EQ(events(back, "points").size(), 1U) << "as many points, but no longer the same";
    EXPECT_EQ(events(back, "points").front().at("from"), 0);
    EXPECT_TRUE(events(knows, "points").empty()) << "it has heard of it";
}

TEST_F(Events, APointAfterAnExclusionComesAlone) {
    station.run = "bench-1";
    for (const int target : {0, 1, 2})
        station.accept(target, 1);
    Client client = connect();
    listen(milliseconds{300}, {&client});
    station.exclude(0);
    listen(milliseconds{300}, {&client});
    station.accept(3, 1);
    listen(milliseconds{300}, {&client});
    const auto shown = events(client, "points");
    ASSERT_EQ(shown.size(), 3U);
    EXPECT_EQ(shown.back().at("from"), 3);
    EXPECT_EQ(shown.back().at("points").size(), 1U);
}

TEST_F(Events, TheTargetsOfThePlanComeBeforeTheFirstPointAndNotAgain) {
    station.run = "bench-1";
    station.targets = {mm(0), mm(100.5)};
    Client client = connect();
    listen(milliseconds{300}, {&client});
    for (const int target : {0, 1}) {
        station.accept(target, 1);
        listen(milliseconds{300}, {&client});
    }
    const auto shown = events(client, "points");
    ASSERT_EQ(shown.size(), 3U);
    EXPECT_EQ(shown.at(0).at("count"), 0);
    ASSERT_EQ(shown.at(0).at("target_nominals_mm").size(), 2U);
    EXPECT_NEAR(shown.at(0).at("target_nominals_mm").at(1).get<double>(), 100.5, 1e-9);
    EXPECT_EQ(shown.at(2).at("from"), 1);
    EXPECT_FALSE(shown.at(2).contains("target_nominals_mm"));
}

TEST_F(Events, OnlyTheTargetsOfPointsThatAreSentComeWithTheirMeans) {
    station.run = "bench-1";
    FiguresSoFar so_far;
    so_far.targets.resize(3);
    so_far.targets[0].positive = {1, 1.5, {}, {}};
    so_far.targets[2].positive = {2, -2.5, -3.0, -2.0};
    station.so_far = std::make_shared<const FiguresSoFar>(so_far);
    station.accept(0, 1.5);
    Client client = connect();
    listen(milliseconds{300}, {&client});
    station.accept(2, -2.5);
    listen(milliseconds{300}, {&client});
    const auto shown = events(client, "points");
    ASSERT_EQ(shown.size(), 2U);
    ASSERT_EQ(shown.at(0).at("targets").size(), 1U);
    EXPECT_EQ(shown.at(0).at("targets").at(0).at("target"), 0);
    EXPECT_TRUE(shown.at(0).at("targets").at(0).at("positive").at("low_um").is_null());
    ASSERT_EQ(shown.at(1).at("targets").size(), 1U);
    const auto& row = shown.at(1).at("targets").at(0);
    EXPECT_EQ(row.at("target"), 2);
    EXPECT_EQ(row.at("positive").at("points"), 2);
    EXPECT_EQ(row.at("positive").at("mean_um"), -2.5);
    EXPECT_EQ(row.at("positive").at("low_um"), -3.0);
    EXPECT_EQ(row.at("positive").at("high_um"), -2.0);
    EXPECT_EQ(row.at("negative").at("points"), 0);
}

TEST_F(Events, WithoutARunThePointsAreNoneAndSaySo) {
    Client client = connect();
    listen(milliseconds{300}, {&client});
    ASSERT_EQ(events(client, "points").size(), 1U);
    EXPECT_TRUE(events(client, "points").front().at("run").is_null());
    EXPECT_EQ(events(client, "points").front().at("count"), 0);
}

TEST_F(Events, TheEndHangsUpOnEverybodyAtOnceAndTakesNobodyMore) {
    Client first = connect(), second = connect({20, {}});
    listen(seconds{1}, {&first, &second});
    hub->end();
    scheduler.run_for(milliseconds{1});
    read(first);
    read(second);
    EXPECT_TRUE(first.ended);
    EXPECT_TRUE(second.ended);
    const auto seat = hub->take_seat({});
    ASSERT_FALSE(seat);
    EXPECT_NE(seat.error().detail.find("about to end"), std::string::npos);
}

} // namespace
} // namespace axiscal::event_hub_test

// GET /v1/events through the doors of the server, over real sockets.
#include "acquisition/console/http_server.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "tests/unit/console/shown_station.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <future>
#include <memory>
#include <sys/socket.h>
#include <thread>
#include <vector>

namespace axiscal::events_door_test {
namespace {

namespace asio = boost::asio;

class EventsDoor : public ::testing::Test {
protected:
    using Socket = asio::ip::tcp::socket;

    void SetUp() override {
        ConsoleConfig config;
        config.socket_path.clear();
        config.group.clear();
        config.port = -1;
        station.shown.station = "bench";
        server = std::make_unique<HttpServer>(scheduler, station, config, std::string(64, 't'));
        const auto started = server->start();
        ASSERT_TRUE(started) << describe(started.error());
        runner = std::jthread{[this] { loop.run(); }};
    }
    void TearDown() override {
        work.reset();
        loop.stop();
        runner.join();
        server.reset();
    }

    /// Has sent its request.
    std::unique_ptr<Socket> ask(const std::string& method,
                                const std::string& target,
                                const std::string& more = {},
                                const std::string& host = "localhost") {
        auto socket = std::make_unique<Socket>(own);
        socket->connect(
            {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
        timeval limit{10, 0}; // only bounds a failing test
        ::setsockopt(socket->native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        const std::string named =
            host == "localhost" ? host + ":" + std::to_string(server->port()) : host;
        asio::write(*socket, asio::buffer(method + " " + target + " HTTP/1.1\r\nHost: " + named +
                                          "\r\n" + more + "\r\n"));
        return socket;
    }
    /// What comes until `text` has come, or the connection ends.
    static std::string until(Socket& socket, const std::string& text) {
        std::string heard;
        std::array<char, 4096> bytes{};
        boost::system::error_code error;
        while (!error && heard.find(text) == std::string::npos)
            heard.append(bytes.data(), socket.read_some(asio::buffer(bytes), error));
        return heard;
    }
    std::string whole(const std::string& method,
                      const std::string& target,
                      const std::string& more = {},
                      const std::string& host = "localhost") {
        const auto socket = ask(method, target, "Connection: close\r\n" + more, host);
        return until(*socket, "\n\n\n never");
    }
    template <class Action> void on_loop(Action action) {
        std::promise<void> done;
        asio::post(loop, [&] {
            action();
            done.set_value();
        });
        done.get_future().get();
    }

    asio::io_context loop{1}, own;
    asio::executor_work_guard<asio::io_context::executor_type> work{loop.get_executor()};
    AsioScheduler scheduler{loop};
    testing::ShownStation station;
    std::unique_ptr<HttpServer> server;
    std::jthread runner;
};

TEST_F(EventsDoor, TheFirstEventIsTheStatusAndAHeartbeatFollows) {
    const auto socket = ask("GET", "/v1/events");
    const std::string heard = until(*socket, "event: heartbeat\n");
    EXPECT_TRUE(heard.starts_with("HTTP/1.1 200")) << heard;
    const std::size_t first = heard.find("event: ");
    EXPECT_EQ(heard.find("event: status\ndata: {\"protocol\":\"axiscal/1\",\"station\":\"bench\""),
              first);
}

TEST_F(EventsDoor, TheStatusIsTheOneThatIsRead) {
    const auto socket = ask("GET", "/v1/events/");
    until(*socket, "event: status\ndata: ");
    const std::string read = whole("GET", "/v1/status");
    const auto shown = nlohmann::json::parse(read.substr(read.find("\r\n\r\n")));
    const auto again = ask("GET", "/v1/events");
    const std::string heard = until(*again, "}\n\n");
    const std::size_t data = heard.find("data: ") + 6;
    EXPECT_EQ(nlohmann::json::parse(heard.substr(data, heard.find('\n', data) - data)), shown);
}

TEST_F(EventsDoor, TheThirtyThirdIsToldWhatToDoAndTakesTheFirstPlaceThatIsFree) {
    std::vector<std::unique_ptr<Socket>> crowd;
    for (int nth = 0; nth < 32; ++nth) {
        crowd.push_back(ask("GET", "/v1/events"));
        ASSERT_NE(until(*crowd.back(), "event: status").find("event: status"), std::string::npos);
    }
    const std::string refused = whole("GET", "/v1/events");
    EXPECT_TRUE(refused.starts_with("HTTP/1.1 503")) << refused;
    const auto error = nlohmann::json::parse(refused.substr(refused.find("\r\n\r\n"))).at("error");
    EXPECT_EQ(error.at("fault"), "busy");
    EXPECT_NE(error.at("sentence").get<std::string>().find("32 places"), std::string::npos);
    EXPECT_TRUE(whole("GET", "/v1/status").starts_with("HTTP/1.1 200"));
    crowd.pop_back();
    std::string answer; // a second of the daemon's; the test's own time limit ends a failure
    do {
        const auto again = ask("GET", "/v1/events", "Connection: close\r\n");
        answer = until(*again, "\r\n");
    } while (answer.starts_with("HTTP/1.1 503"));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
}

TEST_F(EventsDoor, WhoListensTakesNoPlaceOfARequest) {
    std::vector<std::unique_ptr<Socket>> listeners, crowd;
    for (int nth = 0; nth < 32; ++nth) {
        listeners.push_back(ask("GET", "/v1/events"));
        until(*listeners.back(), "event: status");
    }
    for (int nth = 0; nth < 63; ++nth) {
        crowd.push_back(ask("GET", "/v1/status"));
        until(*crowd.back(), "\r\n\r\n");
    }
    EXPECT_TRUE(whole("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

TEST_F(EventsDoor, TheRightsAreThoseOfEveryRead) {
    EXPECT_TRUE(whole("GET", "/v1/events", "", "rebound.example").starts_with("HTTP/1.1 421"));
    EXPECT_TRUE(
        whole("GET", "/v1/events", "Origin: http://evil.example\r\n").starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(whole("POST", "/v1/events").starts_with("HTTP/1.1 401"));
    EXPECT_TRUE(
        whole("POST", "/v1/events", "Authorization: Bearer " + std::string(64, 't') + "\r\n")
            .starts_with("HTTP/1.1 404"));
    EXPECT_TRUE(whole("GET", "/v1/events?stream=0").starts_with("HTTP/1.1 400"));
    EXPECT_TRUE(whole("HEAD", "/v1/events").starts_with("HTTP/1.1 405"));
    on_loop([this] { EXPECT_EQ(station.looks, 0); });
}

TEST_F(EventsDoor, ThePointsSinceTheLastEventIdAreSent) {
    on_loop([this] {
        station.run = "bench-1";
        station.accept(0, 1);
    });
    const auto before = ask("GET", "/v1/events");
    const std::string heard = until(*before, "\"points\":[{");
    const std::size_t at = heard.find("\nid: ") + 5;
    const std::string id = heard.substr(at, heard.find('\n', at) - at);
    on_loop([this] { station.accept(1, 2); });
    const auto again = ask("GET", "/v1/events", "Last-Event-ID: " + id + "\r\n");
    EXPECT_NE(until(*again, "\"targets\":[]}\n\n").find("\"count\":2,\"from\":1,"),
              std::string::npos);
    const auto stranger = ask("GET", "/v1/events", "Last-Event-ID: \xff-7\r\n");
    EXPECT_NE(until(*stranger, "\"targets\":[]}\n\n").find("\"count\":2,\"from\":0,"),
              std::string::npos);
}

TEST_F(EventsDoor, TheDaemonsEndEndsThem) {
    const auto socket = ask("GET", "/v1/events?stream=100");
    until(*socket, "event: status");
    on_loop([this] { server->end_events(); });
    std::string rest(1 << 20, '\0');
    boost::system::error_code end;
    asio::read(*socket, asio::buffer(rest), end);
    EXPECT_EQ(end, asio::error::eof);
    EXPECT_TRUE(whole("GET", "/v1/events").starts_with("HTTP/1.1 503"));
}

} // namespace
} // namespace axiscal::events_door_test

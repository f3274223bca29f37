// The console behind a certificate, through real sockets.
#include "acquisition/console/http_server.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/console/shown_station.hpp"
#include "tests/unit/tls/tls_client.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <future>
#include <memory>
#include <thread>
#include <vector>

namespace axiscal::tls_console_test {
namespace {

namespace asio = boost::asio;
using Json = nlohmann::json;

class ConsoleWithTls : public ::testing::Test {
protected:
    void SetUp() override {
        ConsoleConfig config;
        config.socket_path = folder.file("door.sock");
        config.group.clear();
        config.port = -1;
        config.certificate = test::write_secret(folder.path(), "certificate.pem", made.certificate);
        config.key = test::write_secret(folder.path(), "key.pem", made.key);
        station.shown.station = "bench";
        server = std::make_unique<HttpServer>(scheduler, station, config, std::string(64, 't'),
                                              folder.file("paired-browsers"));
        const auto started = server->start();
        ASSERT_TRUE(started) << describe(started.error());
        runner = std::jthread{[this] { loop.run(); }};
    }
    void TearDown() override {
        work.reset();
        loop.stop();
        if (runner.joinable()) runner.join();
        server.reset();
    }
    [[nodiscard]] unsigned short port() const {
        return static_cast<unsigned short>(server->port());
    }
    [[nodiscard]] std::string own_origin() const {
        return "https://localhost:" + std::to_string(port());
    }
    std::string request(const std::string& method,
                        const std::string& target,
                        const std::string& more = {},
                        const std::string& body = {}) const {
        return method + " " + target + " HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
               "\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" +
               more + "\r\n" + body;
    }
    std::string over_tls(const std::string& asked) {
        test::TlsClient client{port(), made.certificate};
        client.say(asked);
        return client.until(test::to_the_end);
    }
    std::string over_socket(const std::string& asked) {
        asio::local::stream_protocol::socket socket{own};
        socket.connect({folder.file("door.sock")});
        asio::write(socket, asio::buffer(asked));
        return test::heard_until(socket, test::to_the_end);
    }
    static Json body_of(const std::string& answer) {
        return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
    }
    /// "axiscal_session=...; HttpOnly; ..." of a browser that is paired now.
    std::string paired_cookie() {
        const std::string code =
            body_of(over_socket(request("POST", "/v1/pair", "", R"({"name":"tablet"})")))
                .at("code");
        const std::string answer =
            over_tls(request("POST", "/v1/session", "Origin: " + own_origin() + "\r\n",
                             R"({"code":")" + code + "\"}"));
        const std::size_t at = answer.find("Set-Cookie: ") + 12;
        return answer.substr(at, answer.find("\r\n", at) - at);
    }

    testing::ScratchFolder folder;
    test::MadeCertificate made = test::make_certificate();
    asio::io_context loop{1}, own;
    asio::executor_work_guard<asio::io_context::executor_type> work{loop.get_executor()};
    AsioScheduler scheduler{loop};
    testing::ShownStation station;
    std::unique_ptr<HttpServer> server;
    std::jthread runner;
};

TEST_F(ConsoleWithTls, AnswersAsItDoesWithout) {
    const std::string answer = over_tls(request("GET", "/v1/status"));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
    EXPECT_EQ(body_of(answer).at("station"), "bench");
    EXPECT_EQ(answer.find("Strict-Transport-Security"), std::string::npos);
    test::TlsClient stays{port(), made.certificate}; // one connection, several requests
    for (int nth = 0; nth < 3; ++nth) {
        stays.say("GET /v1/status HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
                  "\r\n\r\n");
        EXPECT_NE(stays.until("}\n").find("HTTP/1.1 200"), std::string::npos);
    }
}

TEST_F(ConsoleWithTls, TellsWhoAsksWithoutWhatToDo) {
    test::Tcp socket{own};
    socket.connect({asio::ip::make_address("127.0.0.1"), port()});
    test::bound(socket);
    asio::write(socket, asio::buffer(request("GET", "/v1/status")));
    const std::string answer = test::heard_until(socket, test::to_the_end);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400")) << answer;
    EXPECT_NE(body_of(answer).at("error").at("sentence").get<std::string>().find("https://"),
              std::string::npos);
}

TEST_F(ConsoleWithTls, TheCookieIsForTlsAlone) {
    const std::string cookie = paired_cookie();
    EXPECT_TRUE(cookie.starts_with("axiscal_session=")) << cookie;
    EXPECT_NE(cookie.find("; Secure"), std::string::npos) << cookie;
    const std::string bare = "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
    const auto abort_from = [&](const std::string& origin) {
        return over_tls(
            request("POST", "/v1/run/abort", bare + "Origin: " + origin + "\r\n", "{}"));
    };
    EXPECT_NE(abort_from(own_origin()).find("it only shows"), std::string::npos)
        << "the order has come to the station";
    const std::string spoofed = "http" + own_origin().substr(5);
    EXPECT_NE(abort_from(spoofed).find("is foreign"), std::string::npos)
        << "a page that came without TLS may be anybody's";
}

TEST_F(ConsoleWithTls, SendsABrowserToHttps) {
    const Json offer = body_of(over_socket(request("POST", "/v1/pair", "", "{}")));
    EXPECT_EQ(offer.at("page"), "https://127.0.0.1:" + std::to_string(port()) + "/");
}

TEST_F(ConsoleWithTls, EventsComeOneByOneAndEndInOrder) {
    test::TlsClient client{port(), made.certificate};
    client.say(request("GET", "/v1/events?stream=100"));
    EXPECT_NE(client.until("event: status").find("event: status"), std::string::npos);
    EXPECT_NE(client.until("event: heartbeat").find("event: heartbeat"), std::string::npos);
    std::promise<void> done;
    asio::post(loop, [&] {
        server->end_events();
        done.set_value();
    });
    done.get_future().get();
    client.until(test::to_the_end);
    EXPECT_EQ(client.next_error(), asio::error::eof);
}

TEST_F(ConsoleWithTls, ATooLongBodyIsAnsweredBeforeTheConnectionEnds) {
    test::TlsClient client{port(), made.certificate};
    client.say("POST /v1/run HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
               "\r\nContent-Length: 1000000\r\n\r\n" + std::string(10'000, 'x'));
    EXPECT_TRUE(client.until("}}").starts_with("HTTP/1.1 413"));
}

TEST_F(ConsoleWithTls, SixtyFourStalledHandshakesLeaveTheOtherDoorOpen) {
    std::vector<test::Tcp> crowd;
    for (int nth = 0; nth < 64; ++nth) {
        crowd.emplace_back(own);
        crowd.back().connect({asio::ip::make_address("127.0.0.1"), port()});
        asio::write(crowd.back(), asio::buffer(std::string{"\x16\x03\x01"}));
    }
    EXPECT_TRUE(over_socket(request("GET", "/v1/status")).starts_with("HTTP/1.1 200"));
    test::Tcp one_more{own};
    one_more.connect({asio::ip::make_address("127.0.0.1"), port()});
    test::bound(one_more);
    EXPECT_EQ(test::heard_until(one_more, "never"), "") << "no place is left";
    crowd.clear();
    std::string answer;
    while (!answer.starts_with("HTTP/1.1 200")) // ctest's limit ends it
        try {
            answer = over_tls(request("GET", "/v1/status"));
        } catch (const boost::system::system_error&) { // hung up on: not all have gone yet
        }
}

TEST(ConsoleWithoutItsCertificate, DoesNotStart) {
    asio::io_context loop{1};
    AsioScheduler scheduler{loop};
    testing::ShownStation station;
    ConsoleConfig config;
    config.socket_path.clear();
    config.group.clear();
    config.port = -1;
    config.certificate = "/nowhere/fullchain.pem";
    config.key = "/nowhere/key.pem";
    HttpServer server{scheduler, station, config, std::string(64, 't')};
    const auto started = server.start();
    ASSERT_FALSE(started);
    EXPECT_NE(started.error().detail.find("/nowhere/fullchain.pem is not there"), std::string::npos)
        << started.error().detail;
}

} // namespace
} // namespace axiscal::tls_console_test

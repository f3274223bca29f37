// Pairing over both doors of a server that runs.
#include "acquisition/console/http_server.hpp"

#include "acquisition/console/paired_file.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/scratch_folder.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <thread>

namespace axiscal::pairing_door_test {
namespace {

namespace asio = boost::asio;
using Json = nlohmann::json;

/// A station that keeps who ordered last. Used on the loop only; read between requests.
class ObeyingStation final : public StationInterface {
public:
    [[nodiscard]] StationStatus status() const override { return {}; }
    Task<Result<std::string>> arm(ArmRequest request) override {
        by = std::move(request.by);
        co_return "bench-1";
    }
    Result<void> trigger() override { return {}; }
    Result<void> type_reading(double /*seconds_of_arc*/) override { return {}; }
    Task<Result<RunEnding>> abort(std::string reason, Orderer who) override {
        by = std::move(who);
        RunEnding ending;
        ending.reason = std::move(reason);
        co_return ending;
    }
    Task<Result<std::vector<PreflightRecord>>> preflight(ArmRequest /*request*/) override {
        co_return std::vector<PreflightRecord>{};
    }
    Task<Result<RetakeAnswer>> retake(RevisionRequest /*request*/) override {
        co_return RetakeAnswer{};
    }
    Task<Result<int>> exclude(RevisionRequest /*request*/) override { co_return 0; }
    Task<Result<void>> answer_finding(AnswerRequest /*request*/) override {
        co_return Result<void>{};
    }
    Task<Result<std::string>> drift(DriftRequest /*request*/) override { co_return ""; }
    [[nodiscard]] std::optional<StreamView> stream(std::size_t /*most*/) const override {
        return std::nullopt;
    }
    [[nodiscard]] AlignmentView alignment() const override { return {}; }
    Result<void> align(AlignmentOrder /*order*/) override { return {}; }

    Orderer by;
};

struct Answered {
    unsigned status = 0;
    std::string head;
    Json body;
};

class PairingOverHttp : public ::testing::Test {
protected:
    void SetUp() override { begin(); }
    void TearDown() override { end(); }

    void begin() {
        ConsoleConfig config;
        config.socket_path = scratch.file("door.sock");
        config.group.clear();
        config.port = -1;
        loop = std::make_unique<asio::io_context>(1);
        work.emplace(loop->get_executor());
        scheduler = std::make_unique<AsioScheduler>(*loop);
        server = std::make_unique<HttpServer>(*scheduler, station, config, std::string(64, 't'),
                                              paired_file());
        const auto started = server->start();
        ASSERT_TRUE(started) << describe(started.error());
        runner = std::jthread{[this] { loop->run(); }};
    }
    void end() {
        work.reset();
        loop->stop();
        runner.join();
        server.reset();
        scheduler.reset();
        loop.reset();
    }
    [[nodiscard]] std::string paired_file() const { return scratch.file("paired-browsers"); }
    [[nodiscard]] std::string host() const { return "localhost:" + std::to_string(server->port()); }
    [[nodiscard]] std::string own_origin() const { return "Origin: http://" + host() + "\r\n"; }

    template <class Socket>
    Answered talk(Socket& socket,
                  const std::string& call,
                  const std::string& more,
                  const std::string& body) {
        timeval limit{20, 0};
        ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        boost::system::error_code over;
        asio::write(socket,
                    asio::buffer(call + " HTTP/1.1\r\nHost: " + host() +
                                 "\r\nConnection: close\r\nContent-Length: " +
                                 std::to_string(body.size()) + "\r\n" + more + "\r\n" + body),
                    over);
        std::string reply;
        asio::read(socket, asio::dynamic_buffer(reply), over);
        const std::size_t split = reply.find("\r\n\r\n");
        if (split == std::string::npos) return {};
        Answered got;
        got.status = static_cast<unsigned>(std::stoul(reply.substr(9, 3)));
        got.head = reply.substr(0, split + 2);
        got.body = Json::parse(reply.substr(split + 4), nullptr, false);
        return got;
    }
    Answered
    over_tcp(const std::string& call, const std::string& more = {}, const std::string& body = {}) {
        asio::io_context own;
        asio::ip::tcp::socket socket{own};
        socket.connect(
            {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
        return talk(socket, call, more, body);
    }
    Answered over_socket(const std::string& call, const std::string& body = {}) {
        asio::io_context own;
        asio::local::stream_protocol::socket socket{own};
        socket.connect({scratch.file("door.sock")});
        return talk(socket, call, {}, body);
    }
    std::string code_for(const std::string& name) {
        return over_socket("POST /v1/pair", R"({"name":")" + name + "\"}").body.at("code");
    }
    /// "Cookie: ..." of a browser that is paired now.
    std::string cookie_of(const std::string& name) {
        const std::string code = code_for(name);
        const Answered opened =
            over_tcp("POST /v1/session", own_origin(), R"({"code":")" + code + "\"}");
        const std::size_t at = opened.head.find("axiscal_session=");
        EXPECT_EQ(opened.status, 200U) << opened.body;
        if (at == std::string::npos) return {};
        return "Cookie: " + opened.head.substr(at, opened.head.find(';', at) - at) + "\r\n";
    }

    testing::ScratchFolder scratch;
    ObeyingStation station;
    std::unique_ptr<asio::io_context> loop;
    std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work;
    std::unique_ptr<AsioScheduler> scheduler;
    std::unique_ptr<HttpServer> server;
    std::jthread runner;
};

TEST_F(PairingOverHttp, ACodeBecomesACookieThatScriptsCannotRead) {
    const std::string code = code_for("tablet 2");
    const Answered opened =
        over_tcp("POST /v1/session", own_origin(),
                 R"({"code":")" + code.substr(0, 4) + " " + code.substr(4) + "\"}");
    EXPECT_EQ(opened.status, 200U) << opened.body;
    EXPECT_EQ(opened.body.at("name"), "tablet 2");
    EXPECT_NE(opened.head.find("; HttpOnly; SameSite=Strict; Path=/; Max-Age="), std::string::npos)
        << opened.head;
    EXPECT_EQ(opened.head.find("Secure"), std::string::npos) << "there is no TLS";
}

TEST_F(PairingOverHttp, AnOrderOfAPairedBrowserBearsItsName) {
    const std::string cookie = cookie_of("tablet 2");
    EXPECT_EQ(over_tcp("POST /v1/run/abort", cookie + own_origin(), R"({"by":"Jo"})").status, 200U);
    EXPECT_EQ(station.by.door, "page");
    EXPECT_EQ(station.by.user, "tablet 2");
    EXPECT_EQ(station.by.name, "Jo");
    EXPECT_FALSE(station.by.uid);
    EXPECT_EQ(name_of(station.by), "Jo (page tablet 2)");
    EXPECT_EQ(over_tcp("POST /v1/run", cookie + own_origin(), "{}").status, 201U);
    EXPECT_EQ(name_of(station.by), "page tablet 2");
    EXPECT_EQ(over_tcp("POST /v1/run/trigger", cookie + own_origin()).status, 202U);
}

TEST_F(PairingOverHttp, WithoutCookieOrOwnOriginNothingIsOrdered) {
    const std::string cookie = cookie_of("tablet 2");
    EXPECT_EQ(over_tcp("POST /v1/run/abort", own_origin(), "{}").status, 401U);
    EXPECT_EQ(over_tcp("POST /v1/run/abort", cookie, "{}").status, 403U);
    for (const char* foreign : {"http://evil.example", "http://localhost", "null"})
        EXPECT_EQ(
            over_tcp("POST /v1/run/abort", cookie + "Origin: " + foreign + "\r\n", "{}").status,
            403U)
            << foreign;
    EXPECT_EQ(station.by.door, "");
}

TEST_F(PairingOverHttp, ThePageIsToldWhetherItIsPairedAndHowItIs) {
    const Answered stranger = over_tcp("GET /v1/session");
    EXPECT_EQ(stranger.status, 200U);
    EXPECT_EQ(stranger.body.at("paired"), false);
    EXPECT_NE(stranger.body.at("how").get<std::string>().find("axiscal pair"), std::string::npos);
    const std::string cookie = cookie_of("tablet 2");
    const Answered known = over_tcp("GET /v1/session", cookie);
    EXPECT_EQ(known.body.at("paired"), true);
    EXPECT_EQ(known.body.at("name"), "tablet 2");
    EXPECT_TRUE(known.body.at("until_utc").get<std::string>().ends_with("Z"));
}

TEST_F(PairingOverHttp, ABrowserEndsItsOwnSession) {
    const std::string cookie = cookie_of("tablet 2"), other = cookie_of("tablet 3");
    EXPECT_EQ(over_tcp("DELETE /v1/session", cookie).status, 403U);
    const Answered ended = over_tcp("DELETE /v1/session", cookie + own_origin());
    EXPECT_EQ(ended.status, 200U);
    EXPECT_NE(ended.head.find("axiscal_session=; "), std::string::npos) << ended.head;
    EXPECT_EQ(over_tcp("POST /v1/run/abort", cookie + own_origin(), "{}").status, 401U);
    EXPECT_EQ(over_tcp("POST /v1/run/abort", other + own_origin(), "{}").status, 200U);
}

TEST_F(PairingOverHttp, OverTcpNobodyPairsOrSeesWhoIs) {
    const std::string token = "Authorization: Bearer " + std::string(64, 't') + "\r\n";
    for (const char* call : {"POST /v1/pair", "GET /v1/pair", "POST /v1/pair/end"})
        for (const std::string& right : {std::string{}, token}) {
            const Answered refused = over_tcp(call, right, "{}");
            EXPECT_EQ(refused.status, 403U) << call;
            EXPECT_NE(
                refused.body.at("error").at("sentence").get<std::string>().find("axiscal pair"),
                std::string::npos);
        }
}

TEST_F(PairingOverHttp, WhoIsPairedIsListedAndEnded) {
    const std::string cookie = cookie_of("tablet 2");
    const Json listed = over_socket("GET /v1/pair").body.at("paired");
    ASSERT_EQ(listed.size(), 1U);
    EXPECT_EQ(listed.at(0).at("name"), "tablet 2");
    EXPECT_EQ(listed.at(0).at("last_order_utc"), "");
    over_tcp("POST /v1/run/abort", cookie + own_origin(), "{}");
    EXPECT_NE(over_socket("GET /v1/pair").body.at("paired").at(0).at("last_order_utc"), "");
    EXPECT_EQ(over_socket("POST /v1/pair/end", R"({"name":"tablet 3"})").status, 404U);
    EXPECT_EQ(over_socket("POST /v1/pair/end", R"({"name":"tablet 2"})").body.at("ended"), 1);
    EXPECT_EQ(over_tcp("POST /v1/run/abort", cookie + own_origin(), "{}").status, 401U);
    EXPECT_EQ(over_socket("POST /v1/pair/end", R"({"all":true})").body.at("ended"), 0);
}

TEST_F(PairingOverHttp, WrongCodesAreRefusedAndCounted) {
    const std::string code = code_for("page");
    const std::string wrong = code == "00000000" ? "00000001" : "00000000";
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(over_tcp("POST /v1/session", own_origin(), R"({"code":")" + wrong + "\"}").status,
                  403U);
    const Answered late = over_tcp("POST /v1/session", own_origin(), R"({"code":")" + code + "\"}");
    EXPECT_EQ(late.status, 403U);
    EXPECT_NE(late.body.at("error").at("sentence").get<std::string>().find("ask for a new one"),
              std::string::npos);
}

TEST_F(PairingOverHttp, WhatIsNoCodeCountsAsNoTry) {
    const std::string code = code_for("page");
    for (const char* body :
         {"", "{}", R"({"code":12345678})", R"({"code":"1234567"})", R"({"code":"123456789"})",
          R"({"code":"1234567x"})", R"({"kode":"1"})", R"({"code":"12345678","by":"x"})", "[1]"})
        EXPECT_EQ(over_tcp("POST /v1/session", own_origin(), body).status, 400U) << body;
    EXPECT_EQ(over_tcp("POST /v1/session", own_origin(), R"({"code":")" + code + "\"}").status,
              200U);
}

TEST_F(PairingOverHttp, ARestartUnpairsNobody) {
    const std::string cookie = cookie_of("tablet 2");
    end();
    begin();
    EXPECT_EQ(over_tcp("GET /v1/session", cookie).body.at("name"), "tablet 2");
    EXPECT_EQ(over_tcp("POST /v1/run/abort", cookie + own_origin(), "{}").status, 200U);
    const std::string kept = testing::read_bytes(paired_file());
    const std::string token = cookie.substr(cookie.find('=') + 1, 43);
    EXPECT_EQ(kept.find(token), std::string::npos) << "the token itself is nowhere";
}

TEST_F(PairingOverHttp, ADamagedFilePairsNobodyAndTheDoorServes) {
    const std::string cookie = cookie_of("tablet 2");
    end();
    testing::write_bytes(paired_file(), "axiscal paired browsers 1\nspoilt");
    begin();
    EXPECT_EQ(over_tcp("GET /v1/session", cookie).body.at("paired"), false);
    EXPECT_EQ(over_tcp("POST /v1/run/abort", cookie + own_origin(), "{}").status, 401U);
    cookie_of("tablet 3");
    EXPECT_EQ(read_paired(paired_file()).value().size(), 1U);
}

} // namespace
} // namespace axiscal::pairing_door_test

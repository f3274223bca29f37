// Stored runs over a door of a server that runs.
#include "acquisition/console/http_server.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/console/shown_station.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace axiscal::runs_door_test {
namespace {

namespace asio = boost::asio;
using Json = nlohmann::json;
using testing::append;
using testing::RandomRun;
using testing::ScratchFolder;
using testing::ShownStation;
using testing::write_bytes;

const std::string run_id = "demo-20260101T080000Z-X";

struct Got {
    unsigned status = 0;
    std::string head, body;
    [[nodiscard]] Json json() const { return Json::parse(body, nullptr, false); }
    [[nodiscard]] std::string sentence() const {
        return json().at("error").at("sentence").get<std::string>();
    }
};

class RunsOverHttp : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* folder : {"runs", "published"})
            std::filesystem::create_directory(scratch.file(folder));
        write_bytes(scratch.file("token"), "a secret");
        ConsoleConfig config;
        config.socket_path = scratch.file("door.sock");
        config.group.clear();
        config.port = -1;
        work.emplace(loop.get_executor());
        server = std::make_unique<HttpServer>(scheduler, station, config, std::string(64, 't'));
    }
    void TearDown() override {
        work.reset();
        loop.stop();
        if (runner.joinable()) runner.join();
        server.reset();
    }
    void start(bool with_runs = true) {
        if (with_runs) server->show_runs(scratch.path());
        const auto started = server->start();
        ASSERT_TRUE(started) << describe(started.error());
        runner = std::jthread{[this] { loop.run(); }};
    }
    void store_with_certificate() {
        RunRecord run = random.header();
        run.run_id = run_id;
        run.kind = TestKind::positioning;
        const std::string path = scratch.file("runs/" + run_id + ".axiscal");
        RunFileWriter writer = RunFileWriter::create(path, run).value();
        EXPECT_TRUE(append(writer, random.point(0)));
        EXPECT_TRUE(writer.close(true, "done", random.tie()));
        const std::string entry = "published/" + run_id;
        std::filesystem::create_directory(scratch.file(entry));
        write_bytes(scratch.file(entry + "/certificate.json"),
                    R"({"unit":"mm","verdict":"pass","verdicts":[],"run":{"id":")" + run_id +
                        R"("}})");
        write_bytes(scratch.file(entry + "/certificate.pdf"), "%PDF-1.5");
        std::filesystem::copy_file(path, scratch.file(entry + "/" + run_id + ".axiscal"));
    }
    [[nodiscard]] Got ask(const std::string& target) const {
        asio::io_context own;
        asio::ip::tcp::socket socket{own};
        const auto port = static_cast<std::uint16_t>(server->port());
        socket.connect({asio::ip::make_address("127.0.0.1"), port});
        timeval limit{20, 0};
        ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        asio::write(socket, asio::buffer("GET " + target + " HTTP/1.1\r\nHost: localhost:" +
                                         std::to_string(port) + "\r\nConnection: close\r\n\r\n"));
        std::string reply;
        boost::system::error_code over;
        asio::read(socket, asio::dynamic_buffer(reply), over);
        const std::size_t split = reply.find("\r\n\r\n");
        if (split == std::string::npos) return {};
        return {static_cast<unsigned>(std::stoul(reply.substr(9, 3))), reply.substr(0, split + 2),
                reply.substr(split + 4)};
    }

    ScratchFolder scratch;
    RandomRun random{7};
    asio::io_context loop{1};
    std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work;
    AsioScheduler scheduler{loop};
    ShownStation station;
    std::unique_ptr<HttpServer> server;
    std::jthread runner;
};

TEST_F(RunsOverHttp, TheListIsReadWithoutAnyRight) {
    store_with_certificate();
    start();
    const Got got = ask("/v1/runs?limit=5");
    ASSERT_EQ(got.status, 200U) << got.body;
    const Json rows = got.json().at("runs");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].at("id"), run_id);
    EXPECT_EQ(rows[0].at("verdict"), "pass");
    EXPECT_EQ(rows[0].at("paper"), "published");
    EXPECT_EQ(got.body.find(scratch.path()), std::string::npos);
}

TEST_F(RunsOverHttp, APaperSaysWhatItIsAndRunsInNoFrame) {
    store_with_certificate();
    start();
    const Got pdf = ask("/v1/runs/" + run_id + "/certificate.pdf");
    ASSERT_EQ(pdf.status, 200U) << pdf.body;
    EXPECT_EQ(pdf.body, "%PDF-1.5");
    for (const std::string& line :
         {std::string{"Content-Type: application/pdf\r\n"},
          "Content-Disposition: inline; filename=\"" + run_id + ".pdf\"\r\n",
          std::string{"X-Content-Type-Options: nosniff\r\n"},
          std::string{"frame-ancestors 'none'"}})
        EXPECT_NE(pdf.head.find(line), std::string::npos) << line << pdf.head;
    const Got file = ask("/v1/runs/" + run_id + "/" + run_id + ".axiscal");
    EXPECT_EQ(file.status, 200U);
    EXPECT_NE(file.head.find("Content-Disposition: attachment"), std::string::npos);
}

TEST_F(RunsOverHttp, OneRunBringsItsCertificate) {
    store_with_certificate();
    start();
    const Got got = ask("/v1/runs/" + run_id);
    ASSERT_EQ(got.status, 200U) << got.body;
    EXPECT_EQ(got.json().at("certificate").at("run").at("id"), run_id);
    EXPECT_EQ(got.json().at("papers").size(), 3U);
}

TEST_F(RunsOverHttp, NoNameLeavesTheFolders) {
    store_with_certificate();
    start();
    for (const char* target :
         {"/v1/runs/../token", "/v1/runs/%2e%2e/token", "/v1/runs/..%2ftoken", "/v1/runs/token",
          "/v1/runs//token", "/v1/runs/demo-20260101T080000Z-X/../../../token",
          "/v1/runs/demo-20260101T080000Z-X/certificate.txt",
          "/v1/runs/demo-20260101T080000Z-X/..%2f..%2ftoken"}) {
        const Got got = ask(target);
        EXPECT_EQ(got.status, 404U) << target;
        EXPECT_EQ(got.body.find("a secret"), std::string::npos) << target;
    }
}

TEST_F(RunsOverHttp, AnUnknownQuestionIsRefusedInWords) {
    start();
    const Got got = ask("/v1/runs?limit=0");
    EXPECT_EQ(got.status, 400U);
    EXPECT_FALSE(got.sentence().empty());
}

TEST_F(RunsOverHttp, WithoutAFolderOfRunsTheStationAnswersAllTheSame) {
    start(false);
    EXPECT_EQ(ask("/v1/runs").status, 404U);
    EXPECT_EQ(ask("/v1/status").status, 200U);
}

TEST_F(RunsOverHttp, FiveAtOnceAreAllAnsweredOrToldToWait) {
    store_with_certificate();
    start();
    std::vector<unsigned> answers(5);
    {
        std::vector<std::jthread> clients;
        for (unsigned& answer : answers)
            clients.emplace_back([this, &answer] { answer = ask("/v1/runs/" + run_id).status; });
    }
    for (const unsigned answer : answers)
        EXPECT_TRUE(answer == 200U || answer == 503U) << answer;
    EXPECT_EQ(ask("/v1/runs/" + run_id).status, 200U); // every place is free again
}

} // namespace
} // namespace axiscal::runs_door_test

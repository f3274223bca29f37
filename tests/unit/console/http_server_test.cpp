#include "acquisition/console/api_token.hpp"
#include "acquisition/console/http_server.hpp"

#include "acquisition/console/peer.hpp"

#include "drivers/loop/asio_scheduler.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <sys/stat.h>
#include <thread>

namespace axiscal::http_server_test {
namespace {

namespace asio = boost::asio;

/// A station that remembers what was asked of it. Used on the loop only.
class RecordingStation final : public StationInterface {
public:
    [[nodiscard]] StationStatus status() const override {
        StationStatus status;
        status.station = "bench";
        status.notes = notes;
        status.axis.name = "X";
        status.axis.reads_angle = reads_angle;
        status.channels.push_back({.instrument = "air",
                                   .channel = "pressure",
                                   .name = "air pressure",
                                   .place = {},
                                   .unit = "Pa",
                                   .kind = ChannelKind::pressure,
                                   .medium = Medium::air,
                                   .value = {},
                                   .age_s = 14.0,
                                   .role = "environment",
                                   .quality = "stale"});
        return status;
    }
    Task<Result<std::string>> arm(ArmRequest request) override {
        armed = request;
        if (request.pass == "soak") co_return refuse(Fault::refused, "preflight", "soak: Wait.");
        if (request.pass == "slow") {
            while (!request.has_gone())
                co_await scheduler_of_arm->sleep_for(std::chrono::milliseconds{1});
            noticed = true;
        }
        if (request.pass == "busy") co_return fail(Fault::busy, "run 7 is open");
        co_return "bench-1";
    }
    Result<void> trigger() override { return fail(Fault::no_run_armed, ""); }
    Result<void> type_reading(double seconds_of_arc) override {
        typed_arcsec = seconds_of_arc;
        if (seconds_of_arc > 100) return fail(Fault::outside_window, "beyond the range");
        return {};
    }
    Task<Result<RunEnding>> abort(std::string reason, Orderer by) override {
        if (reason == "bug") throw std::runtime_error{"a bug of one request"};
        aborted_by = std::move(by);
        reason_given = std::move(reason);
        if (reason_given == "late") co_return RunEnding{true, "Every planned point is durable."};
        co_return RunEnding{false, reason_given};
    }

    Task<Result<std::vector<PreflightRecord>>> preflight(ArmRequest request) override {
        const auto reason = request.overrides.find("soak");
        co_return std::vector<PreflightRecord>{
            {"soak", false, false, "Wait.",
             reason == request.overrides.end() ? "" : reason->second}};
    }
    Task<Result<RetakeAnswer>> retake(RevisionRequest request) override {
        revision = request;
        if (request.reason == "late") co_return fail(Fault::datum_lost, "the beam was interrupted");
        RetakeAnswer answer;
        answer.points.push_back({10, {2, 2, Direction::negative, 0}});
        answer.last_request = 10;
        co_return answer;
    }
    Task<Result<int>> exclude(RevisionRequest request) override {
        revision = request;
        co_return 1;
    }

    Task<Result<void>> answer_finding(AnswerRequest request) override {
        answered = request;
        co_return Result<void>{};
    }

    Task<Result<std::string>> drift(DriftRequest request) override {
        drifted = std::move(request);
        co_return "bench-1-drift";
    }
    [[nodiscard]] std::optional<StreamView> stream(std::size_t most) const override {
        asked_points = most;
        return streamed;
    }
    [[nodiscard]] AlignmentView alignment() const override { return aligned; }
    Result<void> align(AlignmentOrder order) override {
        ordered = order;
        aligned.running = order.action == AlignmentAction::begin;
        return {};
    }

    Scheduler* scheduler_of_arm = nullptr;
    std::atomic<bool> noticed = false;
    ArmRequest armed;
    RevisionRequest revision;
    AnswerRequest answered;
    AlignmentView aligned;
    std::optional<StreamView> streamed;
    mutable std::size_t asked_points = 0;
    std::optional<DriftRequest> drifted;
    std::optional<AlignmentOrder> ordered;
    std::string reason_given;
    Orderer aborted_by;
    double typed_arcsec = 0;
    bool reads_angle = false;
    std::vector<std::string> notes;
};

class HttpDoor : public ::testing::Test {
protected:
    void SetUp() override {
        char name[] = "/tmp/axiscal-http-XXXXXX";
        folder = ::mkdtemp(name);
        ConsoleConfig config;
        config.socket_path = folder / "door.sock";
        config.group.clear();
        config.port = -1;
        configure(config);
        station.scheduler_of_arm = &scheduler;
        server = std::make_unique<HttpServer>(scheduler, station, config, std::string(64, 't'),
                                              folder / "paired-browsers");
        const auto started = server->start();
        ASSERT_TRUE(started) << describe(started.error());
        runner = std::jthread{[this] { loop.run(); }};
    }
    void TearDown() override {
        work.reset();
        loop.stop();
        runner.join();
        server.reset();
        std::filesystem::remove_all(folder);
    }

    virtual void configure(ConsoleConfig& /*config*/) {}
    std::string raw_over_tcp(const std::string& bytes) {
        asio::io_context own;
        asio::ip::tcp::socket socket{own};
        socket.connect(
            {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
        return talk(socket, bytes);
    }

    /// Sends raw bytes, returns everything the station answers until it closes.
    template <class Socket> static std::string talk(Socket& socket, const std::string& request) {
        timeval limit{10, 0};
        ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        boost::system::error_code end; // the station may hang up on a body that is too long
        asio::write(socket, asio::buffer(request), end);
        std::string reply;
        asio::read(socket, asio::dynamic_buffer(reply), end);
        return reply;
    }
    std::string over_tcp(const std::string& method,
                         const std::string& target,
                         const std::string& more = {},
                         const std::string& body = {}) {
        asio::io_context own;
        asio::ip::tcp::socket socket{own};
        socket.connect(
            {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
        return talk(socket, method + " " + target +
                                " HTTP/1.1\r\nHost: localhost:" + std::to_string(server->port()) +
                                "\r\nConnection: close\r\nContent-Length: " +
                                std::to_string(body.size()) + "\r\n" + more + "\r\n" + body);
    }
    std::string over_socket(const std::string& method,
                            const std::string& target,
                            const std::string& body = {}) {
        asio::io_context own;
        asio::local::stream_protocol::socket socket{own};
        socket.connect({(folder / "door.sock").string()});
        return talk(socket, method + " " + target +
                                " HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Length: " +
                                std::to_string(body.size()) + "\r\n\r\n" + body);
    }

    std::filesystem::path folder;
    asio::io_context loop{1};
    asio::executor_work_guard<asio::io_context::executor_type> work{loop.get_executor()};
    AsioScheduler scheduler{loop};
    RecordingStation station;
    std::unique_ptr<HttpServer> server;
    std::jthread runner;
};

std::string body_of(const std::string& reply) {
    return reply.substr(reply.find("\r\n\r\n") + 4);
}

TEST_F(HttpDoor, StatusIsReadOverTcp) {
    const std::string reply = over_tcp("GET", "/v1/status");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 200")) << reply;
    EXPECT_EQ(nlohmann::json::parse(body_of(reply)).at("station"), "bench");
}

TEST_F(HttpDoor, AnOrderOverTheSocketBearsTheUserThatTheKernelKnowsAndTheNameThatWasGiven) {
    over_socket("POST", "/v1/run", R"({"by":"Jo Müller"})");
    EXPECT_EQ(station.armed.by.door, "socket");
    EXPECT_EQ(station.armed.by.uid, ::getuid());
    EXPECT_EQ(station.armed.by.user, user_name_of(::getuid()));
    EXPECT_EQ(station.armed.by.name, "Jo Müller");
    over_socket("POST", "/v1/run/retake", R"({"target":1,"reason":"r","by":"A"})");
    EXPECT_EQ(station.revision.by.uid, ::getuid());
    EXPECT_EQ(station.revision.by.name, "A");
    over_socket("POST", "/v1/run/exclude", R"({"target":1,"reason":"r"})");
    EXPECT_EQ(station.revision.by.uid, ::getuid());
    EXPECT_EQ(station.revision.by.name, "");
    over_socket("POST", "/v1/run/abort", R"({"by":"B"})");
    EXPECT_EQ(station.aborted_by.uid, ::getuid());
    EXPECT_EQ(station.aborted_by.name, "B");
    over_socket("POST", "/v1/drift", R"({"by":"C"})");
    ASSERT_TRUE(station.drifted);
    EXPECT_EQ(station.drifted->by.uid, ::getuid());
    EXPECT_EQ(station.drifted->by.name, "C");
}

TEST_F(HttpDoor, AnOrderOverTcpBearsTheTokenAndNoUser) {
    const std::string token = "Authorization: Bearer " + std::string(64, 't') + "\r\n";
    over_tcp("POST", "/v1/run/abort", token, R"({"by":"Jo"})");
    EXPECT_EQ(station.aborted_by.door, "token");
    EXPECT_FALSE(station.aborted_by.uid);
    EXPECT_EQ(station.aborted_by.user, "");
    EXPECT_EQ(station.aborted_by.name, "Jo");
}

TEST_F(HttpDoor, ANameThatIsNoNameIsRefused) {
    for (const char* name :
         {"\"\"", "\"  \"", "7", "null", "[\"Jo\"]", "\"Jo\\nMiller\"", "\"\\u007f\"",
          "\"Jo\\u0085\"", "\"Jo\\u2028Miller\"", "\"Jo\\u2029\""})
        for (const char* order : {"/v1/run", "/v1/run/retake", "/v1/run/abort", "/v1/drift"}) {
            const std::string reply =
                over_socket("POST", order, "{\"by\":" + std::string{name} + "}");
            EXPECT_TRUE(reply.starts_with("HTTP/1.1 400")) << order << " " << name << " " << reply;
        }
}

TEST_F(HttpDoor, AStaleValueIsNullNotANumber) {
    const auto status = nlohmann::json::parse(body_of(over_tcp("GET", "/v1/status")));
    EXPECT_TRUE(status.at("channels").at(0).at("value").is_null());
    EXPECT_EQ(status.at("channels").at(0).at("quality"), "stale");
}

TEST_F(HttpDoor, MetricsAreTextThatWhoeverMayReadReads) {
    for (const std::string& reply : {over_tcp("GET", "/metrics"), over_socket("GET", "/metrics")}) {
        EXPECT_TRUE(reply.starts_with("HTTP/1.1 200")) << reply;
        EXPECT_NE(reply.find("\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\n"),
                  std::string::npos)
            << reply;
        const std::string text = body_of(reply);
        EXPECT_TRUE(text.starts_with("# HELP axiscal_build_info ")) << text;
        EXPECT_NE(text.find("axiscal_channel_quality{instrument=\"air\",channel=\"pressure\","
                            "quality=\"stale\"} 1\n"),
                  std::string::npos);
        EXPECT_EQ(text.find("axiscal_channel_pressure_pascals"), std::string::npos);
    }
    EXPECT_TRUE(
        over_tcp("GET", "/metrics", "Origin: http://evil.example\r\n").starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(over_tcp("POST", "/metrics").starts_with("HTTP/1.1 401"));
}

TEST_F(HttpDoor, TellsWhetherTheInstrumentReadsALengthOrAnAngle) {
    const auto reading = [this] {
        return nlohmann::json::parse(body_of(over_tcp("GET", "/v1/status")))
            .at("axis")
            .at("reading");
    };
    EXPECT_EQ(reading(), "length");
    station.reads_angle = true;
    EXPECT_EQ(reading(), "angle");
}

TEST_F(HttpDoor, TheStreamIsReadThinned) {
    EXPECT_TRUE(nlohmann::json::parse(body_of(over_tcp("GET", "/v1/stream"))).is_null());
    EXPECT_EQ(station.asked_points, 1000U);
    StreamView view;
    view.run_id = "bench-1-XY-circle";
    view.channel = "ballbar/axis 1";
    view.samples = 7;
    view.samples_a_stretch = 4;
    view.stretches = {{-1e-6, 2e-6}, {0, 1.5e-3}};
    station.streamed = view;
    const auto seen = nlohmann::json::parse(body_of(over_tcp("GET", "/v1/stream?points=2")));
    EXPECT_EQ(station.asked_points, 2U);
    EXPECT_EQ(seen.at("run"), "bench-1-XY-circle");
    EXPECT_EQ(seen.at("samples_a_stretch"), 4);
    EXPECT_TRUE(seen.at("rate_hz").is_null());
    EXPECT_NEAR(seen.at("low").at(0).get<double>(), -1e-3, 1e-12);
    EXPECT_NEAR(seen.at("high").at(1).get<double>(), 1.5, 1e-12);
    for (const char* wrong : {"?points=0", "?points=4097", "?points=2x", "?width=2"})
        EXPECT_TRUE(over_tcp("GET", "/v1/stream" + std::string{wrong}).starts_with("HTTP/1.1 400"))
            << wrong;
}

TEST_F(HttpDoor, TcpWithoutTokenMayNotArm) {
    EXPECT_TRUE(over_tcp("POST", "/v1/run", "", "{}").starts_with("HTTP/1.1 401"));
}

TEST_F(HttpDoor, TcpWithTokenMayArm) {
    const std::string reply =
        over_tcp("POST", "/v1/run", "Authorization: Bearer " + std::string(64, 't') + "\r\n",
                 R"({"pass":"whole"})");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 201")) << reply;
}

TEST_F(HttpDoor, AForeignOriginIsRefused) {
    EXPECT_TRUE(over_tcp("GET", "/v1/status", "Origin: http://evil.example\r\n")
                    .starts_with("HTTP/1.1 403"));
}

TEST_F(HttpDoor, AnUnknownHostIsRefused) {
    asio::io_context own;
    asio::ip::tcp::socket socket{own};
    socket.connect(
        {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
    EXPECT_TRUE(
        talk(socket,
             "GET /v1/status HTTP/1.1\r\nHost: rebound.example\r\nConnection: close\r\n\r\n")
            .starts_with("HTTP/1.1 421"));
}

TEST_F(HttpDoor, TheSocketBelongsToTheGroupAlone) {
    struct stat info {};
    ASSERT_EQ(::stat((folder / "door.sock").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0660U);
}

TEST_F(HttpDoor, ArmingPassesStatementsOn) {
    const std::string reply = over_socket(
        "POST", "/v1/run", R"({"datum_mm":-4.5,"seed":7,"statements":{"state":"as left"}})");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 201")) << reply;
    EXPECT_EQ(nlohmann::json::parse(body_of(reply)).at("run"), "bench-1");
    EXPECT_EQ(station.armed.datum_mm, -4.5);
    EXPECT_EQ(station.armed.seed, 7U);
    EXPECT_EQ(station.armed.statements.at("state"), "as left");
}

TEST_F(HttpDoor, ArmingThatChecksForbidShowsThemAll) {
    const auto reply = over_socket("POST", "/v1/run", R"({"pass":"soak"})");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 409")) << reply;
    const auto body = nlohmann::json::parse(body_of(reply));
    EXPECT_EQ(body.at("error").at("field"), "preflight");
    EXPECT_EQ(body.at("checks").at(0).at("name"), "soak");
    EXPECT_EQ(body.at("checks").at(0).at("passed"), false);
}

TEST_F(HttpDoor, PreflightShowsTheChecksWithoutArming) {
    const auto read = nlohmann::json::parse(body_of(over_tcp("GET", "/v1/preflight")));
    EXPECT_EQ(read.at("checks").at(0).at("override"), "");
    const auto tried = nlohmann::json::parse(
        body_of(over_socket("POST", "/v1/preflight", R"({"overrides":{"soak":"hurry"}})")));
    EXPECT_EQ(tried.at("checks").at(0).at("override"), "hurry");
    EXPECT_TRUE(over_tcp("POST", "/v1/preflight", "", "{}").starts_with("HTTP/1.1 401"));
}

TEST_F(HttpDoor, ARetakeNamesItsPointsAndTheRequestItCountsFrom) {
    const auto reply = over_socket("POST", "/v1/run/retake",
                                   R"({"target":2,"direction":"negative","reason":"coolant"})");
    ASSERT_TRUE(reply.starts_with("HTTP/1.1 200")) << reply;
    const auto body = nlohmann::json::parse(body_of(reply));
    EXPECT_EQ(body.at("last_request"), 10);
    EXPECT_EQ(body.at("points").at(0).at("step"), 10);
    EXPECT_EQ(station.revision.selection.target, 2);
    EXPECT_EQ(station.revision.selection.direction, Direction::negative);
    EXPECT_FALSE(station.revision.selection.approach);
    EXPECT_TRUE(over_socket("POST", "/v1/run/retake", R"({"target":2,"reason":"late"})")
                    .starts_with("HTTP/1.1 409"));
}

TEST_F(HttpDoor, ARetakeOrAnExclusionWithoutAReasonIsRefusedByName) {
    for (const char* call : {"/v1/run/retake", "/v1/run/exclude"})
        for (const char* body :
             {R"({"target":2})", R"({"target":2,"reason":" "})", R"({"target":-1,"reason":"x"})",
              R"({"goal":2,"reason":"x"})", R"({"direction":"up","reason":"x"})"})
            EXPECT_TRUE(over_socket("POST", call, body).starts_with("HTTP/1.1 400"))
                << call << body;
    const auto left_out = over_socket("POST", "/v1/run/exclude", R"({"cycle":0,"reason":"x"})");
    EXPECT_EQ(nlohmann::json::parse(body_of(left_out)).at("excluded"), 1);
}

TEST_F(HttpDoor, AnAnswerToAFindingNamesFindingAndText) {
    for (const char* body :
         {R"({})", R"({"finding":"growth"})", R"({"finding":"growth","text":" "})",
          R"({"text":"x"})", R"({"finding":3,"text":"x"})",
          R"({"finding":"growth","text":"x","reason":"x"})"})
        EXPECT_TRUE(over_socket("POST", "/v1/run/answer", body).starts_with("HTTP/1.1 400"))
            << body;
    const auto kept =
        over_socket("POST", "/v1/run/answer", R"({"finding":"growth","text":"x","by":"D"})");
    EXPECT_EQ(nlohmann::json::parse(body_of(kept)).at("answer"), "kept");
    EXPECT_EQ(station.answered.finding, "growth");
    EXPECT_EQ(station.answered.text, "x");
    EXPECT_EQ(station.answered.by.name, "D");
    EXPECT_EQ(station.answered.by.uid, ::getuid());
}

TEST_F(HttpDoor, AnUnknownFieldIsRefusedByName) {
    const std::string reply = over_socket("POST", "/v1/run", R"({"datum":-4.5})");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 400")) << reply;
    EXPECT_EQ(nlohmann::json::parse(body_of(reply)).at("error").at("field"), "datum");
}

TEST_F(HttpDoor, ABusyStationAnswersConflict) {
    EXPECT_TRUE(over_socket("POST", "/v1/run", R"({"pass":"busy"})").starts_with("HTTP/1.1 409"));
}

TEST_F(HttpDoor, ARefusedTriggerTellsTheSentence) {
    const std::string reply = over_socket("POST", "/v1/run/trigger");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 409")) << reply;
    EXPECT_NE(reply.find("axiscal arm"), std::string::npos);
}

TEST_F(HttpDoor, ATypedReadingIsHandedOverInSecondsOfArc) {
    EXPECT_TRUE(
        over_socket("POST", "/v1/run/reading", R"({"arcsec":-1.25})").starts_with("HTTP/1.1 202"));
    EXPECT_EQ(station.typed_arcsec, -1.25);
    for (const char* wrong : {R"({"arcsec":"1"})", R"({"arcmin":1})", "{}"})
        EXPECT_TRUE(over_socket("POST", "/v1/run/reading", wrong).starts_with("HTTP/1.1 400"))
            << wrong;
    const std::string beyond = over_socket("POST", "/v1/run/reading", R"({"arcsec":101})");
    EXPECT_TRUE(beyond.starts_with("HTTP/1.1 409")) << beyond;
    EXPECT_NE(beyond.find("outside_window"), std::string::npos) << beyond;
}

TEST_F(HttpDoor, AbortHandsTheReasonOver) {
    EXPECT_TRUE(over_socket("POST", "/v1/run/abort", R"({"reason":"coolant"})")
                    .starts_with("HTTP/1.1 200"));
    EXPECT_EQ(station.reason_given, "coolant");
}

TEST_F(HttpDoor, AnAbortSaysHowTheRunEnded) {
    const std::string in_time = over_socket("POST", "/v1/run/abort", R"({"reason":"coolant"})");
    EXPECT_NE(in_time.find(R"("run":"aborted")"), std::string::npos) << in_time;
    EXPECT_NE(in_time.find(R"("reason":"coolant")"), std::string::npos) << in_time;
    const std::string late = over_socket("POST", "/v1/run/abort", R"({"reason":"late"})");
    EXPECT_NE(late.find(R"("run":"complete")"), std::string::npos) << late;
    EXPECT_NE(late.find("Every planned point is durable."), std::string::npos) << late;
}

TEST_F(HttpDoor, AlignsByOrderAndShowsWhatIsSeen) {
    AlignmentRecord record;
    record.serial = "S-1";
    record.reached = record.travel = metre(1);
    record.far = FarRest{metre(1), um(9), um(8), um(0.1), 30, true};
    record.places = {{mm(0), mm(40), 10, 80, 85, 90}};
    station.aligned.record = record;
    EXPECT_NE(
        over_socket("POST", "/v1/alignment", R"({"action":"begin"})").find("\"running\":true"),
        std::string::npos);
    const auto kept =
        over_socket("POST", "/v1/alignment", R"({"action":"keep","spot_offset_mm":1.5})");
    ASSERT_TRUE(station.ordered);
    EXPECT_EQ(station.ordered->action, AlignmentAction::keep);
    EXPECT_EQ(station.ordered->spot_offset_mm, 1.5);
    const auto shown = nlohmann::json::parse(kept.substr(kept.find("\r\n\r\n")));
    EXPECT_NEAR(shown["record"]["cosine"]["error_um"].get<double>(), 1, 1e-6);
    EXPECT_NEAR(shown["record"]["cosine"]["bound_um"].get<double>(), 1.1, 1e-6);
    EXPECT_EQ(shown["record"]["places"][0]["weakest_percent"], 80);
    EXPECT_TRUE(over_tcp("GET", "/v1/alignment").starts_with("HTTP/1.1 200"));
}

TEST_F(HttpDoor, BeginsADriftTestByItsOrder) {
    EXPECT_TRUE(over_socket("POST", "/v1/drift",
                            R"({"duration_s":600,"interval_s":0.5,"place_mm":900,)"
                            R"("statements":{"operator":"Shift 2"}})")
                    .starts_with("HTTP/1.1 201"));
    ASSERT_TRUE(station.drifted);
    EXPECT_EQ(station.drifted->duration, std::chrono::minutes{10});
    EXPECT_EQ(station.drifted->interval, std::chrono::milliseconds{500});
    EXPECT_EQ(station.drifted->place_mm, 900);
    EXPECT_EQ(station.drifted->statements.at("operator"), "Shift 2");
    EXPECT_TRUE(over_socket("POST", "/v1/drift").starts_with("HTTP/1.1 201"));
    EXPECT_EQ(station.drifted->duration, std::chrono::minutes{30});
    EXPECT_FALSE(station.drifted->of_bar) << "the station knows what it has";
    EXPECT_TRUE(
        over_socket("POST", "/v1/drift", R"({"of":"ballbar"})").starts_with("HTTP/1.1 201"));
    EXPECT_EQ(station.drifted->of_bar, true);
    EXPECT_TRUE(over_socket("POST", "/v1/drift", R"({"of":"axis"})").starts_with("HTTP/1.1 201"));
    EXPECT_EQ(station.drifted->of_bar, false);
    for (const char* body :
         {R"({"of":"spindle"})", R"({"of":true})", R"({"duration_s":"1 h"})", R"({"interval_s":0})",
          R"({"place":1})", R"({"statements":{"colour":"red"}})",
          R"({"statements":{"next_due":"soon"}})", R"({"statements":{"next_due":"2027-02-30"}})",
          "[]"})
        EXPECT_TRUE(over_socket("POST", "/v1/drift", body).starts_with("HTTP/1.1 400")) << body;
}

TEST_F(HttpDoor, RefusesAnAlignmentOrderByItsField) {
    for (const char* body : {R"({"action":"start"})", R"({})", R"({"action":"keep","spot":1})",
                             R"({"action":"begin","spot_offset_mm":1})",
                             R"({"action":"keep","spot_offset_mm":"1"})", "[]"})
        EXPECT_TRUE(over_socket("POST", "/v1/alignment", body).starts_with("HTTP/1.1 400")) << body;
    EXPECT_TRUE(
        over_tcp("POST", "/v1/alignment", "", R"({"action":"begin"})").starts_with("HTTP/1.1 401"));
    EXPECT_FALSE(station.ordered);
}

TEST_F(HttpDoor, GarbageAndOversizedBodiesHurtNobody) {
    EXPECT_TRUE(over_socket("POST", "/v1/run", "[1,2").starts_with("HTTP/1.1 400"));
    over_socket("POST", "/v1/run", std::string(200'000, 'x'));
    const std::string nest = std::string(30'000, '[') + std::string(30'000, ']');
    for (const char* order : {"/v1/run", "/v1/drift"})
        EXPECT_TRUE(over_socket("POST", order, R"({"statements":)" + nest + "}")
                        .starts_with("HTTP/1.1 400"))
            << order;
    EXPECT_TRUE(
        over_tcp("DELETE", "/v1/run", "Authorization: Bearer " + std::string(64, 't') + "\r\n")
            .starts_with("HTTP/1.1 405"));
    EXPECT_TRUE(over_tcp("GET", "/nothing").starts_with("HTTP/1.1 404"));
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

// 2026-11-23: each of these ended the daemon, from anybody who reached the port.
TEST_F(HttpDoor, AHeadThatIsNoTextIsAnsweredInText) {
    for (const std::string& field :
         {std::string{"Host: \xff"}, std::string{"Host: localhost\r\nOrigin: http://\xff"},
          std::string{"Host: \xed\xa0\x80\xc0\xaf"}}) {
        const std::string reply =
            raw_over_tcp("GET /v1/status HTTP/1.1\r\n" + field + "\r\nConnection: close\r\n\r\n");
        ASSERT_TRUE(reply.starts_with("HTTP/1.1 4")) << reply;
        const auto body = nlohmann::json::parse(body_of(reply));
        EXPECT_NE(body.at("error").at("sentence").get<std::string>().find("\uFFFD"),
                  std::string::npos);
    }
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

// 2026-11-23: a line of a noisy gauge in a note ended the daemon at the next status.
TEST_F(HttpDoor, ANoteThatIsNoTextIsShownAsText) {
    station.notes = {"gauge: \"\xff\xfe 0,4\""};
    const std::string reply = over_tcp("GET", "/v1/status");
    ASSERT_TRUE(reply.starts_with("HTTP/1.1 200")) << reply;
    EXPECT_EQ(nlohmann::json::parse(body_of(reply)).at("notes").at(0),
              "gauge: \"\uFFFD\uFFFD 0,4\"");
}

TEST_F(HttpDoor, WhatOneRequestThrowsEndsThatRequestAlone) {
    const std::string reply = over_socket("POST", "/v1/run/abort", R"({"reason":"bug"})");
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 500")) << reply;
    EXPECT_NE(reply.find("a bug of one request"), std::string::npos);
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

TEST_F(HttpDoor, WhatIsNoRequestIsAnsweredInJsonAndEndsTheConnection) {
    const std::string start = "POST /v1/run HTTP/1.1\r\nHost: localhost\r\n";
    const std::pair<std::string, std::string> wrong[] = {
        {start + "Content-Length: 70000\r\n\r\n" + std::string(70'000, 'x'), "413"},
        {start + "X-Long: " + std::string(9'000, 'y') + "\r\n\r\n", "431"},
        {"GET /" + std::string(70'000, 'a') + " HTTP/1.1\r\n\r\n", "431"},
        {"GARBAGE\r\n\r\n", "400"},
        {"GARBAGE\n", "400"},
        {std::string{"\x16\x03\x01\x02\x00\x01", 6}, "400"},
        {"GET /v1/status HTTP/9.9\r\n\r\n", "400"},
        {start + "Content-Length: seven\r\n\r\n", "400"},
        {start + "Expect: tea\r\nContent-Length: 2\r\n\r\n{}", "417"},
    };
    for (const auto& [bytes, status] : wrong) {
        const std::string reply = raw_over_tcp(bytes);
        ASSERT_TRUE(reply.starts_with("HTTP/1.1 " + status)) << bytes.substr(0, 80) << reply;
        EXPECT_NE(reply.find("Connection: close"), std::string::npos) << reply;
        const auto body = nlohmann::json::parse(body_of(reply));
        EXPECT_EQ(body.at("error").at("fault"), "bad_request") << reply;
        EXPECT_FALSE(body.at("error").at("sentence").get<std::string>().empty());
    }
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

TEST_F(HttpDoor, ARequestCutShortByItsEndIsAnswered) {
    asio::io_context own;
    asio::ip::tcp::socket socket{own};
    socket.connect(
        {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
    asio::write(socket, asio::buffer(std::string{"GARBAGE"}));
    socket.shutdown(asio::socket_base::shutdown_send);
    EXPECT_TRUE(talk(socket, "").starts_with("HTTP/1.1 400"));
}

// RFC 9110, 10.1.1: curl waits for it before it sends a long body.
TEST_F(HttpDoor, WhoAsksWhetherToGoOnIsToldSo) {
    asio::io_context own;
    asio::local::stream_protocol::socket socket{own};
    socket.connect({(folder / "door.sock").string()});
    asio::write(socket, asio::buffer(std::string{
                            "POST /v1/run/abort HTTP/1.1\r\nHost: x\r\nConnection: close\r\n"
                            "Expect: 100-Continue\r\nContent-Length: 20\r\n\r\n"}));
    std::string go_on(25, '\0');
    asio::read(socket, asio::buffer(go_on));
    EXPECT_EQ(go_on, "HTTP/1.1 100 Continue\r\n\r\n");
    EXPECT_TRUE(talk(socket, R"({"reason":"coolant"})").starts_with("HTTP/1.1 200"));
    EXPECT_EQ(station.reason_given, "coolant");
}

TEST_F(HttpDoor, APathIsKnownWithAQueryOrASlashBehindIt) {
    for (const char* target : {"/v1/status?x=1", "/v1/status/", "/v1/instruments/?"})
        EXPECT_TRUE(over_tcp("GET", target).starts_with("HTTP/1.1 200")) << target;
    EXPECT_TRUE(over_tcp("GET", "/v1/statuses").starts_with("HTTP/1.1 404"));
}

// A client that gave up after a minute left the order behind: the axis was armed all the same.
TEST_F(HttpDoor, TheStationHearsThatWhoArmsHasHungUp) {
    const std::string order = R"({"pass":"slow"})";
    const std::string head =
        " HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(order.size()) +
        "\r\nAuthorization: Bearer " + std::string(64, 't') + "\r\n\r\n";
    for (const bool over_network : {false, true}) {
        station.noticed = false;
        asio::io_context own;
        if (over_network) {
            asio::ip::tcp::socket socket{own};
            socket.connect(
                {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(server->port())});
            asio::write(socket, asio::buffer("POST /v1/run" + head + order));
        } else {
            asio::local::stream_protocol::socket socket{own};
            socket.connect({(folder / "door.sock").string()});
            asio::write(socket, asio::buffer("POST /v1/run" + head + order));
        }
        while (!station.noticed) // the test's own time limit ends a failure
            std::this_thread::yield();
    }
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

TEST_F(HttpDoor, WordsOfPeopleAreOneLineOfText) {
    over_socket("POST", "/v1/run",
                R"({"statements":{"operator":"A\u0000\u001b[2J\n(B) \u5de5 %"}})");
    EXPECT_EQ(station.armed.statements.at("operator"), "A  [2J (B) \u5de5 %");
    over_socket("POST", "/v1/run/abort", R"({"reason":"crash\r\nX: y"})");
    EXPECT_EQ(station.reason_given, "crash  X: y");
}

// 2026-11-23: 64 idle clients of the network locked the technician out of status and abort.
TEST_F(HttpDoor, ACrowdOnTheNetworkLeavesTheSocketOpen) {
    constexpr std::size_t limit = 64;
    asio::io_context own;
    std::vector<asio::ip::tcp::socket> crowd;
    const asio::ip::tcp::endpoint door{asio::ip::make_address("127.0.0.1"),
                                       static_cast<std::uint16_t>(server->port())};
    for (std::size_t i = 0; i < limit; ++i)
        crowd.emplace_back(own).connect(door);
    // One more is hung up on: all of the others sit inside.
    std::string reply;
    do {
        crowd.emplace_back(own).connect(door);
        reply = talk(crowd.back(), "GET /v1/status HTTP/1.1\r\nHost: localhost:" +
                                       std::to_string(server->port()) +
                                       "\r\nConnection: close\r\n\r\n");
    } while (!reply.empty() && crowd.size() < 3 * limit);
    EXPECT_EQ(reply, "");
    EXPECT_TRUE(over_socket("GET", "/v1/status").starts_with("HTTP/1.1 200"));
    EXPECT_TRUE(over_socket("POST", "/v1/run/abort", "{}").starts_with("HTTP/1.1 200"));
    EXPECT_EQ(station.reason_given, "aborted by the operator");
}

class HttpDoorWithAList : public HttpDoor {
protected:
    void configure(ConsoleConfig& config) override {
        config.allowed_clients = {parse_address_range("192.0.2.0/24").value()};
    }
};

TEST_F(HttpDoorWithAList, HangsUpOnWhomItDoesNotName) {
    EXPECT_EQ(over_tcp("GET", "/v1/status"), "");
    EXPECT_TRUE(over_socket("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

class HttpDoorWithItsOwnNetwork : public HttpDoor {
protected:
    void configure(ConsoleConfig& config) override {
        config.allowed_clients = {parse_address_range("192.0.2.7").value(),
                                  parse_address_range("127.0.0.0/8").value()};
    }
};

TEST_F(HttpDoorWithItsOwnNetwork, AnswersWhomItNames) {
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

TEST(Token, IsMadeOnceAndKept) {
    char name[] = "/tmp/axiscal-token-XXXXXX";
    const std::filesystem::path folder = ::mkdtemp(name);
    const auto first = load_or_make_token(folder / "token"),
               again = load_or_make_token(folder / "token");
    ASSERT_TRUE(first && again);
    EXPECT_EQ(*first, *again);
    EXPECT_EQ(first->size(), 64U);
    struct stat info {};
    ASSERT_EQ(::stat((folder / "token").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0640U);
    std::filesystem::remove_all(folder);
}

TEST(Token, ThatOthersMayReadOrWriteIsRefusedWithTheWayOut) {
    char name[] = "/tmp/axiscal-token-XXXXXX";
    const std::filesystem::path folder = ::mkdtemp(name);
    const auto token = load_or_make_token(folder / "token");
    ASSERT_TRUE(token);
    for (const mode_t wrong : {0644U, 0641U, 0660U, 0777U}) {
        ASSERT_EQ(::chmod((folder / "token").c_str(), wrong), 0);
        const auto refused = load_or_make_token(folder / "token");
        ASSERT_FALSE(refused) << std::oct << wrong;
        EXPECT_EQ(refused.error().fault, Fault::refused);
        EXPECT_NE(refused.error().detail.find("remove " + (folder / "token").string()),
                  std::string::npos)
            << refused.error().detail;
    }
    for (const mode_t right : {0640U, 0600U, 0400U}) {
        ASSERT_EQ(::chmod((folder / "token").c_str(), right), 0);
        EXPECT_EQ(load_or_make_token(folder / "token").value(), *token) << std::oct << right;
    }
    std::filesystem::rename(folder / "token", folder / "elsewhere");
    std::filesystem::create_symlink("elsewhere", folder / "token");
    EXPECT_EQ(load_or_make_token(folder / "token").error().fault, Fault::refused);
    std::filesystem::remove_all(folder);
}

// Its address may come with the network, long after the daemon: the socket must serve meanwhile.
class HttpDoorWithoutItsAddress : public HttpDoor {
protected:
    void configure(ConsoleConfig& config) override {
        taken.open(asio::ip::tcp::v4());
        taken.bind({asio::ip::make_address("127.0.0.1"), 0});
        taken.listen();
        config.port = taken.local_endpoint().port();
    }
    asio::io_context other;
    asio::ip::tcp::acceptor taken{other};
};

TEST_F(HttpDoorWithoutItsAddress, ServesTheSocketAndTakesTheAddressOnceItIsFree) {
    const std::string place = "127.0.0.1:" + std::to_string(server->port());
    const auto notes = [&] {
        return nlohmann::json::parse(body_of(over_socket("GET", "/v1/status"))).at("notes");
    };
    ASSERT_EQ(notes().size(), 1U);
    EXPECT_NE(notes().at(0).get<std::string>().find(place), std::string::npos) << notes();
    taken.close();
    while (!notes().empty()) // a second of the daemon's; the test's own time limit ends a failure
        std::this_thread::yield();
    EXPECT_TRUE(over_tcp("GET", "/v1/status").starts_with("HTTP/1.1 200"));
}

} // namespace
} // namespace axiscal::http_server_test

// What one test leaves to the next, of whatever kind.
#include "tests/support/full_disk.hpp"
#include "tests/support/report_script.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::testing::station_tests_test {
namespace {

struct Kind {
    const char* name;
    bool is_drift, of_bar;
    std::uint16_t last; ///< request of a whole test
};
constexpr Kind positioning{"positioning", false, false, 5}, circles{"circles", false, true, 3},
    drift{"drift", true, false, 0}, bar_drift{"drift of the ballbar", true, true, 0};
constexpr Kind kinds[]{positioning, circles, drift, bar_drift};

/// Holds up the report program of one run until it is let through.
class Gate {
public:
    Gate(const Shop& shop, const std::string& id) {
        const std::string path = shop.scratch.file("gate-" + id + ".axiscal");
        EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
        pipe_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC); // waits for nobody
    }
    ~Gate() { ::close(pipe_); }
    Gate(const Gate&) = delete;
    Gate& operator=(const Gate&) = delete;
    void let_through() const { EXPECT_EQ(::write(pipe_, "\n", 1), 1); }

private:
    int pipe_ = -1;
};

std::string gated_report(const Shop& shop) {
    return report_script(shop.scratch, "name=${1##*/}; read go <'" + shop.scratch.path() +
                                           R"(/gate-'"$name"
echo "{\"entry\": \"$3/${name%.axiscal}\"}")");
}

class StationTests : public ::testing::Test {
protected:
    void SetUp() override {
        shop.shorten(); // five points upwards
        shop.config.cycle.bidirectional = false;
        shop.config.circular.emplace().setup.bar_instrument = "ballbar";
        shop.config.ballbar = RoleConfig{"ballbar", "ballbar"};
        InstrumentConfig& bar = shop.config.instruments.emplace_back();
        bar.name = "ballbar";
        bar.driver = "made";
        shop.ballbar = [](MonotonicTime) { return 1e-3; };
    }
    static Result<std::string> begin(Life& life, const Kind& kind, Duration lasts = 1h) {
        const double datum_mm = life.shop.plan().datum.in(mm);
        life.shop.axis.go(datum_mm, life.scheduler.now());
        life.run(3s); // it is there, and a test that was ended is closed
        ArmRequest arming;
        if (kind.of_bar) arming.kind = TestKind::circular;
        DriftRequest resting;
        resting.of_bar = kind.of_bar;
        resting.duration = lasts;
        if (!kind.of_bar) resting.place_mm = datum_mm;
        const auto answer = kind.is_drift ? life.begin_drift(resting) : life.begin_arm(arming);
        life.run(2s);
        return *answer ? **answer : Result<std::string>{fail(Fault::internal, "still at it")};
    }
    static void ask(Life& life, std::uint16_t sequence, bool standing = false) {
        TriggerEvent event;
        event.sequence = sequence;
        event.standing = standing;
        life.ask(event);
        life.run(200ms);
    }
    static void finish(Life& life, const Kind& kind) {
        for (std::uint16_t sequence = 1; sequence <= kind.last; ++sequence)
            kind.of_bar ? ask(life, sequence) : void(life.take(sequence - 1));
        life.run(kind.is_drift ? 5s : 1s);
        const StationStatus status = life.status();
        EXPECT_EQ(kind.is_drift ? status.drift->state : status.run->state, "complete") << kind.name;
    }
    static std::string make(Life& life, const Kind& kind) {
        const auto id = begin(life, kind, 5s);
        EXPECT_TRUE(id) << kind.name << ": " << describe(id.error());
        if (id) finish(life, kind);
        return id.value_or("");
    }
    static RevisionRequest third_target() {
        RevisionRequest request;
        request.selection.target = 2;
        request.reason = "coolant";
        return request;
    }
    static std::string refusal_of_retake(Life& life) {
        const auto answer = life.retake(third_target());
        return answer ? "" : answer.error().detail;
    }
    static void
    expect_all_refused(Life& life, const std::string& words, Fault fault = Fault::busy) {
        for (const Kind& next : kinds) {
            const auto answer = begin(life, next);
            ASSERT_FALSE(answer) << next.name;
            EXPECT_EQ(answer.error().fault, fault) << next.name;
            EXPECT_NE(answer.error().detail.find(words), std::string::npos) << next.name;
        }
    }
    static std::string certificate_of(const Life& life, const std::string& id) {
        const StationStatus status = life.status();
        if (status.run && status.run->run_id == id) return status.run->certificate;
        if (status.drift && status.drift->run_id == id) return status.drift->certificate;
        return "not shown";
    }
    [[nodiscard]] RunFileContents contents(const std::string& id) const {
        return read_run_file_contents(shop.scratch.file("runs/" + id + ".axiscal")).value();
    }
    Shop shop;
};

TEST_F(StationTests, AClosedRunStillAnswersTheRepeatOfItsLastRequest) {
    for (const Kind& kind : {positioning, circles}) {
        Life life{shop};
        const std::string id = make(life, kind);
        const RunFileContents before = contents(id);
        for (const bool after_a_drift_test : {false, true}) {
            if (after_a_drift_test) make(life, drift);
            life.port->done = 0; // the CNC missed it
            ask(life, kind.last);
            EXPECT_EQ(life.port->done, kind.last) << kind.name << after_a_drift_test;
        }
        EXPECT_TRUE(life.port->refusals.empty()) << kind.name;
        ask(life, kind.last + 1);
        EXPECT_EQ(life.port->refusals.size(), 1U) << kind.name;
        EXPECT_EQ(contents(id).run.points.size(), before.run.points.size());
        EXPECT_EQ(contents(id).revisions.closings, before.revisions.closings);
    }
}

TEST_F(StationTests, RetakeWorksAfterADriftTest) {
    Life life{shop};
    const std::string id = make(life, positioning);
    for (const Kind& kind : {drift, bar_drift}) {
        ASSERT_TRUE(begin(life, kind)) << kind.name;
        EXPECT_EQ(refusal_of_retake(life), "a drift test is going on; let it end");
        ASSERT_TRUE(life.abort("enough"));
        make(life, kind);
    }
    const auto answer = life.retake(third_target());
    ASSERT_TRUE(answer) << describe(answer.error());
    EXPECT_EQ(answer->last_request, 5);
    EXPECT_EQ(life.status().run->run_id, id);
    ASSERT_TRUE(life.take(2, 6));
    const RunFileContents file = contents(id);
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(file.revisions.closings, 2);
    EXPECT_EQ(file.revisions.superseded.size(), 1U);
}

TEST_F(StationTests, RetakeIsRefusedAfterACircularTestAlsoByTheNextDaemon) {
    std::string run_id, circles_id;
    {
        Life life{shop};
        run_id = make(life, positioning);
        circles_id = begin(life, circles).value_or("");
        const std::string refusal = "the last run is a circular test: its circles are driven again";
        EXPECT_EQ(refusal_of_retake(life), refusal);
        finish(life, circles);
        EXPECT_EQ(refusal_of_retake(life), refusal);
    }
    Life life{shop};
    EXPECT_EQ(refusal_of_retake(life),
              "the last run, " + circles_id + ", is a circular test: its circles are driven again");
    EXPECT_EQ(contents(run_id).revisions.closings, 1);
}

TEST_F(StationTests, ADriftTestOfTheLastDaemonIsNotTakenForARun) {
    std::string drift_id;
    {
        Life life{shop};
        make(life, positioning);
        drift_id = make(life, drift);
    }
    Life life{shop};
    EXPECT_NE(refusal_of_retake(life).find("the last test, " + drift_id + ", is a drift test"),
              std::string::npos);
    EXPECT_FALSE(life.status().run);
}

TEST_F(StationTests, OneRunFileIsOpenAtATime) {
    Life life{shop};
    std::size_t files = 0;
    for (const Kind& first : kinds) {
        SCOPED_TRACE(first.name);
        const auto id = begin(life, first);
        ASSERT_TRUE(id) << describe(id.error());
        const std::string words = *id + (first.is_drift ? " is going on" : " is open");
        expect_all_refused(life, words);
        ASSERT_TRUE(life.abort("enough"));
        EXPECT_EQ(shop.run_files().size(), ++files);
    }
}

/// Its closing row is due: a test that began meanwhile would lose its file to it.
TEST_F(StationTests, NoneBeginsWhileTheFileOfTheLastRunIsNotClosed) {
    for (const Kind& last : {positioning, circles}) {
        SCOPED_TRACE(last.name);
        Life life{shop};
        ASSERT_TRUE(begin(life, last));
        {
            const FullDisk full;
            EXPECT_FALSE(life.abort("enough"));
            expect_all_refused(life, "the disk cannot store", Fault::not_durable);
        }
        life.run_until([&] { return life.notes_with("The run file is written again") > 0; });
        EXPECT_TRUE(begin(life, circles));
        EXPECT_TRUE(life.abort("enough"));
    }
}

/// The status shows one run and one drift test: what it shows no more has its note alone.
TEST_F(StationTests, ACertificateThatComesAfterTheNextTestBeganIsThatOfItsRunId) {
    Life life{shop, gated_report(shop)};
    for (const Kind& first : kinds) {
        for (const Kind& next : kinds) {
            SCOPED_TRACE(std::string{first.name} + ", then " + next.name);
            const auto id = begin(life, first, 5s);
            ASSERT_TRUE(id) << describe(id.error());
            const Gate gate{shop, *id};
            const std::string entry = shop.scratch.file("outbox/" + *id);
            finish(life, first);
            const auto next_id = begin(life, next);
            ASSERT_TRUE(next_id) << describe(next_id.error());
            const bool closed = first.of_bar; // meanwhile, else open
            ASSERT_TRUE(!closed || life.abort("enough"));
            gate.let_through();
            life.run_until([&] { return life.notes_with("written: " + entry) > 0; });
            const bool shown = first.is_drift != next.is_drift;
            EXPECT_EQ(certificate_of(life, *id), shown ? entry : "not shown");
            EXPECT_EQ(certificate_of(life, *next_id), "");
            ASSERT_TRUE(closed || life.abort("enough"));
        }
    }
}

TEST_F(StationTests, AfterARestartTheLastRequestIsAnsweredAndNotCapturedAgain) {
    {
        Life life{shop};
        ASSERT_TRUE(begin(life, positioning));
        life.run(10s); // older than what a restart counts again
        ASSERT_TRUE(life.take(0) && life.take(1) && life.take(2));
    }
    Life life{shop};
    EXPECT_EQ(life.port->done_before_open, 3);
    for (const bool standing : {true, false}) {
        ask(life, 3, standing);
        life.run(3s); // the axis still rests at the point
    }
    EXPECT_EQ(life.port->acknowledged, (std::vector<std::uint16_t>{3, 3, 3}));
    EXPECT_EQ(contents(life.status().run->run_id).run.points.size(), 3U);
    EXPECT_TRUE(life.take(3));
}

TEST_F(StationTests, AClosedTestShowsItsLastRequestAlsoAfterARestartBeforeThePortOpens) {
    for (const Kind& kind : {positioning, circles}) {
        {
            Life life{shop};
            make(life, kind);
            ask(life, kind.last);
            EXPECT_EQ(life.port->done, kind.last) << kind.name;
        }
        Life life{shop};
        EXPECT_EQ(life.port->done_before_open, kind.last) << kind.name;
        ask(life, kind.last, true);
        EXPECT_EQ(life.port->done, kind.last) << kind.name;
        EXPECT_TRUE(life.port->refusals.empty()) << kind.name;
        EXPECT_FALSE(life.status().run_open) << "nothing is captured again";
    }
}

} // namespace
} // namespace axiscal::testing::station_tests_test

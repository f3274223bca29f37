// A tape in the place of an instrument's link: its driver says what is expected, and nobody takes
// it for an instrument.
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <fstream>
#include <sstream>

namespace axiscal::testing::station_tape_test {
namespace {

std::string traced(const std::string& name) {
    std::ifstream file{test::source_dir() + "/tests/traces/" + name};
    EXPECT_TRUE(file) << name;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// What the supervisor passes on, as the lines of an expectation.
class Heard final : public SupervisorListener {
public:
    explicit Heard(MonotonicTime begin)
        : sink{begin} {}
    void on_sample(const Sample& sample) override { sink.take(sample); }
    void on_instrument_state(const InstrumentView& view) override {
        states.emplace_back(shown_state(view));
    }
    void on_instrument_note(const InstrumentView& view) override {
        notes.push_back(view.last_note);
    }
    SampleRecorder sink;
    std::vector<std::string> states, notes;
};

/// The lines of samples alone; others are not the supervisor's.
std::string samples_of(const std::string& expectation) {
    std::istringstream lines{expectation};
    std::string kept;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("+")) kept += line + "\n";
    return kept;
}

std::string last_line(const std::string& expectation) {
    std::istringstream lines{expectation};
    std::string last;
    for (std::string line; std::getline(lines, line);)
        last = line;
    return last;
}

struct SeatedCase {
    std::string tape, driver, keys;
};
std::ostream& operator<<(std::ostream& out, const SeatedCase& which) {
    return out << which.tape;
}

class SeatedTapes : public ::testing::TestWithParam<SeatedCase> {};

TEST_P(SeatedTapes, GiveWhatIsExpectedInThePlaceOfTheLink) {
    const SeatedCase& which = GetParam();
    auto tape = parse_tape(traced(which.tape + ".tape"));
    ASSERT_TRUE(tape) << describe(tape.error());
    VirtualScheduler scheduler;
    PlugBoard real;
    real.plugged = false;
    Heard heard{scheduler.now()};
    Supervisor supervisor{scheduler, real, heard};
    InstrumentConfig config;
    config.name = "stand-in";
    config.tape = "/traces/" + which.tape;
    auto made = instrument(which.driver, which.keys);
    heard.sink.name_channels(made->channels());
    supervisor.add(config, std::move(made), *std::move(tape));
    supervisor.start();
    scheduler.run_for(60s);
    const std::string expected = traced(which.tape + ".expected");
    EXPECT_EQ(samples_of(heard.sink.text()), samples_of(expected));
    const InstrumentView view = supervisor.view().at(0);
    EXPECT_EQ(text_of(view.counters), last_line(expected));
    EXPECT_EQ(heard.states, (std::vector<std::string>{"tape", "unavailable"}));
    EXPECT_EQ(view.last_note, "the tape is at its end");
    EXPECT_EQ(view.restarts, 1U); // it is not opened for ever
    EXPECT_EQ(real.openings, 0);
}

INSTANTIATE_TEST_SUITE_P(
    StationTape,
    SeatedTapes,
    ::testing::Values(
        SeatedCase{"dracal-usbtenki-pth", "dracal-usbtenki", "link = \"usb:any\"\n"},
        SeatedCase{"temper-x", "temper", "link = \"usb:any\"\n"},
        SeatedCase{"labjack-u6-stream", "labjack-u6",
                   "link = \"usb:470012345\"\nscale_length = \"1 mm\"\n"},
        SeatedCase{"ds18b20", "ds18b20", "sensors = [\"28-0000075b3c2a\", \"28-0000075b3c2b\"]\n"},
        SeatedCase{"canopen-404-cantrans", "canopen-404", "link = \"can:can0\"\n"},
        SeatedCase{"canopen-406-temposonics", "canopen-406", "link = \"can:can0\"\n"}),
    [](const auto& which) {
        std::string name = which.param.tape;
        std::erase(name, '-');
        return name;
    });

/// A driver that asks for something else is not answered.
TEST(StationTape, ADriverThatWritesSomethingElseIsToldSo) {
    auto tape = parse_tape("origin = simulator\n> 0 3f\n");
    ASSERT_TRUE(tape);
    VirtualScheduler scheduler;
    PlugBoard real;
    Heard heard{scheduler.now()};
    Supervisor supervisor{scheduler, real, heard};
    InstrumentConfig config;
    config.tape = "/other.tape";
    supervisor.add(config, instrument("temper", "link = \"usb:any\"\n"), *std::move(tape));
    supervisor.start();
    scheduler.run_for(10s);
    ASSERT_FALSE(heard.notes.empty());
    EXPECT_NE(heard.notes.front().find("writes what the tape does not know"), std::string::npos)
        << heard.notes.front();
    EXPECT_TRUE(heard.states.empty());
    EXPECT_EQ(supervisor.view().at(0).state, InstrumentState::unavailable);
}

class StationWithATape : public ::testing::Test {
protected:
    StationWithATape() { shop.config.instruments[1].tape = "/traces/air.tape"; }
    Shop shop;
};

TEST_F(StationWithATape, ArmsNothingWhateverReasonIsGiven) {
    Life life{shop};
    ArmRequest request;
    request.overrides["instruments"] = "the customer waits";
    const auto armed = life.arm(request);
    ASSERT_FALSE(armed);
    EXPECT_EQ(armed.error().fault, Fault::refused);
    EXPECT_NE(armed.error().detail.find("air plays the tape /traces/air.tape"), std::string::npos)
        << armed.error().detail;
    request.kind = TestKind::circular;
    const auto circles = life.arm(request);
    ASSERT_FALSE(circles);
    EXPECT_NE(circles.error().detail.find("/traces/air.tape"), std::string::npos);
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationWithATape, BeginsNoDriftTest) {
    Life life{shop};
    life.run(4s);
    DriftRequest request;
    request.duration = 60s;
    request.interval = 1s;
    const auto answer = life.begin_drift(request);
    ASSERT_TRUE(*answer);
    ASSERT_FALSE(**answer);
    EXPECT_EQ((**answer).error().fault, Fault::refused);
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationWithATape, SaysSoInStateNotesAndPreflight) {
    Life life{shop};
    life.run(4s);
    const auto views = life.status().instruments;
    EXPECT_EQ(shown_state(views[0]), "available");
    EXPECT_EQ(shown_state(views[1]), "tape");
    EXPECT_EQ(views[1].tape, "/traces/air.tape");
    EXPECT_EQ(life.notes_with("air plays a tape"), 1);
    EXPECT_EQ(life.notes_with("air is available"), 0);
    const auto checks = life.preflight({});
    ASSERT_TRUE(checks);
    const auto check = std::ranges::find(*checks, "instruments", &PreflightRecord::name);
    ASSERT_NE(check, checks->end());
    EXPECT_FALSE(check->passed);
    EXPECT_NE(check->verdict.find("air plays a tape and is no instrument"), std::string::npos)
        << check->verdict;
}

} // namespace
} // namespace axiscal::testing::station_tape_test

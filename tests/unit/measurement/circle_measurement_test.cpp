// A circular test as an object: what it answers a CNC, how it ends, how it goes on after a restart,
// and that it lives as long as its tasks.
#include "acquisition/measurement/circular/circle_measurement.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/circular/left_circles.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "drivers/instrument.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/wire/byte_link.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <boost/asio/co_spawn.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace axiscal::testing::circle_measurement_test {
namespace {

using namespace std::chrono_literals;

constexpr int bar = 0, contact = 1; // channels

/// A ballbar with a sensor on it; its readings are made by the bench.
class MadeBar final : public Instrument {
public:
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    Task<Result<void>> run(InstrumentContext) override {
        co_return fail(Fault::link_closed, "is made");
    }

private:
    std::vector<Channel> channels_{{"length", ChannelKind::displacement},
                                   {"contact", ChannelKind::temperature, Medium::material}};
    InstrumentCounters counters_;
};

class NoLinks final : public LinkOpener {
public:
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings&, MonotonicTime) override {
        co_return fail(Fault::link_closed, "there is none");
    }
};

class Deaf final : public SupervisorListener {
public:
    void on_sample(const Sample&) override {}
    void on_instrument_state(const InstrumentView&) override {}
    void on_instrument_note(const InstrumentView&) override {}
};

/// What the CNC would read.
class SeenByCnc final : public CncAnswer {
public:
    void publish_armed() override { ++armed; }
    void acknowledge(const JournalReceipt& receipt) override { done.push_back(receipt.sequence()); }
    void refuse_on_port(std::uint16_t, const Error& error) override {
        refusals.push_back(error.fault);
    }
    void publish_no_run() override { ++broken_off; }
    void show(PortState of) override { state = of; }

    int armed = 0, broken_off = 0;
    std::vector<std::uint16_t> done;
    std::vector<Fault> refusals;
    PortState state = PortState::idle;
};

/// What a station gives a test, and samples each 20 ms.
struct Bench {
    Bench() {
        config.state_directory = scratch.path();
        std::filesystem::create_directories(scratch.file("runs"));
        roles.ballbar = bar;
        roles.bar_temperature = contact;
        InstrumentConfig made;
        made.name = "ballbar";
        made.driver = "made";
        instruments.add(made, std::make_unique<MadeBar>());
        readings.emplace(config, roles, instruments.channels());
        context.emplace(CncContext{
            {scheduler, journal, notices, *readings, config, files, certificates, stopping},
            cnc,
            roles,
            instruments,
            config_hash,
            boot});
        spawn(scheduler, speak());
        scheduler.run_for(1s);
    }
    Task<void> speak() {
        for (;;) {
            co_await scheduler.sleep_for(20ms);
            const MonotonicTime now = scheduler.now();
            take(Sample{bar, now, 1e-3, ++number});
            take(Sample{contact, now, 22.5});
        }
    }
    void take(const Sample& sample) {
        readings->take(sample);
        if (test) test->on_sample(sample);
    }

    ScratchFolder scratch;
    VirtualScheduler scheduler; // before the rest: tasks end with the loop
    StationConfig config;
    StationRoles roles;
    NoLinks links;
    Deaf deaf;
    Supervisor instruments{scheduler, links, deaf};
    std::optional<LiveReadings> readings;
    Doorbell bell{scheduler.executor()};
    Notices notices{scheduler, bell};
    Journal journal{scheduler, JournalThread::caller};
    bool stopping = false;
    RunFileCloser files{scheduler, journal, notices, stopping};
    Certificates certificates{scheduler, notices, "/nonexistent/axiscal-report",
                              scratch.file("outbox")};
    SeenByCnc cnc;
    std::string config_hash = "hash";
    BootId boot{"boot"};
    std::optional<CncContext> context;
    std::uint64_t number = 0;                ///< of the last sample
    std::shared_ptr<CircleMeasurement> test; ///< as a station holds it
};

class CircleMeasurements : public ::testing::Test {
protected:
    using Shared = std::shared_ptr<CircleMeasurement>;

    template <class T> T outcome_of(Task<T> task) {
        const auto answer = std::make_shared<std::optional<T>>();
        boost::asio::co_spawn(bench.scheduler.loop(), std::move(task),
                              [answer](std::exception_ptr, T of) { *answer = std::move(of); });
        bench.scheduler.run_for(100ms);
        return answer->value();
    }
    /// Counter-clockwise, then clockwise: requests 1, 2 and 3.
    ArmedCircles two_circles() const {
        ArmedCircles armed;
        armed.header.run_id = "bench-XY-circle";
        armed.header.kind = TestKind::circular;
        armed.header.config_hash = bench.config_hash;
        armed.header.boot_id = bench.boot;
        armed.header.plan.approaches = 0;
        armed.header.plan.bidirectional = false;
        for (const StationChannel& channel : bench.instruments.channels())
            armed.header.channels.push_back({channel.id, channel.shown, channel.instrument_name,
                                             channel.place, channel.kind, channel.medium,
                                             channel.correction});
        armed.setup.plan.nominal_radius_mm = 50;
        armed.setup.plan.feed_mm_per_s = 100;
        armed.setup.bar_temperature_channel = contact;
        return armed;
    }
    Shared begin() {
        bench.test = outcome_of(CircleMeasurement::open(*bench.context, two_circles())).value();
        Orderer by;
        by.name = "Jo";
        bench.test->begin(by);
        return bench.test;
    }
    bool ask(std::uint16_t sequence) {
        TriggerEvent event;
        event.at = bench.scheduler.now();
        event.sequence = sequence;
        const bool taken = bench.test->on_trigger(event);
        bench.scheduler.run_for(1s);
        return taken;
    }
    /// The daemon ends, another one finds the file.
    Result<void> restart() {
        const std::string path = bench.test->run().path;
        EXPECT_TRUE(outcome_of(bench.journal.flush()));
        bench.test.reset();
        spawn(bench.scheduler, bench.journal.let_go());
        bench.scheduler.run_for(1s);
        RunFileContents left = file_of(path);
        CircleResume verdict = judge_left_circles(*bench.context, left);
        EXPECT_EQ(verdict.decision, CircleResume::Decision::go_on) << verdict.sentence;
        bench.test = outcome_of(CircleMeasurement::reopen(*bench.context, path, std::move(left),
                                                          std::move(verdict)))
                         .value();
        return outcome_of(bench.test->go_on());
    }
    static RunFileContents file_of(const std::string& path) {
        return read_run_file_contents(path).value();
    }
    [[nodiscard]] int notes_with(const std::string& words) const {
        return static_cast<int>(
            std::ranges::count_if(bench.notices.last(), [&](const std::string& sentence) {
                return sentence.find(words) != std::string::npos;
            }));
    }
    Bench bench;
};

using Numbers = std::vector<std::uint16_t>;

TEST_F(CircleMeasurements, AnswerEachRequestAndCloseWithTheLast) {
    const Shared test = begin();
    EXPECT_EQ(bench.cnc.armed, 1);
    EXPECT_EQ(bench.cnc.state, PortState::armed);
    EXPECT_EQ(notes_with("bench-XY-circle was armed by Jo."), 1);
    EXPECT_EQ(test->status().state, "armed");
    EXPECT_TRUE(ask(1) && ask(2));
    EXPECT_EQ(test->status().done, 2);
    EXPECT_TRUE(test->stream(10)->recording);
    EXPECT_TRUE(ask(3));
    EXPECT_EQ(bench.cnc.done, (Numbers{1, 2, 3}));
    EXPECT_EQ(test->status().state, "complete");
    EXPECT_FALSE(test->broken_off());
    EXPECT_TRUE(test->run().is_written());
    EXPECT_EQ(bench.cnc.broken_off, 0);
    const RunFileContents file = file_of(test->run().path);
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_TRUE(std::holds_alternative<CircularSetup>(file.attachments.setup));
    EXPECT_FALSE(file.blocks.empty());
    EXPECT_EQ(file.revisions.orders.at(0).kind, "arm");
}

TEST_F(CircleMeasurements, ThatAreClosedAnswerTheRepeatOfTheirLastRequestAlone) {
    begin();
    EXPECT_TRUE(ask(1) && ask(2) && ask(3));
    EXPECT_TRUE(ask(3));
    EXPECT_EQ(bench.cnc.done, (Numbers{1, 2, 3, 3}));
    EXPECT_FALSE(ask(2));
    EXPECT_FALSE(ask(4));
    const auto refused = bench.test->trigger();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::no_run_armed);
}

TEST_F(CircleMeasurements, RefuseWhatIsOutOfOrder) {
    begin();
    EXPECT_TRUE(ask(2)) << "it is theirs to refuse";
    EXPECT_EQ(bench.cnc.refusals, std::vector<Fault>{Fault::sequence_lost});
    EXPECT_EQ(bench.test->status().last_fault, fault_name(Fault::sequence_lost));
    EXPECT_TRUE(ask(1));
    EXPECT_TRUE(bench.test->status().last_fault.empty());
    EXPECT_EQ(bench.cnc.done, Numbers{1});
}

TEST_F(CircleMeasurements, TakeAPersonForACnc) {
    begin();
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(bench.test->trigger());
        bench.scheduler.run_for(1s);
    }
    EXPECT_TRUE(bench.test->run().complete);
}

TEST_F(CircleMeasurements, RecordTheTemperatureOfTheBarTwiceASecond) {
    const Shared test = begin();
    bench.scheduler.run_for(10s);
    const auto end = outcome_of(test->abort("enough", Orderer{}));
    ASSERT_TRUE(end);
    const auto readings = std::ranges::count(file_of(test->run().path).run.environment, contact,
                                             &EnvironmentReading::channel);
    EXPECT_NEAR(static_cast<double>(readings), 20, 1);
}

TEST_F(CircleMeasurements, ThatAreAbortedAreClosedAsIncompleteWithTheReason) {
    const Shared test = begin();
    ask(1);
    const auto end = outcome_of(test->abort("enough", Orderer{}));
    ASSERT_TRUE(end);
    EXPECT_FALSE(end->complete);
    EXPECT_EQ(end->reason, "enough");
    EXPECT_TRUE(test->broken_off());
    EXPECT_EQ(bench.cnc.broken_off, 1);
    EXPECT_EQ(bench.cnc.state, PortState::idle);
    EXPECT_EQ(test->status().last_sentence, "enough");
    EXPECT_FALSE(test->run().no_certificate) << "none is made";
    const RunFileContents file = file_of(test->run().path);
    EXPECT_TRUE(file.closed);
    EXPECT_EQ(file.run.closing_reason, "enough");
    const auto again = outcome_of(test->abort("more", Orderer{}));
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().fault, Fault::no_run_armed);
}

TEST_F(CircleMeasurements, GoOnAfterARestartAtTheCircleThatWasCut) {
    begin();
    ask(1);
    ASSERT_TRUE(restart());
    EXPECT_EQ(bench.cnc.armed, 1) << "done stays";
    EXPECT_EQ(bench.test->status().done, 1);
    EXPECT_EQ(notes_with("Circle 1 of 2 was not recorded to its end"), 1);
    EXPECT_TRUE(ask(1));
    EXPECT_EQ(bench.cnc.done, (Numbers{1, 1}));
    EXPECT_TRUE(ask(2)) << "nobody saw circle 1";
    EXPECT_EQ(bench.cnc.refusals, std::vector<Fault>{Fault::incomplete_run});
    EXPECT_TRUE(bench.test->broken_off());
    EXPECT_EQ(bench.test->run().fault, Fault::incomplete_run);
    EXPECT_TRUE(file_of(bench.test->run().path).closed);
}

TEST_F(CircleMeasurements, LeftOpenEndWithAnotherStationFile) {
    begin();
    bench.scheduler.run_for(3s);
    const RunFileContents left = file_of(bench.test->run().path);
    bench.config_hash = "another";
    const CircleResume verdict = judge_left_circles(*bench.context, left);
    EXPECT_EQ(verdict.decision, CircleResume::Decision::close_incomplete);
    EXPECT_EQ(verdict.fault, Fault::bad_configuration);
}

TEST_F(CircleMeasurements, LiveAsLongAsTheirTasks) {
    Shared test = begin();
    const std::string path = test->run().path;
    const std::weak_ptr<CircleMeasurement> seen = test;
    ask(1);
    ask(2);
    TriggerEvent last;
    last.at = bench.scheduler.now();
    last.sequence = 3;
    test->on_trigger(last);
    test.reset();
    bench.test.reset(); // as when the next one takes its place
    EXPECT_FALSE(seen.expired());
    bench.scheduler.run_for(5s);
    EXPECT_TRUE(seen.expired());
    EXPECT_TRUE(file_of(path).run.complete);
}

} // namespace
} // namespace axiscal::testing::circle_measurement_test

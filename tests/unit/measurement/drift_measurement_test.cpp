// A drift test as an object: what it records, how it ends, and that it lives as long as its tasks.
#include "acquisition/measurement/drift/drift_measurement.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/certificates.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/loop/spawn.hpp"
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

namespace axiscal::testing::drift_measurement_test {
namespace {

using namespace std::chrono_literals;

constexpr int light = 0, contact = 1, bar = 2; // channels

StationChannel channel_of(int id, const char* name, ChannelKind kind) {
    StationChannel channel;
    channel.id = channel.instrument = id;
    channel.name = channel.shown = channel.instrument_name = name;
    channel.kind = kind;
    return channel;
}

std::vector<StationChannel> all_channels() {
    return {channel_of(light, "laser", ChannelKind::displacement),
            channel_of(contact, "material", ChannelKind::temperature),
            channel_of(bar, "ballbar", ChannelKind::displacement)};
}

/// What a station gives a test, and samples each 20 ms: the laser's rise by 1 um a second, the
/// other ones stand.
struct Bench {
    Bench() {
        config.state_directory = scratch.path();
        std::filesystem::create_directories(scratch.file("runs"));
        spawn(scheduler, speak());
        scheduler.run_for(1s);
    }
    Task<void> speak() {
        for (;;) {
            co_await scheduler.sleep_for(20ms);
            const MonotonicTime now = scheduler.now();
            const Sample of_light{light, now, 1e-6 * seconds_of(now - MonotonicTime{}), 0, epoch};
            readings.take_reference(of_light);
            take(of_light);
            take(Sample{contact, now, 22.5});
            take(Sample{bar, now, 1e-3});
        }
    }
    void take(const Sample& sample) {
        readings.take(sample);
        if (test) test->on_sample(sample);
    }
    [[nodiscard]] int notes_with(const std::string& words) const {
        return static_cast<int>(
            std::ranges::count_if(notices.last(), [&](const std::string& sentence) {
                return sentence.find(words) != std::string::npos;
            }));
    }

    ScratchFolder scratch;
    VirtualScheduler scheduler; // before the rest: tasks end with the loop
    StationConfig config;
    StationRoles roles;
    LiveReadings readings{config, roles, all_channels()};
    Doorbell bell{scheduler.executor()};
    Notices notices{scheduler, bell};
    Journal journal{scheduler, JournalThread::caller};
    bool stopping = false;
    RunFileCloser files{scheduler, journal, notices, stopping};
    Certificates certificates{scheduler, notices, "/nonexistent/axiscal-report",
                              scratch.file("outbox")};
    MeasurementContext context{scheduler, journal, notices,      readings,
                               config,    files,   certificates, stopping};
    std::uint32_t epoch = 0;                ///< of the laser's counter
    std::shared_ptr<DriftMeasurement> test; ///< as a station holds it
};

class DriftMeasurements : public ::testing::Test {
protected:
    using Shared = std::shared_ptr<DriftMeasurement>;

    static RestingTest ten_seconds(bool of_bar) {
        RestingTest order;
        order.header.run_id = of_bar ? "bench-ballbar-drift" : "bench-X-drift";
        order.header.kind = TestKind::drift;
        order.setup = DriftSetup{10s, 1s, of_bar ? Length{} : mm(900), of_bar};
        order.watched = of_bar ? bar : light;
        return order;
    }
    /// Makes the file and records.
    Shared begin(bool of_bar = false) {
        std::optional<Result<Shared>> opened;
        boost::asio::co_spawn(
            bench.scheduler.loop(), DriftMeasurement::open(bench.context, ten_seconds(of_bar)),
            [&opened](std::exception_ptr, Result<Shared> test) { opened = std::move(test); });
        bench.scheduler.run_for(10ms);
        bench.test = opened->value();
        Orderer by;
        by.name = "Jo";
        bench.test->begin(by);
        return bench.test;
    }
    std::optional<Result<RunEnding>> abort(const Shared& test) {
        const auto answer = std::make_shared<std::optional<Result<RunEnding>>>();
        boost::asio::co_spawn(
            bench.scheduler.loop(), test->abort("enough", Orderer{}),
            [answer](std::exception_ptr, Result<RunEnding> end) { *answer = std::move(end); });
        bench.scheduler.run_for(100ms);
        return *answer;
    }
    static RunFileContents file_of(const std::string& path) {
        return read_run_file_contents(path).value();
    }
    static std::ptrdiff_t readings_of(const RunFileContents& file, int channel) {
        return std::ranges::count(file.run.environment, channel, &EnvironmentReading::channel);
    }
    Bench bench;
};

TEST_F(DriftMeasurements, RecordEachIntervalAndCloseTheirFile) {
    const Shared test = begin();
    EXPECT_TRUE(test->is_open());
    EXPECT_EQ(test->view().state, "recording");
    EXPECT_EQ(test->view().place_mm, 900);
    EXPECT_EQ(bench.notes_with("bench-X-drift has begun, ordered by Jo"), 1);
    bench.scheduler.run_for(11s);
    EXPECT_FALSE(test->is_open());
    EXPECT_TRUE(test->run().complete);
    EXPECT_EQ(test->view().state, "complete");
    EXPECT_EQ(test->view().taken, 10);
    EXPECT_NEAR(test->view().range_um.value(), 9, 0.05);
    const RunFileContents file = file_of(test->run().path);
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(std::get<DriftSetup>(file.attachments.setup).place, mm(900));
    EXPECT_EQ(readings_of(file, light), 10);
    EXPECT_EQ(readings_of(file, contact), 10);
    EXPECT_EQ(file.revisions.orders.at(0).kind, "drift");
}

TEST_F(DriftMeasurements, WithoutACertificateSaySo) {
    const Shared test = begin();
    bench.scheduler.run_for(11s);
    EXPECT_TRUE(test->run().certificate.empty());
    ASSERT_TRUE(test->run().no_certificate);
    EXPECT_EQ(test->view().sentence, describe(*test->run().no_certificate));
}

TEST_F(DriftMeasurements, OfABallbarWatchItsSamplesAlone) {
    const Shared test = begin(true);
    bench.scheduler.run_for(11s);
    const DriftView view = test->view();
    EXPECT_TRUE(view.of_bar);
    EXPECT_FALSE(view.place_mm);
    EXPECT_EQ(view.taken, 10);
    EXPECT_EQ(view.missing, 0);
    EXPECT_NEAR(view.range_um.value(), 0, 1e-9) << "the laser's rises";
}

TEST_F(DriftMeasurements, ThatAreAbortedAreClosedAsIncompleteWithTheReason) {
    const Shared test = begin();
    bench.scheduler.run_for(3s);
    const auto answer = abort(test);
    ASSERT_TRUE(answer && *answer);
    EXPECT_FALSE((*answer)->complete);
    EXPECT_EQ((*answer)->reason, "enough");
    EXPECT_EQ(test->view().state, "incomplete");
    EXPECT_FALSE(test->run().no_certificate) << "none is made";
    const RunFileContents file = file_of(test->run().path);
    EXPECT_TRUE(file.closed);
    EXPECT_FALSE(file.run.complete);
    EXPECT_EQ(file.run.closing_reason, "enough");
    const auto again = abort(test);
    ASSERT_TRUE(again && !*again);
    EXPECT_EQ(again->error().fault, Fault::busy);
}

TEST_F(DriftMeasurements, EndWhereTheCounterLosesItsZero) {
    const Shared test = begin();
    bench.scheduler.run_for(3s);
    ++bench.epoch;
    bench.scheduler.run_for(2s);
    EXPECT_FALSE(test->is_open());
    EXPECT_FALSE(test->run().complete);
    EXPECT_NE(test->run().reason.find("lost its zero"), std::string::npos);
}

TEST_F(DriftMeasurements, LiveAsLongAsTheirTasks) {
    Shared test = begin();
    const std::string path = test->run().path;
    const std::weak_ptr<DriftMeasurement> seen = test;
    test.reset();
    bench.test.reset(); // as when the next one takes its place
    bench.scheduler.run_for(3s);
    EXPECT_FALSE(seen.expired());
    bench.scheduler.run_for(8s);
    EXPECT_TRUE(seen.expired());
    EXPECT_TRUE(file_of(path).run.complete);
}

TEST_F(DriftMeasurements, StayOpenWhenTheDaemonEnds) {
    const Shared test = begin();
    bench.scheduler.run_for(3s);
    bench.stopping = true;
    bench.scheduler.run_for(20s);
    EXPECT_TRUE(test->is_open());
    EXPECT_FALSE(file_of(test->run().path).closed);
    EXPECT_EQ(test->view().taken, 3);
}

} // namespace
} // namespace axiscal::testing::drift_measurement_test

#include "acquisition/run/resume.hpp"

#include "bench.hpp"

#include <gtest/gtest.h>

#include <random>

namespace axiscal::resume_test {
namespace {

using testing::at_s;
using testing::Bench;

/// Counts 1000 samples a second from 0 at t = 0.
constexpr double rate_hz = 1000;
std::uint64_t count_at(double seconds) {
    return static_cast<std::uint64_t>(seconds * rate_hz);
}

RunRecord run_with_points(int points) {
    RunRecord run;
    run.plan = testing::small_plan();
    run.config_hash = "abc";
    run.boot_id = {"boot-1"};
    run.laser.instrument = "laser";
    InstrumentRecord laser;
    laser.name = "laser";
    laser.serial = "UMD-17";
    run.instruments.push_back(laser);
    DatumRecord datum;
    datum.at = at_s(100);
    datum.reading = 1.0_mm;
    datum.device_count = count_at(100);
    run.datums.push_back(datum);
    for (int i = 0; i < points; ++i) {
        PointRecord point;
        point.step = i;
        point.sequence = static_cast<std::uint16_t>(i + 1);
        const double at = 120 + 20 * i;
        point.window_begin = at_s(at);
        point.window_end = at_s(at + 0.5);
        point.samples = {{at_s(at), 0.02, count_at(at)},
                         {at_s(at + 0.5), 0.02, count_at(at + 0.5)}};
        run.points.push_back(point);
    }
    return run;
}

StationNow same_station(double seconds) {
    StationNow now;
    now.config_hash = "abc";
    now.boot_id = {"boot-1"};
    now.laser_serial = "UMD-17";
    now.laser = Sample{0, at_s(seconds), 0.02, count_at(seconds), 0};
    now.limits.fastest = metre_per_second(1);
    return now;
}

TEST(FirstRequest, LastDurableIsPublishedAgainNextIsCapturedAllElseIsLost) {
    const auto decide = [](std::uint16_t durable, std::uint16_t request) {
        return judge_first_request(durable, request).decision;
    };
    EXPECT_EQ(decide(5, 5), ResumeDecision::republish_done);
    EXPECT_EQ(decide(5, 6), ResumeDecision::capture_standing);
    EXPECT_EQ(decide(65534, 1), ResumeDecision::capture_standing);
    EXPECT_EQ(decide(0, 1), ResumeDecision::capture_standing);
    EXPECT_EQ(decide(0, 0), ResumeDecision::wait_for_request);
    for (const std::uint16_t request : std::initializer_list<std::uint16_t>{0, 1, 4, 7, 65535})
        EXPECT_EQ(decide(5, request), ResumeDecision::close_sequence_lost) << request;
    EXPECT_EQ(judge_first_request(5, std::nullopt).decision, ResumeDecision::wait_for_request);
}

TEST(Resume, NeedsTheSameStationFileInstrumentAndBoot) {
    const auto run = run_with_points(3);
    EXPECT_EQ(decide_resume(run, 4, same_station(200)).decision, ResumeDecision::capture_standing);
    EXPECT_EQ(decide_resume(run, 3, same_station(200)).decision, ResumeDecision::republish_done);
    EXPECT_EQ(decide_resume(run, 9, same_station(200)).decision,
              ResumeDecision::close_sequence_lost);
    auto now = same_station(200);
    now.config_hash = "other";
    EXPECT_EQ(decide_resume(run, 4, now).decision, ResumeDecision::close_config_changed);
    now = same_station(200);
    now.laser_serial = "UMD-18";
    EXPECT_EQ(decide_resume(run, 4, now).decision, ResumeDecision::close_other_instrument);
    now = same_station(200);
    now.boot_id = {"boot-2"};
    EXPECT_EQ(decide_resume(run, 4, now).decision, ResumeDecision::close_datum_lost);
    now = same_station(200);
    now.laser.reset();
    EXPECT_EQ(decide_resume(run, 4, now).decision, ResumeDecision::close_datum_lost);
}

TEST(Resume, EveryInstrumentThatHasAnsweredMustBeTheRuns) {
    auto run = run_with_points(3);
    InstrumentRecord air, unnumbered;
    air.name = "air", air.serial = "V-1";
    unnumbered.name = "contacts";
    run.instruments.push_back(air);
    run.instruments.push_back(unnumbered);
    auto now = same_station(200);
    now.instruments = {{"laser", "UMD-17"}, {"air", "V-1"}, {"contacts", "T-5"}, {"lamp", "L"}};
    EXPECT_EQ(decide_resume(run, 4, now).decision, ResumeDecision::capture_standing);
    now.instruments = {{"air", ""}};
    EXPECT_EQ(decide_resume(run, 4, now).decision, ResumeDecision::capture_standing);
    now.instruments = {{"laser", "UMD-17"}, {"air", "V-2"}};
    const auto verdict = decide_resume(run, 4, now);
    EXPECT_EQ(verdict.decision, ResumeDecision::close_other_instrument);
    EXPECT_EQ(verdict.fault, Fault::unknown_instrument);
    EXPECT_EQ(verdict.sentence,
              "The instrument 'air' has the serial number 'V-2', the run's has 'V-1'.");
}

TEST(Resume, OutsideTheLimitsOfTheEnvironmentTheRunIsClosedWithThatReason) {
    auto now = same_station(200);
    now.outside_limits = "air/air temperature shows 27.3 degC, 25 degC at most are allowed";
    const auto verdict = decide_resume(run_with_points(3), 4, now);
    EXPECT_EQ(verdict.decision, ResumeDecision::close_environment);
    EXPECT_EQ(verdict.fault, Fault::environment_outside);
    EXPECT_NE(verdict.sentence.find("The environment is out of limits: air/air temperature"),
              std::string::npos)
        << verdict.sentence;
    now.laser.reset();
    EXPECT_EQ(decide_resume(run_with_points(3), 4, now).decision, ResumeDecision::close_datum_lost)
        << "what nothing can bring back is told first";
}

TEST(Resume, TellsHowTheDatumWasProven) {
    const auto verdict = decide_resume(run_with_points(3), 4, same_station(200.5));
    EXPECT_NE(verdict.sentence.find("its number advanced by 40000 in 40 s, 40000 were due"),
              std::string::npos)
        << verdict.sentence;
}

TEST(Resume, OfAnAxisMeasuredByAScaleSpeaksOfTheScale) {
    RunRecord run = run_with_points(3);
    run.scale.emplace();
    EXPECT_TRUE(decide_resume(run, std::nullopt, same_station(200.5))
                    .sentence.starts_with("The scale counted on during the interruption"));
    auto other = same_station(200);
    other.laser_serial = "UMD-18";
    EXPECT_EQ(decide_resume(run, 4, other).sentence,
              "The scale has the serial number 'UMD-18', the run's has 'UMD-17'.");
    auto silent = same_station(200);
    silent.laser.reset();
    EXPECT_EQ(decide_resume(run, 4, silent).sentence,
              "The datum is lost: the scale gives no reading.");
    for (PointRecord& point : run.points)
        point.samples = {};
    for (DatumRecord& datum : run.datums)
        datum.device_count = 0;
    EXPECT_EQ(decide_resume(run, 4, same_station(200)).sentence,
              "The datum is lost: the run kept no number of the scale's samples.");
}

TEST(Resume, ARunWithoutADatumHasNoneToLose) {
    auto run = run_with_points(0);
    run.datums.clear();
    run.events.push_back({EventKind::armed, at_s(1), 0, "the CNC ties", Fault::none, 0});
    auto now = same_station(200);
    now.laser.reset();
    EXPECT_EQ(decide_resume(run, 1, now).decision, ResumeDecision::capture_standing);
}

TEST(Resume, ARunWithoutADatumEndsWithTheBootThatItsAirWasReadIn) {
    auto run = run_with_points(0);
    run.datums.clear();
    run.events.push_back({EventKind::armed, at_s(1), 0, "the CNC ties", Fault::none, 0});
    auto now = same_station(200);
    now.boot_id = {"another boot"};
    const auto verdict = decide_resume(run, 1, now);
    EXPECT_EQ(verdict.decision, ResumeDecision::close_never_armed);
    EXPECT_EQ(verdict.sentence,
              "The computer was restarted before the datum was tied; nothing was measured yet.");
}

/// The unit hid the kernel's id: empty equalled empty, and a reboot went unnoticed.
TEST(Resume, AnUnknownBootIsNeverTheRunsNotEvenWhereBothAreUnknown) {
    for (const auto& [then, later] : {std::pair{"", ""}, {"boot-1", ""}, {"", "boot-1"}}) {
        auto run = run_with_points(3);
        run.boot_id = {then};
        auto now = same_station(200);
        now.boot_id = {later};
        const auto verdict = decide_resume(run, 4, now);
        EXPECT_EQ(verdict.decision, ResumeDecision::close_datum_lost);
        EXPECT_EQ(verdict.sentence, "The datum is lost: nobody can tell whether the computer was "
                                    "restarted since.");
        run.datums.clear();
        run.events.push_back({EventKind::armed, at_s(1), 0, "the CNC ties", Fault::none, 0});
        EXPECT_EQ(decide_resume(run, 1, now).decision, ResumeDecision::close_never_armed);
        EXPECT_EQ(decide_resume(run, 1, now).sentence,
                  "Nobody can tell whether the computer was restarted before the datum was tied; "
                  "nothing was measured yet.");
    }
}

TEST(Resume, ARunWhoseDatumAPersonWasTyingIsClosedToBeArmedAnew) {
    auto run = run_with_points(0);
    run.datums.clear();
    const auto verdict = decide_resume(run, std::nullopt, same_station(200));
    EXPECT_EQ(verdict.decision, ResumeDecision::close_never_armed);
    EXPECT_EQ(verdict.fault, Fault::no_run_armed);
    EXPECT_NE(verdict.sentence.find("before the datum was tied"), std::string::npos);
}

TEST(Resume, FindsTheNewestDurableRequest) {
    EXPECT_EQ(last_durable_request(run_with_points(0)).sequence, 0);
    auto run = run_with_points(3);
    EXPECT_EQ(last_durable_request(run).sequence, 3);
    EXPECT_EQ(last_durable_request(run).step, 2);
    run.events.push_back({EventKind::skipped, at_s(500), 0, skip_text(3), Fault::none, 4});
    EXPECT_EQ(last_durable_request(run).sequence, 4);
    EXPECT_EQ(last_durable_request(run).step, 3);
    run = run_with_points(0);
    run.datums[0].sequence = 1;
    EXPECT_EQ(last_durable_request(run).sequence, 1);
    EXPECT_EQ(last_durable_request(run).step, -1);
    run = run_with_points(3);
    run.points[1].sequence = 65534, run.points[2].sequence = 1;
    EXPECT_EQ(last_durable_request(run).sequence, 1) << "newest by time, not by number";
}

TEST(Resume, MeasuresTheLasersRateFromTheRun) {
    EXPECT_FALSE(counting_rate_hz(run_with_points(0)));
    EXPECT_NEAR(*counting_rate_hz(run_with_points(5)), rate_hz, 0.1);
}

TEST(Resume, MeasuresTheLasersRateFromOneSecondOfReadings) {
    std::vector<Sample> samples;
    for (unsigned i = 0; i <= 1000; ++i)
        samples.emplace_back(0, at_s(50 + i * 1e-3), 0.02, count_at(50) + i);
    EXPECT_NEAR(*counting_rate_hz(samples), rate_hz, 0.1);
    samples.pop_back();
    EXPECT_FALSE(counting_rate_hz(samples)); // shorter than a second
    EXPECT_FALSE(counting_rate_hz(std::span<const Sample>{}));
}

TEST(Resume, FindsTheLastSignOfLifeInWhateverWasWrittenLast) {
    RunRecord run = run_with_points(2);
    EXPECT_EQ(last_sign_of_life(run), at_s(140.5));
    run.environment.push_back({0, at_s(141), 20.0});
    EXPECT_EQ(last_sign_of_life(run), at_s(141));
    run.events.push_back({EventKind::interrupted, at_s(142), 0, "", Fault::none, 0});
    EXPECT_EQ(last_sign_of_life(run), at_s(142));
}

CounterSighting before_at(double seconds) {
    return {at_s(seconds), 20.0_mm, count_at(seconds)};
}
ContinuityLimits limits() {
    ContinuityLimits limits;
    limits.rate_hz = rate_hz;
    limits.fastest = metre_per_second(1);
    return limits;
}

TEST(DatumContinues, WhenTheNumberAdvancedWithTime) {
    const Sample after{0, at_s(160), 0.02, count_at(160)};
    EXPECT_TRUE(datum_continues(before_at(100), after, limits()).continues);
}

TEST(DatumContinues, NotAfterThePowerWasOff) {
    const Sample after{0, at_s(160), 0.0, count_at(20)}; // switched on 20 s ago
    const auto verdict = datum_continues(before_at(100), after, limits());
    EXPECT_FALSE(verdict.continues);
    EXPECT_NE(verdict.reason.find("advanced by -80000 in 60 s, 60000 were due"), std::string::npos)
        << verdict.reason;
}

TEST(DatumContinues, NotWhenTheLaserWasTooYoungToTell) {
    const Sample after{0, at_s(160), 0.02, count_at(160)};
    EXPECT_FALSE(datum_continues({at_s(100), 20.0_mm, 900}, after, limits()).continues);
}

TEST(DatumContinues, NotWithoutANumberARateOrAReading) {
    const Sample after{0, at_s(160), 0.02, count_at(160)};
    EXPECT_FALSE(datum_continues({at_s(100), 20.0_mm, 0}, after, limits()).continues);
    EXPECT_FALSE(datum_continues(before_at(100), Sample{0, at_s(160), 0.02}, limits()).continues);
    EXPECT_FALSE(datum_continues(before_at(100),
                                 Sample::bad(0, at_s(160), Quality::beam_lost, count_at(160)),
                                 limits())
                     .continues);
    auto no_rate = limits();
    no_rate.rate_hz = 0;
    EXPECT_FALSE(datum_continues(before_at(100), after, no_rate).continues);
}

TEST(DatumContinues, NotWhenTheAxisCannotHaveGoneThatFar) {
    // 0.52 m/s is how a heterodyne counter runs off without its beam: 1.6 MHz of 316 nm.
    auto slow = limits();
    slow.fastest = metre_per_second(0.1);
    const Sample after{0, at_s(160), 0.02 + 0.52 * 60, count_at(160)};
    EXPECT_FALSE(datum_continues(before_at(100), after, slow).continues);
}

TEST(DatumContinues, AShortNumberProvesOnlyShortInterruptions) {
    auto short_number = limits();
    short_number.rate_hz = 244.14; // 16 bits wrap after 268 s
    short_number.count_modulus = 65536;
    const auto wrapped = [&](double seconds) {
        const auto count = static_cast<std::uint64_t>(seconds * short_number.rate_hz) % 65536;
        return Sample{0, at_s(seconds), 0.02, count};
    };
    const CounterSighting before{at_s(1000), 20.0_mm,
                                 static_cast<std::uint64_t>(1000 * short_number.rate_hz)};
    EXPECT_TRUE(datum_continues(before, wrapped(1100), short_number).continues);
    EXPECT_FALSE(datum_continues(before, wrapped(1300), short_number).continues);
    EXPECT_FALSE(datum_continues(before, Sample{0, at_s(1100), 0.02, 500}, short_number).continues);
}

TEST(DatumContinues, LawNoRestartedCounterPasses) {
    std::mt19937_64 random{9};
    const auto pick = [&](double high) {
        return high * static_cast<double>(random() % 10'001) / 1e4;
    };
    for (int round = 0; round < 5000; ++round) {
        const double on_before = 1 + pick(3600), away = 1 + pick(600);
        const CounterSighting before{at_s(5000), 20.0_mm, count_at(on_before)};
        const Sample ran_on{0, at_s(5000 + away), 0.02, count_at(on_before + away)};
        const double off_for = pick(away); // power came back this long after the last sighting
        const Sample restarted{0, at_s(5000 + away), 0.02, 1 + count_at(away - off_for)};
        EXPECT_FALSE(datum_continues(before, restarted, limits()).continues);
        const bool old_enough = on_before * rate_hz > 2 * (0.01 * away * rate_hz + 500);
        EXPECT_EQ(datum_continues(before, ran_on, limits()).continues, old_enough);
    }
}

TEST(ResumedRun, PublishesDoneAgainAndGoesOn) {
    const auto run = run_with_points(3);
    Bench bench;
    bench.machine = RunMachine{bench.setup, run, 1, at_s(200)};
    bench.give(EnvironmentNow{testing::air_index_minus_1});
    bench.trigger(3);
    EXPECT_EQ(bench.the<RepublishDone>().sequence, 3);
    EXPECT_EQ(bench.the<RepublishDone>().step, 2);
    EXPECT_TRUE(bench.trigger(4).saw<OpenWindow>());
    EXPECT_TRUE(bench.open_window.approach) << "this way is seen again";
}

/// The machine after a restart, at the window of a standing request 4.
Bench resumed_at_standing_request() {
    Bench bench;
    bench.now_s = 200;
    auto run = run_with_points(3);
    run.datums.front().coordinate = bench.setup.plan.datum;
    run.datums.front().reading = bench.reading_zero;
    bench.machine = RunMachine{bench.setup, run, bench.epoch, at_s(200)};
    bench.give(EnvironmentNow{testing::air_index_minus_1});
    auto standing = Bench::request(4);
    standing.standing = true;
    bench.trigger(standing);
    return bench;
}

TEST(ResumedRun, AsksForTheWaySinceTheLastDurablePoint) {
    const Bench bench = resumed_at_standing_request();
    ASSERT_TRUE(bench.saw<OpenWindow>());
    EXPECT_EQ(bench.the<RecordEvent>().event.kind, EventKind::resumed);
    ASSERT_TRUE(bench.open_window.approach);
    EXPECT_EQ(bench.open_window.approach->since, at_s(160.5));
}

Capture with_way(const Bench& bench, Fault fault) {
    Capture capture = bench.capture_at(bench.open_window.expected);
    capture.approach_travel = fail(fault, "Seen only 0 mm from below.");
    return capture;
}

TEST(ResumedRun, TakesThePointWhoseWayNobodySawOnce) {
    Bench bench = resumed_at_standing_request();
    bench.window(with_way(bench, Fault::samples_lost));
    ASSERT_TRUE(bench.saw<CommitPoint>());
    EXPECT_EQ(bench.the<CommitPoint>().point.approach_travel, 0.0_mm);
    EXPECT_NE(bench.the<RecordEvent>().event.text.find("was not seen"), std::string::npos);
    bench.commit().trigger(5).window(with_way(bench, Fault::samples_lost));
    EXPECT_FALSE(bench.saw<CommitPoint>());
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::samples_lost);
}

TEST(ResumedRun, RefusesAWayThatWasSeenToBeWrong) {
    Bench bench = resumed_at_standing_request();
    bench.window(with_way(bench, Fault::wrong_direction));
    EXPECT_FALSE(bench.saw<CommitPoint>());
    EXPECT_EQ(bench.the<Refuse>().fault, Fault::wrong_direction);
}

TEST(ResumedRun, StopsWithSequenceLost) {
    for (const std::uint16_t request : std::initializer_list<std::uint16_t>{0, 1, 2, 5, 900}) {
        const auto run = run_with_points(3);
        Bench bench;
        bench.machine = RunMachine{bench.setup, run, 1, at_s(200)};
        bench.trigger(request);
        ASSERT_TRUE(bench.saw<Close>()) << request;
        EXPECT_EQ(bench.the<Close>().fault, Fault::sequence_lost);
        EXPECT_FALSE(bench.the<Close>().complete);
    }
}

TEST(ResumedRun, ClosesAtOnceWhenOnlyTheClosingWasMissing) {
    const auto run = run_with_points(10);
    Bench bench;
    bench.machine = RunMachine{bench.setup, run, 1, at_s(2000)};
    bench.give(Tick{at_s(2000)});
    EXPECT_TRUE(bench.the<Close>().complete);
}

TEST(ResumedRun, KeepsSkippedPointsSkipped) {
    auto run = run_with_points(3);
    run.events.push_back({EventKind::skipped, at_s(500), 0, skip_text(3), Fault::none, 4});
    Bench bench;
    bench.machine = RunMachine{bench.setup, run, 1, at_s(600)};
    EXPECT_EQ(bench.machine.view().next->step, 4);
    EXPECT_EQ(bench.machine.view().skipped, 1);
    EXPECT_EQ(bench.machine.view().last_durable, 4);
}

} // namespace
} // namespace axiscal::resume_test

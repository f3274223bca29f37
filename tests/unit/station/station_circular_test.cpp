// A whole circular test: a machine with known errors, a ballbar of 1 kHz, a CNC that asks before
// each circle, a run file, and what its diagnosis finds.

#include "acquisition/capture/stream_chunker.hpp"
#include "acquisition/runfile/stream_packing.hpp"
#include "analysis/circular/circle_cut.hpp"
#include "analysis/circular/circle_diagnosis.hpp"
#include "station_bench.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/unit/analysis/driven_bar.hpp"

namespace axiscal::testing::station_circular_test {
namespace {

using circular::Cause;
using test::leverage_of;
using test::reference_name;

/// The machine: at rest outside of the circle until it is told to drive one.
class CircleMachine {
public:
    CircularPlan plan;
    test::CircleTruth truth{{"square", 40e-6}, {"backlash_x", 0.005}, {"scale_y", -30e-6}};

    /// @returns how long it takes.
    Duration drive(Sense sense, MonotonicTime now) {
        sense_ = sense;
        began_ = now;
        return from_seconds(2 * radial().duration_s() + arc().duration_s());
    }
    /// A person brings it back to rest beside the circle.
    void park() { began_.reset(); }
    /// What the bar reads, m.
    [[nodiscard]] double reading(MonotonicTime now) const {
        const double t = began_ ? seconds_of(now - *began_) : -1;
        const double in_s = radial().duration_s(), arc_s = arc().duration_s();
        const double turned = arc().way(t - in_s) / arc().length_mm;
        const double from = entry_deg(plan, sense_), to = exit_deg(plan, sense_);
        const double away = 1 - radial().way(t) / plan.feed_in_mm +
                            radial().way(t - in_s - arc_s) / plan.feed_in_mm;
        const double form =
            test::true_deviation(truth, (from + (to - from) * turned) * test::one_degree, sense_,
                                 plan.nominal_radius_mm, plan.feed_mm_per_s);
        return (plan.feed_in_mm * away + form) * 1e-3;
    }

private:
    [[nodiscard]] test::Trapezoid radial() const {
        return {plan.feed_in_mm, plan.feed_mm_per_s, 0};
    }
    [[nodiscard]] test::Trapezoid arc() const {
        return {driven_deg(plan) * test::one_degree * plan.nominal_radius_mm, plan.feed_mm_per_s,
                0};
    }
    Sense sense_ = Sense::ccw;
    std::optional<MonotonicTime> began_;
};

struct Bay {
    Shop shop;
    CircleMachine machine;
    Bay() {
        CircularConfig circular;
        CircularPlan& plan = circular.setup.plan;
        plan.nominal_radius_mm = 50;
        plan.feed_mm_per_s = 100; // 6 m/min: short in virtual time
        plan.overshoot_deg = 45;
        circular.setup.bar_instrument = "ballbar";
        circular.setup.machine_alpha_per_K = 11.5e-6;
        machine.plan = plan;
        shop.config.circular = circular;
        shop.config.ballbar = RoleConfig{"ballbar", "ballbar"};
        InstrumentConfig bar;
        bar.name = "ballbar";
        bar.driver = "made";
        shop.config.instruments.push_back(bar);
        shop.ballbar = [this](MonotonicTime at) { return machine.reading(at); };
    }
};

ArmRequest circles() {
    ArmRequest request;
    request.kind = TestKind::circular;
    return request;
}

Result<std::string> arm(Life& life) {
    const auto answer = life.begin_arm(circles());
    life.run(1s);
    return *answer ? **answer : Result<std::string>{fail(Fault::internal, "still arming")};
}

void ask(Life& life, std::uint16_t sequence) {
    TriggerEvent event;
    event.sequence = sequence;
    life.ask(event);
    life.run(200ms);
}

void drive(Life& life, Bay& bay, Sense sense) {
    life.run(500ms);
    life.run(bay.machine.drive(sense, life.scheduler.now()) + 500ms);
}

RunFileContents contents_of(const Shop& shop) {
    const auto files = shop.run_files();
    EXPECT_EQ(files.size(), 1U);
    auto read = read_run_file_contents(files.at(0));
    EXPECT_TRUE(read) << (read ? "" : read.error().detail);
    return *std::move(read);
}

TEST(StationCircular, TheInjectedErrorsComeBackOfTheRunFile) {
    Bay bay;
    Life life{bay.shop};
    const auto armed = arm(life);
    ASSERT_TRUE(armed) << describe(armed.error());
    EXPECT_EQ(life.port->armed, 1);
    std::uint16_t sequence = 0;
    for (const Sense sense : {Sense::ccw, Sense::cw}) {
        ask(life, ++sequence);
        EXPECT_EQ(life.port->done, sequence);
        drive(life, bay, sense);
    }
    ask(life, 3);
    life.run(1s);
    EXPECT_EQ(life.port->done, 3);
    ASSERT_TRUE(life.status().run);
    EXPECT_EQ(life.status().run->state, "complete");
    EXPECT_EQ(life.status().run->step, 2);
    EXPECT_TRUE(life.port->status.run_complete);

    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.run.complete);
    ASSERT_TRUE(std::holds_alternative<CircularSetup>(read.attachments.setup));
    const auto& setup = std::get<CircularSetup>(read.attachments.setup);
    EXPECT_EQ(setup.capture.sample_rate_hz, 1000);
    const auto stream = samples_of(read.blocks, 0);
    ASSERT_TRUE(stream) << stream.error().detail;
    EXPECT_TRUE(stream->gaps.empty());
    std::vector<CircleMark> marks;
    for (const EventRecord& event : read.run.events)
        if (event.sequence != 0) marks.push_back({event.sequence, event.at});
    const auto cut = cut_circles(setup, *stream, marks);
    ASSERT_TRUE(cut) << cut.error().detail;
    CircularTest test{50, 100, SignalSource::external, {(*cut)[0].trace, (*cut)[1].trace}};
    const auto found = diagnose_circle(test, {"X", "Y"}).value();
    for (const Cause cause :
         {Cause::squareness, Cause::backlash_x, Cause::backlash_y, Cause::scale_y}) {
        const double leverage = leverage_of(cause, 50, 100);
        test::CircleTruth truth = bay.machine.truth;
        // the form at the ends (8 um) shifts the steps by as much path: 0.16 mrad, of which twice
        // 8 um make 3 nm; a sample is 2 mrad, and a reversal falls between two: 5 um of backlash
        // times one sample of 3142
        EXPECT_NEAR(*found.of(cause).value * leverage, truth[reference_name(cause)] * leverage,
                    5e-5)
            << reference_name(cause);
    }
}

std::vector<double> readings_of_a_circle(Bay& bay) {
    Life life{bay.shop};
    EXPECT_TRUE(arm(life));
    ask(life, 1);
    drive(life, bay, Sense::ccw);
    life.run(3s);
    const auto stream = samples_of(contents_of(bay.shop).blocks, 0);
    EXPECT_TRUE(stream);
    return stream ? stream->value : std::vector<double>{};
}

TEST(StationCircular, TheTableOfTheTransducerIsInEachRecordedReading) {
    Bay exact, stretched; // the second transducer shows 2 % too little; its certificate says so
    CircleMachine& machine = stretched.machine;
    stretched.shop.ballbar = [&machine](MonotonicTime at) { return machine.reading(at) / 1.02; };
    ChannelConfig stated;
    stated.channel = "ballbar";
    stated.calibration.corrections = {{-0.1, -0.002}, {0, 0}, {0.1, 0.002}};
    stretched.shop.config.instruments.back().channels.push_back(stated);
    const std::vector<double> wanted = readings_of_a_circle(exact),
                              found = readings_of_a_circle(stretched);
    ASSERT_GE(wanted.size(), 3000U);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        ASSERT_NEAR(found[i], wanted[i], 1e-15) << i;
}

TEST(StationCircular, TheStreamIsSeenWhileItIsRecorded) {
    Bay bay;
    Life life{bay.shop};
    EXPECT_FALSE(life.station->stream(10));
    ASSERT_TRUE(arm(life));
    life.run(3s);
    const auto view = life.station->stream(10);
    ASSERT_TRUE(view);
    EXPECT_TRUE(view->recording);
    EXPECT_EQ(view->channel, "ballbar/ballbar");
    EXPECT_GE(view->samples, 3000U); // 1 kHz
    ASSERT_LE(view->stretches.size(), 10U);
    EXPECT_GE(view->stretches.size() * view->samples_a_stretch, view->samples);
    for (const MinMax& stretch : view->stretches) // at rest: 1.5 mm and a form of some um
        EXPECT_NEAR(stretch.high, 1.5e-3, 2e-5);
}

TEST(StationCircular, AFailedCheckHoldsTheTestUnlessAReasonIsGiven) {
    Bay bay;
    bay.shop.config.statements.state.clear();
    Life life{bay.shop};
    const auto refused = arm(life);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "preflight");
    EXPECT_NE(refused.error().detail.find("compensation"), std::string::npos);
    EXPECT_TRUE(bay.shop.run_files().empty());
    ArmRequest with_reason = circles();
    with_reason.overrides["compensation"] = "nobody knows";
    const auto answer = life.begin_arm(with_reason);
    life.run(1s);
    ASSERT_TRUE(*answer && **answer);
    const RunFileContents read = contents_of(bay.shop);
    const auto check = std::ranges::find(read.revisions.preflight, std::string{"compensation"},
                                         &PreflightRecord::name);
    ASSERT_NE(check, read.revisions.preflight.end());
    EXPECT_EQ(check->override_reason, "nobody knows");
}

TEST(StationCircular, AStationWithABallbarAndNoLaserMeasuresCirclesAlone) {
    Bay bay;
    AxisConfig& axis = bay.shop.config.axis;
    axis.laser = axis.air_temperature = axis.air_pressure = axis.air_humidity = {};
    Life life{bay.shop};
    const auto answer = life.begin_arm();
    life.run(1s);
    ASSERT_TRUE(*answer);
    ASSERT_FALSE(**answer);
    EXPECT_NE(describe((**answer).error()).find("--pass circular"), std::string::npos);
    EXPECT_FALSE(life.station->align({}));
    ASSERT_TRUE(arm(life));
    std::uint16_t sequence = 0;
    for (const Sense sense : {Sense::ccw, Sense::cw}) {
        ask(life, ++sequence);
        drive(life, bay, sense);
    }
    ask(life, 3);
    life.run(1s);
    EXPECT_EQ(life.status().run->state, "complete");
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.run.complete);
    EXPECT_TRUE(read.run.laser.instrument.empty());
    int lengths = 0;
    for (const ChannelRecord& channel : read.run.channels)
        lengths += channel.kind == ChannelKind::displacement ? 1 : 0;
    EXPECT_EQ(lengths, 1); // the bar's
}

TEST(StationCircular, LostSamplesStandInTheFileAsAGap) {
    Bay bay;
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    life.run(2s);
    life.bar->silent = true;
    life.run(40ms);
    life.bar->silent = false;
    life.run(2s);
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_FALSE(read.run.complete);
    const auto stream = samples_of(read.blocks, 0);
    ASSERT_TRUE(stream);
    ASSERT_EQ(stream->gaps.size(), 1U);
    EXPECT_EQ(stream->gaps[0].missing, 40U);
}

/// The computer stood still: it reads the CNC's last request, and only then what the bar measured
/// before it.
TEST(StationCircular, AFeedOutThatIsReadBehindTheLastRequestBelongsToItsCircle) {
    Bay bay;
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    ask(life, 1);
    drive(life, bay, Sense::ccw);
    ask(life, 2);
    life.run(500ms);
    life.run(bay.machine.drive(Sense::cw, life.scheduler.now()) - 100ms);
    life.bar->read_late = true;
    life.run(600ms);
    ask(life, 3);
    EXPECT_EQ(life.port->done, 2);
    life.bar->read_late = false;
    life.run(100ms);
    EXPECT_EQ(life.port->done, 3);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.run.complete);
    const auto stream = samples_of(read.blocks, 0);
    ASSERT_TRUE(stream);
    const auto& setup = std::get<CircularSetup>(read.attachments.setup);
    const auto cut = cut_circles(setup, *stream, circle_marks(setup.plan, read.run.events));
    EXPECT_TRUE(cut) << cut.error().detail;
}

/// A bar that is silent does not hold the end of a test for longer than 2 s.
TEST(StationCircular, ATestEndsWithoutTheBar) {
    Bay bay;
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    ask(life, 1);
    drive(life, bay, Sense::ccw);
    ask(life, 2);
    drive(life, bay, Sense::cw);
    life.bar->silent = true;
    life.run(100ms);
    ask(life, 3);
    life.run(2s);
    EXPECT_EQ(life.port->done, 3);
}

/// docs/circular.md: 64 blocks wait, of one second or 16384 readings.
TEST(StationCircular, WhatWaitsForTheDiskIsBounded) {
    constexpr std::size_t reading_bytes = sizeof(MonotonicTime) + sizeof(double);
    constexpr std::size_t most = Journal::most_chunks * StreamChunker::most_samples;
    EXPECT_EQ(most * reading_bytes, 16U << 20U);
    EXPECT_EQ(Journal::most_chunks * StreamChunker::longest, 64s); // at 1 kHz
    EXPECT_NEAR(static_cast<double>(most) / 50e3, 21, 0.03);       // s, at 50 kHz
}

/// 1 kHz makes a block a second. Of 80 the first 64 wait; the 81st and a second until the station
/// tries the disk again are one either way.
TEST(StationCircular, BlocksThatADiskTakesNoMoreAreCountedNamedAndMissingInTheFile) {
    Bay bay;
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    life.run(2s);
    {
        const FullDisk full;
        life.run(60s);
        EXPECT_EQ(life.notes_with("The disk does not keep up"), 0);
        life.run(20s);
    }
    life.run(3s);
    EXPECT_EQ(life.notes_with("The disk does not keep up: readings of the ballbar are dropped"), 1);
    const std::string told = life.status().run->last_sentence;
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);

    const RunFileContents read = contents_of(bay.shop);
    const auto stream = samples_of(read.blocks, 0);
    ASSERT_TRUE(stream) << stream.error().detail;
    EXPECT_NEAR(static_cast<double>(stream->dropped_blocks), 80 - 64, 2);
    EXPECT_NE(told.find(std::to_string(stream->dropped_blocks) + " blocks were dropped"),
              std::string::npos)
        << told;
    ASSERT_EQ(stream->gaps.size(), 1U);
    EXPECT_EQ(stream->gaps[0].why, "dropped");
    const std::size_t at = stream->gaps[0].at;
    EXPECT_NEAR(seconds_of(stream->at[at] - stream->at[at - 1]),
                static_cast<double>(stream->dropped_blocks), 0.01); // a block is 1 s
    const auto event = std::ranges::find_if(read.run.events, [](const EventRecord& one) {
        return one.text.find("The disk does not keep up") != std::string::npos;
    });
    ASSERT_NE(event, read.run.events.end());
    EXPECT_EQ(event->fault, Fault::not_durable);
}

TEST(StationCircular, ARequestOutOfOrderIsRefusedAndTheRightOneStillTaken) {
    Bay bay;
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    ask(life, 2);
    EXPECT_EQ(life.port->done, 0);
    ASSERT_EQ(life.port->refusals.size(), 1U);
    EXPECT_EQ(life.port->refusals[0].second, Fault::sequence_lost);
    ask(life, 1);
    EXPECT_EQ(life.port->done, 1);
    life.port->done = 0; // the CNC missed it
    ask(life, 1);
    EXPECT_EQ(life.port->done, 1);
}

TEST(StationCircular, APersonMayBeginEachCircle) {
    Bay bay;
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(life.station->trigger());
        life.run(200ms);
    }
    life.run(1s);
    ASSERT_TRUE(life.status().run);
    EXPECT_EQ(life.status().run->state, "complete");
}

TEST(StationCircular, WithoutABallbarNothingIsArmed) {
    Shop shop;
    Life life{shop};
    const auto armed = arm(life);
    ASSERT_FALSE(armed);
    EXPECT_NE(describe(armed.error()).find("[circular]"), std::string::npos);
    Bay bay;
    Life dumb{bay.shop};
    dumb.bar->silent = true;
    dumb.run(3s);
    const auto refused = arm(dumb);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().detail.find("the ballbar (ballbar) sends nothing"),
              std::string::npos);
    EXPECT_TRUE(bay.shop.run_files().empty());
}

/// What a shop went through when the daemon was killed within circle 2, or just after circle 1.
void first_life(Bay& bay, bool second_circle_begun) {
    Life life{bay.shop};
    ASSERT_TRUE(arm(life));
    ask(life, 1);
    drive(life, bay, Sense::ccw);
    life.run(2s); // what is older than two seconds is on disk, whatever happens
    if (!second_circle_begun) return;
    ask(life, 2);
    life.run(500ms);
    bay.machine.drive(Sense::cw, life.scheduler.now());
    life.run(1s);
}

void second_circle_and_end(Life& life, Bay& bay) {
    ask(life, 2);
    EXPECT_EQ(life.port->done, 2);
    drive(life, bay, Sense::cw);
    ask(life, 3);
    life.run(1s);
    EXPECT_EQ(life.port->done, 3);
}

/// Complete, both circles whole, and the interruption told where the certificate takes it from.
void expect_both_circles(const Bay& bay, const std::string& told) {
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.run.complete) << read.run.closing_reason;
    const auto stream = samples_of(read.blocks, 0);
    ASSERT_TRUE(stream) << stream.error().detail;
    ASSERT_TRUE(std::holds_alternative<CircularSetup>(read.attachments.setup));
    const auto& setup = std::get<CircularSetup>(read.attachments.setup);
    const auto cut = cut_circles(setup, *stream, circle_marks(setup.plan, read.run.events));
    ASSERT_TRUE(cut) << cut.error().detail;
    ASSERT_EQ(cut->size(), 2U);
    for (const CircleCapture& circle : *cut)
        EXPECT_EQ(circle.gaps, 0U);
    const auto event =
        std::ranges::find(read.run.events, EventKind::interrupted, &EventRecord::kind);
    ASSERT_NE(event, read.run.events.end());
    EXPECT_NE(event->text.find("The station recorded nothing for"), std::string::npos);
    EXPECT_NE(event->text.find(told), std::string::npos) << event->text;
    ASSERT_FALSE(stream->gaps.empty());
    EXPECT_EQ(stream->gaps.front().why, "interrupted");
    EXPECT_GT(stream->gaps.front().missing, 0U);
}

TEST(StationCircular, ACircleThatTheDaemonDidNotSurviveIsDrivenAgain) {
    Bay bay;
    first_life(bay, true);
    Life again{bay.shop};
    again.run(2s);
    ASSERT_TRUE(again.status().run);
    EXPECT_EQ(again.status().run->state, "armed");
    EXPECT_EQ(again.status().run->done, 2);
    bay.machine.park();
    second_circle_and_end(again, bay);
    EXPECT_EQ(again.status().run->state, "complete");
    expect_both_circles(bay, "Circle 2 of 2 was not recorded to its end");
}

TEST(StationCircular, AfterAWholeCircleTheNextOneFollowsARestart) {
    Bay bay;
    first_life(bay, false);
    Life again{bay.shop};
    again.run(2s);
    second_circle_and_end(again, bay);
    EXPECT_EQ(again.status().run->state, "complete");
    expect_both_circles(bay, "Circle 1 of 2 was recorded to its end before");
}

TEST(StationCircular, ACircleDrivenWhileTheStationWasAwayEndsTheTestWithItsReason) {
    Bay bay;
    first_life(bay, true);
    Life again{bay.shop};
    again.run(8s); // the machine ends circle 2 by itself
    ask(again, 3);
    again.run(1s);
    EXPECT_NE(again.port->done, 3);
    ASSERT_EQ(again.port->refusals.size(), 1U);
    EXPECT_EQ(again.port->refusals[0].second, Fault::incomplete_run);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.closed);
    EXPECT_FALSE(read.run.complete);
    EXPECT_NE(read.run.closing_reason.find("Circle 2 was driven while the station was away"),
              std::string::npos);
}

/// It was answered before the daemon died, and its number stands until the next circle.
TEST(StationCircular, ACncThatDrivesTheCircleAtWhoseRequestItStandsEndsTheTestWithItsReason) {
    Bay bay;
    first_life(bay, true);
    Life again{bay.shop};
    again.run(1s);
    ask(again, 2);
    again.run(8s); // the machine ends circle 2 by itself
    ask(again, 3);
    again.run(1s);
    EXPECT_NE(again.port->done, 3);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.closed);
    EXPECT_FALSE(read.run.complete);
    EXPECT_NE(read.run.closing_reason.find("Circle 2 was driven while the station was away"),
              std::string::npos)
        << read.run.closing_reason;
}

TEST(StationCircular, AWholeCircleCountsWhereTheCncStillStandsAtItsRequest) {
    Bay bay;
    first_life(bay, false);
    Life again{bay.shop};
    again.run(2s);
    ask(again, 1);
    EXPECT_EQ(again.port->done, 1);
    second_circle_and_end(again, bay);
    expect_both_circles(bay, "Circle 1 of 2 was recorded to its end before");
}

TEST(StationCircular, ARestartWithAnotherStationFileClosesTheTest) {
    Bay bay;
    first_life(bay, false);
    bay.shop.config.text += "# changed\n";
    Life again{bay.shop};
    again.run(2s);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.closed);
    EXPECT_FALSE(read.run.complete);
    EXPECT_NE(read.run.closing_reason.find("station file was changed"), std::string::npos);
}

TEST(StationCircular, ARestartWithAnotherBallbarClosesTheTest) {
    Bay bay;
    first_life(bay, false);
    bay.shop.bar_serial = "S-2";
    Life again{bay.shop};
    again.run(2s);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_TRUE(read.closed);
    EXPECT_FALSE(read.run.complete);
    EXPECT_NE(read.run.closing_reason.find("has the serial number 'S-2', the run's has 'S-1'"),
              std::string::npos)
        << read.run.closing_reason;
}

TEST(StationCircular, ABarWhoseCounterWasSwitchedOffEndsTheTest) {
    Bay bay;
    first_life(bay, false);
    bay.shop.ballbar_switched_on = bay.shop.now; // an interferometer's zero is gone with its count
    Life again{bay.shop};
    again.run(2s);
    const RunFileContents read = contents_of(bay.shop);
    EXPECT_FALSE(read.run.complete);
    EXPECT_NE(read.run.closing_reason.find("Nothing proves that the ballbar's counter ran on"),
              std::string::npos);
}

} // namespace
} // namespace axiscal::testing::station_circular_test

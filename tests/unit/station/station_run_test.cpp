// The station from arming to the certificate, and what goes wrong on the way.
#include "tests/support/full_disk.hpp"
#include "tests/support/report_script.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_run_test {
namespace {

class StationRuns : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    Shop shop;
};

TEST_F(StationRuns, AHundredAndTenPointsInVirtualTime) {
    shop.config = Shop::make_config(shop.scratch.path());
    const auto script =
        report_script(shop.scratch, R"(echo "drawing $1"; echo "{\"entry\": \"$3/done\"}")");
    Life life{shop, script};
    ASSERT_TRUE(life.arm());
    EXPECT_EQ(life.port->armed, 1);
    std::vector<std::uint16_t> expected;
    for (int step = 0; step < 110; ++step) {
        ASSERT_TRUE(life.take(step)) << step;
        expected.push_back(static_cast<std::uint16_t>(step + 1));
    }
    EXPECT_EQ(life.port->acknowledged, expected);
    EXPECT_TRUE(life.port->refusals.empty());
    life.run_until([&] { return !life.status().run->certificate.empty(); });
    EXPECT_EQ(life.status().run->certificate, shop.scratch.file("outbox/done"));
    EXPECT_EQ(life.status().run->state, "complete");
    EXPECT_FALSE(life.status().run_open);
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_TRUE(run->complete);
    EXPECT_TRUE(check_complete(*run));
    EXPECT_EQ(run->points.size(), 110U);
    // Each point lies between two readings of every channel.
    EXPECT_LE(run->environment.front().at, run->points.front().window_begin);
}

TEST_F(StationRuns, WhatIsWrongWithTheSetUpIsToldWithTheCertificate) {
    Life life{shop, report_script(shop.scratch, R"(mkdir -p "$3/done"
echo "{\"entry\": \"$3/done\", \"setup\": [\"Set-up: an optic moved.\"]}")")};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step));
    life.run_until([&] { return !life.status().run->certificate.empty(); });
    EXPECT_EQ(life.notes_with("Set-up: an optic moved."), 1);
}

TEST_F(StationRuns, EveryPointIsOnDiskWhenDoneSaysSo) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 3; ++step) {
        ASSERT_TRUE(life.take(step));
        const auto run = read_run_file(shop.run_files().at(0));
        ASSERT_TRUE(run);
        EXPECT_EQ(run->points.size(), static_cast<std::size_t>(step + 1));
    }
}

// The laser's zero lies 5 mm beside that of the machine: the tying alone brings them together.
TEST_F(StationRuns, TheCncTiesTheDatumWithRequestOneAndThePointsCountFromTwo) {
    shop.drift_um = [](MonotonicTime) { return 5000.0; };
    Life life{shop};
    ArmRequest request;
    request.datum_by_cnc = true;
    ASSERT_TRUE(life.arm(request));
    EXPECT_EQ(life.port->done, 0) << "armed, and nothing is tied yet";
    EXPECT_TRUE(read_run_file(shop.run_files().at(0))->datums.empty());
    ASSERT_TRUE(life.prepare(1));
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step, static_cast<std::uint16_t>(step + 2))) << step;
    EXPECT_TRUE(life.port->refusals.empty());
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_TRUE(run->complete);
    EXPECT_TRUE(check_complete(*run));
    ASSERT_EQ(run->datums.size(), 1U);
    EXPECT_EQ(run->datums[0].sequence, 1) << "the request that tied it";
    EXPECT_NEAR(run->datums[0].coordinate.in(mm), shop.plan().datum.in(mm), 1e-9);
    EXPECT_LE(run->datums[0].at, run->points.front().window_begin);
    for (const PointRecord& point : run->points) {
        EXPECT_EQ(point.sequence, point.step + 2);
        // 1 m of an axis at 22.6 degC grows by 30 um, the index of the made air is off by 2 um.
        EXPECT_LT(std::abs(point.live_deviation.in(um)), 50) << point.step;
        EXPECT_EQ(point.datum_id, run->datums[0].id);
    }
}

// The reading moves by 0.5 um/s, the laser's time is known within 40 us.
TEST_F(StationRuns, EachCaptureStatesItsSynchronisationErrorInTheRunFileAndTheStatus) {
    shop.drift_um = [](MonotonicTime at) { return 0.5 * seconds_of(at.time_since_epoch()); };
    Life life{shop};
    life.laser->time_uncertainty = 40us;
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    ASSERT_TRUE(life.status().run->last_synchronisation_um);
    EXPECT_NEAR(*life.status().run->last_synchronisation_um, 0.5 * 40e-6, 1e-9);
    life.laser->time_uncertainty = 0us;
    ASSERT_TRUE(life.take(1));
    EXPECT_FALSE(life.status().run->last_synchronisation_um) << "not stated";
    const auto file = read_run_file_contents(shop.run_files().at(0));
    ASSERT_TRUE(file);
    const auto& kept = file->attachments.synchronisation;
    ASSERT_EQ(kept.size(), 3U);
    EXPECT_EQ(kept[0].step, -1);
    EXPECT_EQ(kept[1].step, 0);
    EXPECT_EQ(kept[1].datum_id, file->run.points[0].datum_id);
    ASSERT_TRUE(kept[0].stated && kept[1].stated);
    EXPECT_NEAR(kept[1].stated->error_um, 0.5 * 40e-6, 1e-9);
    EXPECT_FALSE(kept[2].stated);
}

// 2026-11-21: readings taken between two runs were kept and written into the next one.
TEST_F(StationRuns, WhatWasReadBetweenTwoRunsIsInNeither) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.abort("first"));
    life.run(60s);
    const MonotonicTime between = life.scheduler.now();
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    ASSERT_EQ(shop.run_files().size(), 2U);
    const auto second = read_run_file(shop.run_files().at(1));
    ASSERT_TRUE(second);
    ASSERT_FALSE(second->environment.empty());
    EXPECT_GT(second->environment.front().at, between - 2s); // the sensors' period
}

TEST_F(StationRuns, ALostBeamEndsTheRunAndIsToldOnce) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    life.laser->quality = Quality::beam_lost;
    life.run(1s);
    life.laser->quality = Quality::good;
    ++life.laser->epoch; // counts were lost meanwhile
    life.run(1s);
    EXPECT_EQ(life.status().run->state, "incomplete");
    EXPECT_EQ(life.status().run->last_fault, "datum_lost");
    EXPECT_FALSE(life.status().axis.position_mm);
    EXPECT_FALSE(life.take(1));
    ASSERT_EQ(life.port->refusals.size(), 1U);
    EXPECT_EQ(life.port->refusals[0].first, 2);
    EXPECT_EQ(life.status().run->last_fault, "datum_lost"); // and not "no run is armed"
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_EQ(std::ranges::count(run->events, Fault::datum_lost, &EventRecord::fault), 1);
    EXPECT_TRUE(life.arm()) << "a new run ties a new datum";
}

TEST_F(StationRuns, AStaleSensorWithholdsThePointUntilItIsBack) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.air->silent = true;
    life.run(61s);
    EXPECT_FALSE(life.take(0));
    ASSERT_EQ(life.port->refusals.size(), 1U);
    EXPECT_EQ(life.port->refusals[0],
              (std::pair<std::uint16_t, Fault>{1, Fault::environment_stale}));
    EXPECT_FALSE(life.port->status.air_degC);
    for (const ChannelView& channel : life.status().channels)
        if (channel.instrument == "air") {
            EXPECT_EQ(channel.quality, "stale");
            EXPECT_FALSE(channel.value);
        }
    life.air->silent = false;
    life.run(2s);
    life.port->refusals.clear();
    EXPECT_TRUE(life.take(0));
    EXPECT_TRUE(life.status().run->last_fault.empty());
}

// The air shows 23 degC and what it warms up by.
TEST_F(StationRuns, OutsideTheLimitsOfTheEnvironmentNothingIsCapturedUntilItIsBack) {
    double warmth_K = 0;
    shop.warmth_K = [&warmth_K](MonotonicTime) { return warmth_K; };
    shop.config.environment.air_temperature.high = 25;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    warmth_K = 2.5;
    life.run(60s);
    EXPECT_FALSE(life.take(1));
    EXPECT_EQ(life.port->refusals.at(0),
              (std::pair<std::uint16_t, Fault>{2, Fault::environment_outside}));
    EXPECT_EQ(life.status().run->last_fault, "environment_outside");
    EXPECT_NE(life.status().run->last_sentence.find("air/air temperature shows 25.5 degC"),
              std::string::npos);
    EXPECT_TRUE(life.status().run_open);
    EXPECT_EQ(life.notes_with("The environment is out of limits"), 1) << "told once";
    warmth_K = 1;
    life.run(15s);
    EXPECT_EQ(life.notes_with("The environment is within its limits again"), 1);
    life.port->refusals.clear();
    for (int step = 1; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    EXPECT_EQ(life.status().run->state, "complete");
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_EQ(std::ranges::count(run->events, Fault::environment_outside, &EventRecord::fault), 2)
        << "when it left its limits, and the request that was refused";
}

TEST_F(StationRuns, ARunThatWasArmedInSpiteOfTheEnvironmentIsNotHeldToItsLimits) {
    shop.config.environment.air_temperature.high = 22;
    {
        Life life{shop};
        const auto refused = life.arm();
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().detail.find("environment: air/air temperature shows 23 degC"),
                  std::string::npos)
            << refused.error().detail;
        ArmRequest request;
        request.overrides["environment"] = "the hall stays warm until Monday";
        ASSERT_TRUE(life.arm(request));
        life.run(10s);
        ASSERT_TRUE(life.take(0));
    }
    Life life{shop}; // and not after a restart
    EXPECT_TRUE(life.status().run_open);
    EXPECT_TRUE(life.take(1));
}

TEST_F(StationRuns, AMovingAxisTiesNoDatumAndTheNextArmDoes) {
    Life life{shop};
    shop.axis.speed_mm_per_s = 1;
    shop.axis.go(900, life.scheduler.now());
    const auto answer = life.begin_arm();
    life.run(15s);
    ASSERT_TRUE(*answer);
    ASSERT_FALSE(**answer);
    EXPECT_EQ((*answer)->error().fault, Fault::not_still);
    EXPECT_EQ(life.port->armed, 0);
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_FALSE(run->complete);
    EXPECT_NE(run->closing_reason.find("datum could not be tied"), std::string::npos);
    shop.axis.speed_mm_per_s = 400;
    EXPECT_TRUE(life.arm());
}

// 2026-11-21: a CNC that asked early spoiled the arming.
TEST_F(StationRuns, ACncThatAsksTooEarlyDoesNotSpoilTheArming) {
    Life life{shop};
    const auto answer = life.begin_arm();
    life.run(100ms);
    life.ask(Life::request_for(shop.plan().points[0], 1));
    EXPECT_EQ(life.port->refusals.back().second, Fault::no_run_armed);
    life.run(3s);
    ASSERT_TRUE(*answer);
    EXPECT_TRUE(**answer);
}

TEST_F(StationRuns, TwoPeopleArmOneRun) {
    Life life{shop};
    const auto first = life.begin_arm(), second = life.begin_arm();
    life.run(3s);
    ASSERT_TRUE(*first && *second);
    EXPECT_TRUE(**first);
    ASSERT_FALSE(**second);
    EXPECT_EQ((*second)->error().fault, Fault::busy);
    EXPECT_EQ(shop.run_files().size(), 1U);
    const auto third = life.begin_arm();
    life.run(1s);
    EXPECT_EQ((*third)->error().fault, Fault::busy);
}

TEST_F(StationRuns, AnAbortWhileTheDatumIsTiedEndsTheArming) {
    Life life{shop};
    const auto answer = life.begin_arm();
    life.run(100ms);
    ASSERT_TRUE(life.abort("the wrong machine"));
    life.run(1s);
    ASSERT_TRUE(*answer);
    EXPECT_FALSE(**answer);
    EXPECT_EQ(life.status().run->state, "incomplete");
    EXPECT_EQ(life.status().run->last_fault, "") << "a person's reason is no fault";
    EXPECT_EQ(life.status().run->last_sentence, "the wrong machine");
    EXPECT_EQ(life.port->armed, 0);
    EXPECT_FALSE(life.abort("again"));
}

// `axiscal arm` gave up after a minute, and the axis was armed all the same: the part program went on.
TEST_F(StationRuns, AnOrderIsDroppedWhenWhoGaveItHasGoneBeforeTheDatum) {
    Life life{shop};
    shop.axis.speed_mm_per_s = 1;
    shop.axis.go(5, life.scheduler.now());
    bool gone = false;
    ArmRequest order;
    order.has_gone = [&gone] { return gone; };
    const auto answer = life.begin_arm(order);
    life.run(2s);
    EXPECT_FALSE(*answer) << "the axis still moves";
    gone = true;
    life.run(10s); // it stands after three of them
    ASSERT_TRUE(*answer);
    ASSERT_FALSE(**answer);
    EXPECT_EQ((*answer)->error().fault, Fault::refused);
    EXPECT_EQ(life.port->armed, 0);
    EXPECT_EQ(life.status().run->state, "incomplete");
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_NE(run->closing_reason.find("hung up"), std::string::npos) << run->closing_reason;
    gone = false;
    shop.axis.speed_mm_per_s = 400;
    EXPECT_TRUE(life.arm(order));
    gone = true; // with the answer
    life.run(10s);
    EXPECT_EQ(life.status().run->state, "armed");
}

TEST_F(StationRuns, AfterARunTheClockMayNotSayAnEarlierDay) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.abort("enough"));
    life.run(1s);
    life.scheduler.utc_at_zero_ns -= std::int64_t{24 * 3600} * 1'000'000'000;
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().detail.find("clock: "), std::string::npos) << refused.error().detail;
    ArmRequest all_the_same;
    all_the_same.overrides["clock"] = "the last run had the wrong date";
    EXPECT_TRUE(life.arm(all_the_same));
}

TEST_F(StationRuns, ArmingNeedsLaserBeamAndEnvironment) {
    Life life{shop};
    ArmRequest other_pass;
    other_pass.pass = "stretch";
    EXPECT_EQ(life.arm(other_pass).error().fault, Fault::bad_request);
    ArmRequest not_armed; // as of "pass": "drift"
    not_armed.kind = TestKind::drift;
    not_armed.pass = "drift";
    EXPECT_NE(life.arm(not_armed).error().detail.find("'drift' is not planned"), std::string::npos);
    ArmRequest of_another_kind;
    of_another_kind.options["mirror"] = "reversed";
    EXPECT_EQ(life.arm(of_another_kind).error().field, "options.mirror");
    ArmRequest unknown;
    unknown.statements["operatr"] = "typed badly";
    EXPECT_EQ(life.arm(unknown).error().field, "statements.operatr");
    life.laser->quality = Quality::beam_lost;
    EXPECT_EQ(life.arm().error().fault, Fault::beam_lost);
    life.laser->silent = true;
    EXPECT_EQ(life.arm().error().fault, Fault::link_timeout);
    life.material->silent = true;
    life.run(61s);
    EXPECT_EQ(life.arm().error().fault, Fault::environment_stale);
    EXPECT_TRUE(shop.run_files().empty());
}

TEST_F(StationRuns, AFullDiskAcknowledgesNothingUntilItHasRoomAgain) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    {
        const FullDisk full;
        EXPECT_FALSE(life.take(1));
        life.run(5s);
        EXPECT_EQ(life.port->done, 1);
    }
    EXPECT_EQ(life.port->refusals.back(), (std::pair<std::uint16_t, Fault>{2, Fault::not_durable}));
    EXPECT_EQ(life.status().run->state, "stopped");
    EXPECT_TRUE(life.port->status.feed_hold);
    EXPECT_FALSE(life.port->status.may_move);
    life.port->refusals.clear();
    life.run_until([&] { return life.port->done == 2; }); // without being asked again
    EXPECT_TRUE(life.port->refusals.empty());
    for (int step = 2; step < 10; ++step)
        ASSERT_TRUE(life.take(step));
    life.run_until([&] { return life.status().run->state == "complete"; });
}

TEST_F(StationRuns, ARunAbortedOnAFullDiskIsClosedWhenItHasRoom) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    {
        const FullDisk full;
        EXPECT_FALSE(life.take(1));
        const auto answer = life.abort("disk full");
        ASSERT_FALSE(answer) << "nothing was closed";
        EXPECT_EQ(answer.error().fault, Fault::not_durable);
        EXPECT_NE(answer.error().detail.find("closes it once the disk takes records"),
                  std::string::npos);
        life.run(3s);
        EXPECT_EQ(life.status().run->state, "incomplete");
    }
    life.run_until([&] {
        const auto run = summarize_run_file(shop.run_files().front());
        return run && run->closed && !run->complete;
    });
    EXPECT_TRUE(life.arm());
}

TEST_F(StationRuns, AMissingReportProgramIsToldAndTheRunKept) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step));
    life.run_until([&] { return !life.status().run->last_sentence.empty(); });
    EXPECT_EQ(life.status().run->state, "complete");
    EXPECT_EQ(life.status().run->last_fault, "io");
    EXPECT_EQ(life.notes_with("No certificate for run"), 1);
    EXPECT_EQ(life.notes_with("axiscal export"), 1);
}

TEST_F(StationRuns, WithoutARunTheFirstNumberIsTheBaselineAndFurtherOnesAreRefused) {
    Life life{shop};
    TriggerEvent standing = Life::request_for(shop.plan().points[0], 17);
    standing.standing = true;
    life.ask(standing);
    EXPECT_TRUE(life.port->refusals.empty());
    for (int i = 0; i < 200; ++i)
        life.ask(Life::request_for(shop.plan().points[0], 18));
    EXPECT_EQ(life.port->refusals.back(),
              (std::pair<std::uint16_t, Fault>{18, Fault::no_run_armed}));
    EXPECT_EQ(life.notes_with("Request 18"), 1);
    TriggerEvent idle;
    const auto before = life.port->refusals.size();
    life.ask(idle);
    EXPECT_EQ(life.port->refusals.size(), before);
}

TEST_F(StationRuns, ATechniciansOwnTriggerAnswersForItselfOnly) {
    Life life{shop};
    EXPECT_EQ(life.station->trigger().error().fault, Fault::no_run_armed);
    ASSERT_TRUE(life.arm());
    life.ask(Life::request_for(shop.plan().points[3], 1)); // wrong target: refused for the CNC
    EXPECT_EQ(life.port->refusals.back().second, Fault::wrong_target);
    life.drive_to(shop.plan().points[0]);
    ASSERT_TRUE(life.station->trigger()) << "the CNC's refusal is not the technician's";
    EXPECT_EQ(life.station->trigger().error().fault, Fault::busy);
    life.run(2s);
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run && run->points.size() == 1);
    EXPECT_EQ(run->points[0].origin, TriggerOrigin::manual);
    EXPECT_EQ(life.port->done, 1);
}

TEST_F(StationRuns, ATriggerWhileTheDatumIsTiedIsRefusedAndTheArmingGoesOn) {
    Life life{shop};
    shop.axis.go(shop.plan().datum.in(mm), life.scheduler.now());
    life.run(4s);
    const auto armed = life.begin_arm();
    life.run(40ms);
    ASSERT_TRUE(life.status().run_open && !*armed) << "the datum is being tied";
    const auto triggered = life.station->trigger();
    ASSERT_FALSE(triggered);
    EXPECT_EQ(triggered.error().fault, Fault::busy);
    EXPECT_NE(triggered.error().detail.find("tied to the datum"), std::string::npos);
    life.run(3s);
    ASSERT_TRUE(*armed);
    EXPECT_TRUE(**armed) << describe((*armed)->error());
    EXPECT_TRUE(life.take(0));
}

/// Whatever a person asks for in vain, the cause of the fault stays where it was.
TEST_F(StationRuns, ARequestInVainLeavesTheCauseOfTheFault) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.ask(Life::request_for(shop.plan().points[3], 1));
    ASSERT_EQ(life.status().run->last_fault, "wrong_target");
    const std::string cause = life.status().run->last_sentence;
    RevisionRequest none;
    none.selection.target = 99;
    none.reason = "mistyped";
    EXPECT_EQ(life.retake(none).error().fault, Fault::bad_request);
    EXPECT_EQ(life.exclude(none).error().fault, Fault::bad_request);
    EXPECT_FALSE(life.arm());
    DriftRequest drift;
    const auto drifted = life.begin_drift(drift);
    EXPECT_TRUE(*drifted && !**drifted);
    EXPECT_FALSE(life.station->align({AlignmentAction::keep, {}}));
    EXPECT_FALSE(life.station->type_reading(3));
    EXPECT_EQ(life.status().run->last_fault, "wrong_target");
    EXPECT_EQ(life.status().run->last_sentence, cause);
    EXPECT_EQ(life.notes_with("no such point"), 0);
}

TEST_F(StationRuns, AnAbortAnswersWhenTheRunIsClosed) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    const auto answer = life.begin_abort("enough");
    EXPECT_FALSE(*answer);
    life.run_until([&] { return answer->has_value(); });
    EXPECT_TRUE(**answer);
    EXPECT_TRUE(summarize_run_file(shop.run_files().front())->closed);
}

/// Their names bear seconds.
TEST_F(StationRuns, ThreeRunsOfOneSecondAreArmed) {
    Life life{shop};
    life.run(4s);
    life.run(1s - (life.scheduler.now().time_since_epoch() % Duration{1s}));
    ArmRequest request;
    request.datum_by_cnc = true;
    for (int k = 0; k < 3; ++k) {
        const auto armed = life.begin_arm(request);
        life.run(100ms);
        ASSERT_TRUE(*armed && **armed) << k << ": " << (*armed ? describe((**armed).error()) : "");
        ASSERT_TRUE(life.abort("once more"));
    }
    EXPECT_EQ(shop.run_files().size(), 3U);
}

TEST_F(StationRuns, AClockThatWasSetBackDoesNotKeepARunFromBeingArmed) {
    const MonotonicTime begun = shop.now;
    for (int life_of = 0; life_of < 2; ++life_of) {
        shop.now = begun + life_of * 3600s;
        Life life{shop};
        const auto armed = life.arm();
        ASSERT_TRUE(armed) << describe(armed.error());
        ASSERT_TRUE(life.abort("the wrong day"));
        shop.utc_at_zero_ns -= 3'600'000'000'000;
        EXPECT_EQ(*armed, life_of == 0 ? "bench-20261121T100007Z-X" : "bench-20261121T100007Z-2-X");
    }
    EXPECT_EQ(shop.run_files().size(), 2U);
}

TEST_F(StationRuns, StatementsOfTheArmingReplaceThoseOfTheFile) {
    Life life{shop};
    ArmRequest request;
    request.statements = {{"state", "as left"}, {"customer", "hall 4"}};
    const auto id = life.arm(request);
    ASSERT_TRUE(id);
    EXPECT_EQ(*id, "bench-20261121T100007Z-X"); // armed 7 s after the virtual clock's zero
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_EQ(run->statements.state, "as left");
    EXPECT_EQ(run->statements.customer, "hall 4");
    EXPECT_EQ(run->statements.operator_name, "the station file's operator");
    EXPECT_EQ(run->statements.axis, "X");
    EXPECT_EQ(run->station_config, shop.config.text);
    EXPECT_EQ(run->config_hash, sha256_hex(shop.config.text));
    ASSERT_EQ(run->instruments.size(), 3U);
    EXPECT_EQ(run->instruments[0].serial, "S-1");
    EXPECT_NEAR(run->laser.vacuum_wavelength.in(nm), 632.991354, 1e-9);
    EXPECT_EQ(run->channels.size(), 6U); // laser, three of the air, two contacts
}

TEST_F(StationRuns, TimeLeftComesFromThePaceOfThePoints) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.run(300s); // people have a coffee
    ASSERT_TRUE(life.take(0));
    EXPECT_FALSE(life.status().run->seconds_left);
    const MonotonicTime first = life.scheduler.now();
    ASSERT_TRUE(life.take(1));
    ASSERT_TRUE(life.take(2));
    const double pace = seconds_of(life.scheduler.now() - first) / 2;
    ASSERT_TRUE(life.status().run->seconds_left);
    EXPECT_NEAR(*life.status().run->seconds_left, 7 * pace, pace);
}

TEST_F(StationRuns, ABrokenPortIsToldOnceAndTriedAgain) {
    shop.port_broken = true;
    Life life{shop};
    life.run(28s);
    EXPECT_NEAR(life.port->runs, 30, 1) << "once a second";
    EXPECT_EQ(life.notes_with("the address is taken"), 1);
    EXPECT_NE(life.status().trigger_note.find("the address is taken"), std::string::npos);

    life.port->broken = false;
    life.run(2s);
    const int runs = life.port->runs;
    ASSERT_TRUE(life.arm());
    EXPECT_TRUE(life.take(0)) << "the CNC is heard through the port that came back";
    EXPECT_EQ(life.status().trigger_note, "");
    EXPECT_EQ(life.port->runs, runs);

    life.port->broken = true;
    life.run(5s);
    EXPECT_GT(life.port->runs, runs + 3);
    EXPECT_EQ(life.notes_with("the address is taken"), 2) << "it had worked in between";
}

TEST_F(StationRuns, ACncWhoseHeartbeatStopsIsShownAsSilent) {
    Life life{shop};
    life.port->sink->on_cnc_silent(true);
    EXPECT_TRUE(life.status().cnc_silent);
    life.port->sink->on_cnc_silent(false);
    EXPECT_FALSE(life.status().cnc_silent);
    EXPECT_EQ(life.notes_with("heartbeat"), 2);
}

TEST_F(StationRuns, StoppingEndsThePortFirstAndLeavesTheRunOpen) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        ASSERT_TRUE(life.take(0));
        boost::asio::co_spawn(life.scheduler.loop(), life.station->stop(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
        life.run(3s);
        EXPECT_TRUE(life.port->ended);
        EXPECT_EQ(life.port->runs, 1);
    }
    EXPECT_EQ(testing::open_run_files(shop.scratch.file("runs")).size(), 1U);
    const auto run = read_run_file(shop.run_files().at(0));
    ASSERT_TRUE(run);
    EXPECT_EQ(run->events.back().kind, EventKind::interrupted);
}

} // namespace
} // namespace axiscal::testing::station_run_test

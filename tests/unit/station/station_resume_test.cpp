// A second daemon on the state folder of the first.
#include "acquisition/measurement/run_header.hpp"
#include "config/version.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/report_script.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_resume_test {
namespace {

class StationResumes : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    /// A daemon that dies after `points`.
    void die_after(int points) {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        life.run(10s); // older than what a restart counts again
        for (int step = 0; step < points; ++step)
            ASSERT_TRUE(life.take(step));
    }
    void pause(Duration span) { shop.now += span; }
    TriggerEvent standing(int step) const {
        auto event = Life::request_for(shop.plan().points[static_cast<std::size_t>(step)],
                                       static_cast<std::uint16_t>(step + 1));
        event.standing = true;
        return event;
    }
    RunRecord only_run() {
        EXPECT_EQ(shop.run_files().size(), 1U);
        return read_run_file(shop.run_files().at(0)).value();
    }
    Shop shop;
};

TEST_F(StationResumes, DoneIsPublishedAgainBeforeThePortOpensAndTheRunGoesOn) {
    die_after(6);
    pause(20s);
    Life life{shop};
    EXPECT_EQ(life.port->done_before_open, 6);
    EXPECT_EQ(life.port->armed, 0) << "done must not fall back to 0";
    life.ask(standing(5)); // the CNC still asks for 6
    EXPECT_EQ(life.port->acknowledged, (std::vector<std::uint16_t>{6, 6}));
    for (int step = 6; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    const RunRecord run = only_run();
    EXPECT_TRUE(run.complete);
    EXPECT_TRUE(check_complete(run));
    EXPECT_EQ(std::ranges::count(run.events, EventKind::resumed, &EventRecord::kind), 1);
}

/// The last daemon died between its last point and the closing row.
TEST_F(StationResumes, ARunWithAllItsPointsIsClosedAndCertifiedOnce) {
    die_after(9);
    {
        auto writer = RunFileWriter::reopen(shop.run_files().at(0)).value();
        PointRecord last = only_run().points.back();
        last.step = 9;
        last.sequence = 10;
        last.planned = shop.plan().points.at(9);
        RunBatch batch;
        batch.point = last;
        ASSERT_TRUE(writer.write(batch));
    }
    shop.journal_thread = JournalThread::own; // closes the run beside the start
    const std::string calls = shop.scratch.file("calls");
    Life life{shop, report_script(shop.scratch, "echo x >>'" + calls + "'; sleep 0.3\n" +
                                                    R"(echo "{\"entry\": \"$3/e\"}")")};
    for (int i = 0; i < 400 && life.notes_with("Certificate written") == 0; ++i) {
        life.run(200ms); // the run is closed within each step of the start
        life.scheduler.loop().restart();
        life.scheduler.loop().run_one_for(20ms);
    }
    life.run(5s); // past the second look for runs without certificate
    EXPECT_EQ(read_bytes(calls), "x\n");
    EXPECT_TRUE(only_run().complete);
}

TEST_F(StationResumes, TheInterruptionNamesTheVersionThatGoesOn) {
    die_after(6);
    pause(20s);
    Life life{shop};
    const RunRecord run = only_run();
    const auto event = std::ranges::find(run.events, EventKind::interrupted, &EventRecord::kind);
    ASSERT_NE(event, run.events.end());
    EXPECT_NE(event->text.find(std::string{" Version "} + software_version() + " goes on. "),
              std::string::npos)
        << event->text;
}

TEST(TakenUp, ByAnotherVersionNamesBoth) {
    RunRecord run;
    run.software_version = "0.0.9";
    EXPECT_EQ(taken_up_text(run), std::string{"Version "} + software_version() +
                                      " goes on; version 0.0.9 opened the run. ");
    run.software_version = software_version();
    EXPECT_EQ(taken_up_text(run), std::string{"Version "} + software_version() + " goes on. ");
}

TEST_F(StationResumes, OnAFullDiskTheRunWaitsForRoomAndGoesOnByItself) {
    die_after(6);
    std::optional<Life> life;
    {
        const FullDisk full;
        life.emplace(shop);
        EXPECT_TRUE(life->started) << "the station answers people meanwhile";
        life->run(30s);
        EXPECT_EQ(life->port->runs, 0) << "the CNC must not read a number that is not the run's";
        EXPECT_FALSE(life->status().run);
        EXPECT_EQ(life->notes_with("cannot be taken over yet"), 1) << "told once";
        EXPECT_EQ(life->arm().error().fault, Fault::not_durable);
    }
    life->run_until([&] { return life->port->runs == 1; });
    EXPECT_EQ(life->port->done_before_open, 6);
    EXPECT_EQ(life->notes_with("The disk takes records again"), 1);
    for (int step = 6; step < 10; ++step)
        ASSERT_TRUE(life->take(step)) << step;
    EXPECT_TRUE(check_complete(only_run()));
    EXPECT_EQ(life->notes_with("cannot be taken over yet"), 1);
}

TEST_F(StationResumes, OnAFullDiskARunThatCannotGoOnIsClosedWhenThereIsRoom) {
    die_after(6);
    shop.config.text += "# one word more\n";
    std::optional<Life> life;
    {
        const FullDisk full;
        life.emplace(shop);
        life->run(30s);
        EXPECT_EQ(life->notes_with("station file was changed"), 0);
    }
    life->run_until([&] { return life->port->runs == 1; });
    EXPECT_EQ(life->notes_with("station file was changed"), 1);
    EXPECT_TRUE(summarize_run_file(shop.run_files().at(0))->closed);
    life->ask(standing(6));
    EXPECT_EQ(life->port->refusals.at(0),
              (std::pair<std::uint16_t, Fault>{7, Fault::bad_configuration}));
    EXPECT_TRUE(life->arm());
}

/// A file that nobody can read keeps nobody from working while the disk is well.
TEST_F(StationResumes, AFileThatIsNoRunDoesNotKeepThePortShut) {
    die_after(6);
    write_bytes(shop.scratch.file("runs/strange.axiscal"), "somebody else's");
    Life life{shop};
    EXPECT_EQ(life.port->done_before_open, 6);
    EXPECT_EQ(life.port->runs, 1);
}

TEST_F(StationResumes, AStandingRequestForTheNextPointIsCaptured) {
    die_after(6);
    {
        Life between{shop}; // the axis moves on while nobody watches
        between.drive_to(shop.plan().points[6]);
    }
    Life life{shop};
    life.ask(standing(6));
    life.run(2s);
    EXPECT_EQ(life.port->done, 7);
    EXPECT_TRUE(life.take(7));
}

TEST_F(StationResumes, AnyOtherRequestIsASequenceLost) {
    die_after(6);
    Life life{shop};
    life.ask(standing(8));
    life.run(1s);
    EXPECT_EQ(life.port->refusals.at(0),
              (std::pair<std::uint16_t, Fault>{9, Fault::sequence_lost}));
    EXPECT_EQ(life.status().run->state, "incomplete");
    EXPECT_EQ(life.port->done, 65535) << "no run takes requests";
    EXPECT_FALSE(only_run().complete);
}

// 2026-11-21: done stayed at its first value and the program waited for 0 in vain.
TEST_F(StationResumes, ARunThatWaitsForItsPrepareOffersZeroAgain) {
    {
        Life life{shop};
        ArmRequest request;
        request.datum_by_cnc = true;
        ASSERT_TRUE(life.arm(request));
    }
    Life life{shop};
    EXPECT_EQ(life.port->armed, 1);
    EXPECT_EQ(life.port->done, 0);
    TriggerEvent prepare;
    prepare.command = TriggerCommand::prepare;
    prepare.sequence = 1;
    life.ask(prepare);
    life.run(2s);
    EXPECT_EQ(life.port->done, 1);
    life.drive_to(shop.plan().points[0]);
    life.ask(Life::request_for(shop.plan().points[0], 2));
    life.run(2s);
    EXPECT_EQ(life.port->done, 2);
}

TEST_F(StationResumes, TheDoneOfAPrepareIsPublishedAgainAndItsDatumHolds) {
    shop.now += 60s; // the laser was on long before
    {
        Life life{shop};
        ArmRequest request;
        request.datum_by_cnc = true;
        ASSERT_TRUE(life.arm(request));
        ASSERT_TRUE(life.prepare(1));
    }
    Life life{shop};
    life.run(3s); // the laser is counted for a while
    EXPECT_EQ(life.port->done_before_open, 1);
    ASSERT_TRUE(life.take(0, 2));
    const RunRecord run = only_run();
    ASSERT_EQ(run.datums.size(), 1U);
    EXPECT_EQ(run.points.at(0).datum_id, run.datums[0].id);
}

TEST_F(StationResumes, ARunThatDiedAtOnceGoesOnWhenItsLaserCounted) {
    shop.now += 60s; // the laser was on long before
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
    }
    Life life{shop};
    life.run(3s); // it is counted for a while
    EXPECT_TRUE(life.status().run_open);
    EXPECT_EQ(life.port->done, 0);
    EXPECT_TRUE(life.take(0));
}

// 2026-11-21: the receipt of a skip was not found again, done stayed unpublished.
TEST_F(StationResumes, ASkippedStepIsPublishedAgain) {
    die_after(5);
    {
        Life life{shop};
        TriggerEvent skip = standing(5);
        skip.standing = false;
        skip.command = TriggerCommand::skip;
        life.ask(skip);
        life.run(1s);
        ASSERT_EQ(life.port->done, 6);
    }
    Life life{shop};
    EXPECT_EQ(life.port->done_before_open, 6);
    EXPECT_TRUE(life.take(6));
}

TEST_F(StationResumes, AChangedStationFileClosesTheRunAndTheWaitingCncIsTold) {
    die_after(6);
    shop.config.text += "# one word more\n";
    Life life{shop};
    EXPECT_FALSE(life.status().run_open);
    EXPECT_FALSE(only_run().complete);
    EXPECT_EQ(life.notes_with("station file was changed"), 1);
    life.ask(standing(6));
    EXPECT_EQ(life.port->refusals.at(0),
              (std::pair<std::uint16_t, Fault>{7, Fault::bad_configuration}));
    EXPECT_TRUE(life.arm());
}

TEST_F(StationResumes, AnEnvironmentOutOfLimitsClosesTheRunAndTheWaitingCncIsTold) {
    shop.config.environment.air_temperature.high = 25;
    die_after(6);
    shop.warmth_K = [](MonotonicTime) { return 4.0; }; // the air shows 23 degC without
    Life life{shop};
    EXPECT_FALSE(life.status().run_open);
    const RunRecord run = only_run();
    EXPECT_FALSE(run.complete);
    EXPECT_NE(run.closing_reason.find("The environment is out of limits: air/air temperature shows "
                                      "27 degC, 25 degC at most are allowed"),
              std::string::npos)
        << run.closing_reason;
    life.ask(standing(6));
    EXPECT_EQ(life.port->refusals.at(0),
              (std::pair<std::uint16_t, Fault>{7, Fault::environment_outside}));
}

TEST_F(StationResumes, AnotherLaserClosesTheRun) {
    die_after(6);
    shop.laser_serial = "S-2";
    Life life{shop};
    EXPECT_FALSE(life.status().run_open);
    EXPECT_NE(only_run().closing_reason.find("S-2"), std::string::npos);
}

TEST_F(StationResumes, AnotherSensorOfTheEnvironmentClosesTheRun) {
    die_after(6);
    shop.air_serial = "S-2";
    Life life{shop};
    EXPECT_FALSE(life.status().run_open);
    const RunRecord run = only_run();
    EXPECT_FALSE(run.complete);
    EXPECT_EQ(run.closing_reason,
              "The instrument 'air' has the serial number 'S-2', the run's has 'S-1'.");
    life.ask(standing(6));
    EXPECT_EQ(life.port->refusals.at(0),
              (std::pair<std::uint16_t, Fault>{7, Fault::unknown_instrument}));
}

/// A sensor that has not answered within the wait closes nothing; what it says later counts.
class StationResumesWithASensorThatAnswersLate : public StationResumes {
protected:
    std::unique_ptr<Life> life_without_air() {
        die_after(6);
        shop.air_is_out = true;
        auto life = std::make_unique<Life>(shop);
        life->run(20s);
        EXPECT_TRUE(life->status().run_open);
        return life;
    }
    static void plug_in_air(Life& life) {
        life.air->unplugged = false;
        life.run(10s);
    }
};

TEST_F(StationResumesWithASensorThatAnswersLate, TheRunGoesOnWhereItIsTheRuns) {
    const auto life = life_without_air();
    plug_in_air(*life);
    ASSERT_TRUE(life->status().run_open);
    for (int step = 6; step < 10; ++step)
        ASSERT_TRUE(life->take(step)) << step;
    EXPECT_TRUE(only_run().complete);
}

TEST_F(StationResumesWithASensorThatAnswersLate, TheRunIsClosedWhereItIsAnother) {
    const auto life = life_without_air();
    life->air->serial = "S-2";
    plug_in_air(*life);
    EXPECT_FALSE(life->status().run_open);
    EXPECT_FALSE(only_run().complete);
    EXPECT_EQ(only_run().closing_reason,
              "The instrument 'air' has the serial number 'S-2', the run's has 'S-1'.");
    EXPECT_EQ(only_run().points.size(), 6U);
}

TEST_F(StationResumes, ALaserThatWasSwitchedOffMeanwhileHasLostTheDatum) {
    die_after(6);
    shop.laser_switched_on = shop.now + 20s; // its number begins again
    pause(30s);
    Life life{shop};
    EXPECT_FALSE(life.status().run_open);
    life.ask(standing(6));
    EXPECT_EQ(life.port->refusals.at(0), (std::pair<std::uint16_t, Fault>{7, Fault::datum_lost}));
}

/// The uMD0 numbers with 16 bits: at 200 Hz a round takes 328 s.
class SixteenBits : public StationResumes, public ::testing::WithParamInterface<bool> {};

// 2026-11-21: such a counter lost its datum at each restart after its number had wrapped.
TEST_P(SixteenBits, AreFollowedAcrossTheirEndWhenTheInstrumentSaysSo) {
    shop.now += 320s; // the number is near its end
    shop.laser_number_wraps = true;
    shop.laser_modulus = GetParam() ? 65'536 : 0;
    die_after(6);
    pause(20s);
    Life life{shop};
    EXPECT_EQ(life.status().run_open, GetParam());
}
INSTANTIATE_TEST_SUITE_P(ToldOrNot, SixteenBits, ::testing::Bool());

TEST_F(StationResumes, NumbersRunOnFromTheOldDaemonsLastOne) {
    die_after(3);
    pause(40s);
    Life life{shop};
    ASSERT_TRUE(life.take(3));
    const RunRecord run = only_run();
    ASSERT_EQ(run.points.size(), 4U);
    EXPECT_GT(run.points[3].window_begin - run.points[2].window_end, 40s);
    EXPECT_EQ(run.points[3].datum_id, run.points[2].datum_id);
}

} // namespace
} // namespace axiscal::testing::station_resume_test

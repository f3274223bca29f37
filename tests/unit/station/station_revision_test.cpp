// Pre-flight, retakes and exclusions through the whole station.
#include "tests/support/full_disk.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <algorithm>

namespace axiscal::testing::station_revision_test {
namespace {

class StationRevises : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static RevisionRequest of_target(int target, const std::string& reason = "coolant") {
        RevisionRequest request;
        request.selection.target = target;
        request.reason = reason;
        return request;
    }
    void whole_run(Life& life) {
        ASSERT_TRUE(life.arm());
        for (int step = 0; step < 10; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        life.run(2s);
        ASSERT_EQ(life.status().run->state, "complete");
    }
    [[nodiscard]] RunFileContents contents() const {
        return read_run_file_contents(shop.run_files().at(0)).value();
    }
    Shop shop;
};

TEST_F(StationRevises, DoesNotArmWhileACheckFailsUnlessItIsOverridden) {
    shop.config.instruments[1].due_on = "2020-01-01";
    Life life{shop};
    const auto refused = life.arm();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "preflight");
    EXPECT_NE(refused.error().detail.find("air was due for calibration on 2020-01-01"),
              std::string::npos);
    EXPECT_TRUE(shop.run_files().empty());
    ArmRequest request;
    request.overrides["certificates"] = "the new one is on its way";
    ASSERT_TRUE(life.arm(request));
    ASSERT_TRUE(life.take(0));
    const auto checks = contents().revisions.preflight;
    ASSERT_EQ(checks.size(), 12U);
    const auto dates = std::ranges::find(checks, "certificates", &PreflightRecord::name);
    ASSERT_NE(dates, checks.end());
    EXPECT_FALSE(dates->passed);
    EXPECT_EQ(dates->override_reason, "the new one is on its way");
}

TEST_F(StationRevises, WaitsForTheSoakThatIsAskedFor) {
    shop.config.preflight.soak_window = 60s;
    Life life{shop};
    ASSERT_FALSE(life.arm());
    life.run(60s);
    EXPECT_TRUE(life.arm());
}

TEST_F(StationRevises, TakesPointsAgainAfterTheRunWasClosed) {
    Life life{shop};
    whole_run(life);
    const auto answer = life.retake(of_target(2));
    ASSERT_TRUE(answer) << describe(answer.error());
    EXPECT_EQ(answer->last_request, 10);
    ASSERT_EQ(answer->points.size(), 2U);
    EXPECT_EQ(answer->points[0].step, 10);
    EXPECT_TRUE(life.status().run_open);
    EXPECT_EQ(life.status().run->retakes_left, 2);
    ASSERT_TRUE(life.take(2, 11));
    ASSERT_TRUE(life.take(7, 12));
    life.run(2s);
    EXPECT_EQ(life.status().run->state, "complete");
    const auto file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(file.revisions.closings, 2);
    ASSERT_EQ(file.revisions.superseded.size(), 2U);
    EXPECT_EQ(file.revisions.superseded[0].sequence, 3);
    EXPECT_EQ(file.run.points[2].sequence, 11);
    EXPECT_EQ(file.run.points[7].sequence, 12);
    EXPECT_TRUE(check_complete(file.run));
}

TEST_F(StationRevises, GoesOnWithARetakeAfterARestart) {
    {
        Life life{shop};
        whole_run(life);
        life.run(20s); // long enough to know how fast the laser counts
        ASSERT_TRUE(life.retake(of_target(2)));
        ASSERT_TRUE(life.take(2, 11));
    }
    Life life{shop};
    ASSERT_TRUE(life.status().run_open);
    ASSERT_TRUE(life.take(7, 12));
    life.run(2s);
    EXPECT_TRUE(contents().run.complete);
    EXPECT_EQ(contents().revisions.superseded.size(), 2U);
}

TEST_F(StationRevises, ARetakeThatCannotGoOnLeavesTheRunComplete) {
    {
        Life life{shop};
        whole_run(life);
        ASSERT_TRUE(life.retake(of_target(2)));
    }
    shop.laser_serial = "another";
    Life life{shop};
    const auto file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_NE(file.run.closing_reason.find("not every retake was done"), std::string::npos);
}

TEST_F(StationRevises, RefusesARetakeOnceTheBeamWasInterrupted) {
    Life life{shop};
    whole_run(life);
    life.laser->quality = Quality::beam_lost;
    life.run(1s);
    life.laser->quality = Quality::good;
    life.run(1s);
    const auto answer = life.retake(of_target(2));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().fault, Fault::datum_lost);
    EXPECT_NE(answer.error().detail.find("beam was interrupted"), std::string::npos);
    EXPECT_TRUE(contents().closed) << "the file was not touched";
}

TEST_F(StationRevises, TakesPointsAgainOfARunThatTheLastDaemonClosed) {
    {
        Life life{shop};
        whole_run(life);
    }
    shop.now += 60s;
    Life life{shop};
    EXPECT_FALSE(life.status().run) << "nobody has asked for it";
    life.run(2s);
    const auto answer = life.retake(of_target(2));
    ASSERT_TRUE(answer) << describe(answer.error());
    EXPECT_EQ(answer->last_request, 10);
    EXPECT_TRUE(life.status().run_open);
    ASSERT_TRUE(life.take(2, 11));
    ASSERT_TRUE(life.take(7, 12));
    life.run(2s);
    const auto file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(file.revisions.superseded.size(), 2U);
    const auto told =
        std::ranges::find(file.run.events, EventKind::interrupted, &EventRecord::kind);
    ASSERT_NE(told, file.run.events.end());
    EXPECT_NE(told->text.find("The laser counted on"), std::string::npos) << told->text;
    ASSERT_TRUE(life.retake(of_target(1))) << "it is this daemon's run now";
}

/// What a retake of the last daemon's run is refused with.
class StationRefuses : public StationRevises {
protected:
    Error refusal_in(Life& life) {
        life.run(2s);
        const auto answer = life.retake(of_target(2));
        EXPECT_FALSE(answer);
        EXPECT_TRUE(contents().closed) << "the file was not touched";
        return answer ? Error{} : answer.error();
    }
    void run_of_the_last_daemon() {
        Life life{shop};
        whole_run(life);
    }
};

TEST_F(StationRefuses, ARetakeWhenTheLaserWasSwitchedOffMeanwhile) {
    run_of_the_last_daemon();
    shop.laser_switched_on = shop.now + 10s;
    shop.now += 60s;
    Life life{shop};
    const Error error = refusal_in(life);
    EXPECT_EQ(error.fault, Fault::datum_lost);
    for (const char* words : {"axiscald was restarted", "its number advanced", "arm a new run"})
        EXPECT_NE(error.detail.find(words), std::string::npos) << error.detail;
}

TEST_F(StationRefuses, ARetakeWithAnotherLaser) {
    run_of_the_last_daemon();
    shop.laser_serial = "another";
    Life life{shop};
    EXPECT_NE(refusal_in(life).detail.find("'another'"), std::string::npos);
}

TEST_F(StationRefuses, ARetakeOnceTheBeamWasInterruptedSinceTheStart) {
    run_of_the_last_daemon();
    Life life{shop};
    life.laser->quality = Quality::beam_lost;
    life.run(100ms);
    life.laser->quality = Quality::good;
    EXPECT_NE(refusal_in(life).detail.find("beam was interrupted since axiscald was started"),
              std::string::npos);
}

TEST_F(StationRevises, LeavesAReadingOutOfARunThatTheLastDaemonClosed) {
    shop.config.cycle.approaches = 3;
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        for (int step = 0; step < 30; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        life.run(2s);
    }
    shop.laser_serial = "another"; // what is measured is measured
    Life life{shop};
    RevisionRequest request = of_target(1, "somebody leaned on the table");
    request.selection.direction = Direction::positive;
    request.selection.approach = 0;
    const auto excluded = life.exclude(request);
    ASSERT_TRUE(excluded) << describe(excluded.error());
    EXPECT_EQ(*excluded, 1);
    EXPECT_EQ(contents().revisions.exclusions.size(), 1U);
    EXPECT_TRUE(contents().closed && contents().run.complete);
}

/// As the report program stores it: moved_optic was found.
void store_finding(const std::string& path) {
    const std::string document = R"({"setup_findings":[{"error":"moved_optic"}]})";
    ASSERT_TRUE(store_result(path, {sha256_hex(document), document}));
}

AnswerRequest answer_to(const std::string& finding) {
    AnswerRequest request;
    request.finding = finding;
    request.text = "the table was bumped";
    request.by.name = "Jo Miller";
    return request;
}

TEST_F(StationRevises, KeepsAnAnswerToAFindingOfARunThatTheLastDaemonClosed) {
    {
        Life life{shop};
        whole_run(life);
    }
    store_finding(shop.run_files().at(0));
    Life life{shop};
    const auto answered = life.answer_finding(answer_to("moved_optic"));
    ASSERT_TRUE(answered) << describe(answered.error());
    const RunFileContents file = contents();
    ASSERT_EQ(file.revisions.answers.size(), 1U);
    EXPECT_EQ(file.revisions.answers[0].finding, "moved_optic");
    EXPECT_EQ(file.revisions.answers[0].text, "the table was bumped");
    EXPECT_EQ(file.revisions.orders.back().kind, "answer");
    EXPECT_EQ(file.revisions.orders.back().about, "moved_optic");
    EXPECT_EQ(file.revisions.orders.back().by.name, "Jo Miller");
    EXPECT_TRUE(file.closed && file.run.complete);
    EXPECT_EQ(file.revisions.closings, 2) << "its certificate is a new one";
    EXPECT_EQ(life.notes_with("is answered: the table was bumped; by Jo Miller"), 1);
    EXPECT_EQ(life.status().run->state, "complete");
}

TEST_F(StationRevises, RefusesAnAnswerToWhatWasNotFound) {
    Life life{shop};
    const auto words = [&](const std::string& finding) {
        const auto refused = life.answer_finding(answer_to(finding));
        return refused ? std::string{} : refused.error().detail;
    };
    EXPECT_NE(words("moved_optic").find("no run was measured yet"), std::string::npos);
    ASSERT_TRUE(life.arm());
    EXPECT_NE(words("moved_optic").find("the run is open"), std::string::npos);
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run(2s);
    EXPECT_NE(words("moved_optic").find("has no certificate yet"), std::string::npos);
    store_finding(shop.run_files().at(0));
    EXPECT_NE(words("growth").find("no finding 'growth'; it has moved_optic"), std::string::npos);
    EXPECT_TRUE(contents().revisions.answers.empty());
    EXPECT_EQ(contents().revisions.closings, 1);
}

template <class Value> Fault fault_of(const Result<Value>& answer) {
    return answer ? Fault::none : answer.error().fault;
}

/// Virtual time plays the same twice: the first life tells when the commit of point 2 begins, in
/// the second an order comes in while it is failing.
class StationRevisesOnAFailingDisk : public StationRevises {
protected:
    /// @returns when point 2 was asked to be written
    static MonotonicTime ask_for_the_second(Life& life) {
        life.drive_to(life.shop.plan().points[1]);
        // Laser and capture look at the same instants then, the capture first.
        const Duration beat = life.laser->send_every;
        life.run(beat - life.scheduler.now().time_since_epoch() % beat);
        life.ask(Life::request_for(life.shop.plan().points[1], 2));
        for (int i = 0; i < 4000 && life.port->done == 1 && life.port->refusals.empty(); ++i)
            life.run(1ms);
        return life.scheduler.now();
    }
    static RevisionRequest one_reading() {
        RevisionRequest request = of_target(1);
        request.selection.direction = Direction::positive;
        request.selection.approach = 0;
        return request;
    }
    void run_of_four(Life& life) {
        ASSERT_TRUE(life.arm());
        for (int step = 0; step < 40; ++step)
            ASSERT_TRUE(life.take(step)) << step;
        life.run(2s);
    }
    static MonotonicTime when_it_is_written() {
        Shop twin;
        twin.shorten();
        Life life{twin};
        EXPECT_TRUE(life.arm());
        EXPECT_TRUE(life.take(0));
        return ask_for_the_second(life);
    }
};

TEST_F(StationRevisesOnAFailingDisk, AnOrderLeavesTheRunAliveAndIsNotWrittenLater) {
    const MonotonicTime written = when_it_is_written();
    Life life{shop};
    std::optional<Result<RetakeAnswer>> answer;
    bool asked = false;
    shop.drift_um = [&](MonotonicTime at) {
        if (at == written && !std::exchange(asked, true))
            boost::asio::co_spawn(
                life.scheduler.loop(), life.station->retake(of_target(0)),
                [&answer](std::exception_ptr, Result<RetakeAnswer> r) { answer = std::move(r); });
        return 0.0;
    };
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    {
        const FullDisk full;
        ask_for_the_second(life);
        life.run(100ms);
        ASSERT_TRUE(asked && answer) << "the order came in while the commit failed";
        ASSERT_FALSE(*answer);
        EXPECT_EQ(answer->error().fault, Fault::not_durable);
        ASSERT_EQ(life.port->refusals.size(), 1U) << "and the commit did fail";
    }
    life.port->refusals.clear();
    life.run_until([&] { return life.port->done == 2; });
    for (int step = 2; step < 10; ++step)
        ASSERT_TRUE(life.take(step)) << step;
    life.run_until([&] { return life.status().run->state == "complete"; });
    EXPECT_TRUE(contents().revisions.retakes.empty()) << "who ordered it was told that it is not";
}

TEST_F(StationRevisesOnAFailingDisk, TheNextOrderIsTakenOnceTheDiskIsBack) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    {
        const FullDisk full;
        EXPECT_EQ(fault_of(life.retake(of_target(0))), Fault::not_durable);
    }
    life.run(3s);
    const auto answer = life.retake(of_target(0));
    ASSERT_TRUE(answer) << describe(answer.error());
    ASSERT_EQ(contents().revisions.retakes.size(), 1U) << "of the one that was lost nothing is left";
    EXPECT_EQ(contents().revisions.retakes[0].number, 1);
}

TEST_F(StationRevisesOnAFailingDisk, TheNextOrderForAClosedRunIsTakenOnceTheDiskIsBack) {
    shop.config.cycle.approaches = 4;
    Life life{shop};
    run_of_four(life);
    {
        const FullDisk full;
        EXPECT_EQ(fault_of(life.exclude(one_reading())), Fault::not_durable);
        life.run(3s);
        const auto meanwhile = life.exclude(one_reading());
        ASSERT_FALSE(meanwhile);
        EXPECT_EQ(meanwhile.error().detail,
                  "the disk cannot store the records of the run yet; 'axiscal status' shows why");
    }
    life.run(3s);
    const auto left_out = life.exclude(one_reading());
    ASSERT_TRUE(left_out) << describe(left_out.error());
    EXPECT_EQ(contents().revisions.exclusions.size(), 1U);
    EXPECT_TRUE(contents().closed);
    EXPECT_EQ(life.notes_with("nothing of the order is in it"), 1);
    EXPECT_TRUE(life.retake(of_target(2)));
}

/// A sync that fails may have written all the same: here another hand does it.
TEST_F(StationRevisesOnAFailingDisk, ARetakeThatIsInTheFileAfterAllIsTakenUp) {
    Life life{shop};
    whole_run(life);
    {
        const FullDisk full;
        ASSERT_EQ(fault_of(life.retake(of_target(2))), Fault::not_durable);
    }
    RunBatch batch;
    RetakeRecord& order = batch.retakes.emplace_back();
    order.reason = "coolant";
    order.points = {{10, 2}, {11, 7}};
    ASSERT_TRUE(RunFileWriter::reopen_closed(shop.run_files().at(0), batch));
    life.run(3s);
    EXPECT_TRUE(life.status().run_open);
    EXPECT_EQ(life.status().run->retakes_left, 2);
    EXPECT_EQ(life.notes_with("is in the run file all the same"), 1);
    ASSERT_TRUE(life.take(2, 11));
    ASSERT_TRUE(life.take(7, 12));
    life.run(2s);
    EXPECT_TRUE(contents().closed && contents().run.complete);
}

TEST_F(StationRevisesOnAFailingDisk, AnExclusionThatIsInTheFileAfterAllHolds) {
    shop.config.cycle.approaches = 4;
    Life life{shop};
    run_of_four(life);
    {
        const FullDisk full;
        ASSERT_EQ(fault_of(life.exclude(one_reading())), Fault::not_durable);
    }
    RunBatch batch;
    batch.exclusions.emplace_back().step = 1;
    batch.exclusions.back().reason = "coolant";
    ASSERT_TRUE(RunFileWriter::reopen_closed(shop.run_files().at(0), batch));
    life.run(3s);
    EXPECT_FALSE(life.status().run_open);
    EXPECT_EQ(life.status().run->excluded, 1);
    EXPECT_TRUE(contents().closed && contents().run.complete);
    EXPECT_FALSE(life.exclude(one_reading())) << "it is left out already";
}

TEST_F(StationRevisesOnAFailingDisk, AnAnswerThatIsInTheFileAfterAllHolds) {
    Life life{shop};
    whole_run(life);
    store_finding(shop.run_files().at(0));
    {
        const FullDisk full;
        const auto answered = life.answer_finding(answer_to("moved_optic"));
        ASSERT_FALSE(answered);
        ASSERT_EQ(answered.error().fault, Fault::not_durable) << describe(answered.error());
    }
    RunBatch batch;
    batch.answers.emplace_back().finding = "moved_optic";
    ASSERT_TRUE(RunFileWriter::reopen_closed(shop.run_files().at(0), batch));
    life.run(3s);
    EXPECT_EQ(life.notes_with("is in the run file all the same, and holds"), 1);
    EXPECT_TRUE(contents().closed && contents().run.complete);
    EXPECT_EQ(contents().revisions.answers.size(), 1U);
}

/// The last retake was broken off while the disk was gone: the run stays complete.
TEST_F(StationRevisesOnAFailingDisk, ARetakeIsTakenAfterAnAbortWithoutADisk) {
    Life life{shop};
    whole_run(life);
    ASSERT_TRUE(life.retake(of_target(2)));
    {
        const FullDisk full;
        ASSERT_FALSE(life.take(2, 11));
        EXPECT_FALSE(life.abort("the disk is full"));
    }
    life.port->refusals.clear();
    life.run_until([&] { return contents().closed; });
    life.run(3s);
    const auto answer = life.retake(of_target(1));
    ASSERT_TRUE(answer) << describe(answer.error());
    EXPECT_EQ(answer->last_request, 10);
    ASSERT_TRUE(life.take(2, 11)) << "of the order before";
}

TEST_F(StationRevises, SaysThatThereIsNothingToTakeAgain) {
    Life life{shop};
    const auto answer = life.retake(of_target(2));
    ASSERT_FALSE(answer);
    EXPECT_NE(answer.error().detail.find("no run was measured yet"), std::string::npos);
}

TEST_F(StationRevises, AnotherJobIsNotArmedWhileARetakeIsOpen) {
    Life life{shop};
    whole_run(life);
    ASSERT_TRUE(life.retake(of_target(2)));
    const auto armed = life.arm();
    ASSERT_FALSE(armed);
    EXPECT_EQ(armed.error().fault, Fault::busy);
    EXPECT_FALSE(life.retake(of_target(2))) << "it is asked for already";
    ASSERT_TRUE(life.abort("enough"));
    life.run(2s);
    EXPECT_TRUE(contents().run.complete);
}

TEST_F(StationRevises, LeavesAReadingOutOfAnOpenAndOfAClosedRun) {
    shop.config.cycle.approaches = 4;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 10; ++step)
        ASSERT_TRUE(life.take(step));
    RevisionRequest request = of_target(1, "somebody leaned on the table");
    request.selection.direction = Direction::positive;
    EXPECT_EQ(life.exclude(request).value_or(0), 1);
    for (int step = 10; step < 40; ++step)
        ASSERT_TRUE(life.take(step));
    life.run(2s);
    request.selection.target = 3;
    request.selection.approach = 0;
    const auto excluded = life.exclude(request);
    ASSERT_TRUE(excluded) << describe(excluded.error());
    EXPECT_EQ(life.status().run->excluded, 2);
    EXPECT_FALSE(life.status().run_open);
    const auto file = contents();
    EXPECT_TRUE(file.closed && file.run.complete);
    ASSERT_EQ(file.revisions.exclusions.size(), 2U);
    EXPECT_EQ(file.revisions.exclusions[0].step, 1);
    EXPECT_EQ(file.revisions.exclusions[1].step, 3);
    EXPECT_EQ(file.revisions.closings, 2);
}

} // namespace
} // namespace axiscal::testing::station_revision_test

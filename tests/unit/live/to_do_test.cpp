// The list of what to do, of what a station shows and knows.
#include "acquisition/live/to_do.hpp"

#include "acquisition/live/station_interface.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axiscal::to_do_test {
namespace {

InstrumentView instrument(const std::string& name, InstrumentState state) {
    InstrumentView view;
    view.name = name;
    view.state = state;
    view.since_utc_ns = 1'795'255'200'000'000'000; // 2026-11-21T10:00:00Z
    return view;
}

ChannelView channel(const std::string& of, const std::string& role, const std::string& quality) {
    ChannelView view;
    view.instrument = of;
    view.channel = view.name = of + " channel";
    view.role = role;
    view.used = !role.empty();
    view.quality = quality;
    if (quality == "good") view.value = 1;
    return view;
}

/// In order, with a laser and an air sensor.
StationStatus bench() {
    StationStatus status;
    status.utc = "2026-11-21T10:05:00Z";
    status.instruments = {instrument("laser", InstrumentState::available),
                          instrument("air", InstrumentState::available)};
    status.channels = {channel("laser", "axis", "good"), channel("air", "environment", "good")};
    return status;
}

RunStatus& open_run(StationStatus& status) {
    status.run_open = true;
    status.run.emplace();
    status.run->run_id = "run-1";
    status.run->state = "armed";
    status.run->file = "runs/run-1.axiscal";
    status.run->steps = 10;
    return *status.run;
}

void closed(StationStatus& status, const std::string& state) {
    open_run(status).state = state;
    status.run_open = false;
}

PreflightRecord fails(const std::string& name, const std::string& verdict) {
    return {name, false, false, verdict, ""};
}

std::vector<std::string> ids(const std::vector<ToDo>& list) {
    std::vector<std::string> names;
    for (const ToDo& entry : list)
        names.push_back(entry.id);
    return names;
}

/// The only one there is.
ToDo only(const std::vector<ToDo>& list) {
    EXPECT_EQ(list.size(), 1U) << ::testing::PrintToString(ids(list));
    return list.empty() ? ToDo{} : list.front();
}

using Ids = std::vector<std::string>;

TEST(ToDoList, IsEmptyOfAStationInOrder) {
    StationStatus status = bench();
    EXPECT_TRUE(things_to_do(status, {}).empty());
    open_run(status);
    EXPECT_TRUE(things_to_do(status, {}).empty());
}

TEST(ToDoList, DividesTheSentenceOfALostBeamIntoWhatIsSeenAndWhatIsNext) {
    StationStatus status = bench();
    RunStatus& run = open_run(status);
    run.last_fault = "beam_lost";
    run.last_sentence = std::string{fault_sentence(Fault::beam_lost)} + " laser/axis 1";
    status.notes = {"2026-11-21T10:04:00Z Request 3 is refused: " + run.last_sentence};
    const ToDo entry = only(things_to_do(status, {}));
    EXPECT_EQ(entry.id, "run/beam_lost");
    EXPECT_EQ(entry.rank, ToDoRank::stop);
    EXPECT_EQ(entry.seen, "The laser beam was lost. laser/axis 1");
    EXPECT_EQ(entry.next, "Restore the beam, move to the datum and arm again.");
    EXPECT_EQ(entry.since_utc, "2026-11-21T10:04:00Z");
}

TEST(ToDoList, TellsALostBeamOnceThoughRunAndChannelBothShowIt) {
    StationStatus status = bench();
    RunStatus& run = open_run(status);
    run.last_fault = "beam_lost";
    run.last_sentence = fault_sentence(Fault::beam_lost);
    status.channels[0] = channel("laser", "axis", "beam_lost");
    EXPECT_EQ(ids(things_to_do(status, {})), Ids{"run/beam_lost"});
}

TEST(ToDoList, PutsWhatHoldsTheCncFirst) {
    StationStatus status = bench();
    RunStatus& run = open_run(status);
    run.last_fault = "not_still";
    run.last_sentence = fault_sentence(Fault::not_still);
    status.cnc_silent = true;
    status.instruments[1].state = InstrumentState::unavailable;
    status.outbox.waiting = 3;
    status.outbox.alarm = "3 results wait for the share since 22 min: axiscal-publish is at work";
    status.outbox.publisher_runs = true;
    ToDoFacts facts;
    facts.disk = {"The run file cannot be written to disk. It is full.", "Make room."};
    EXPECT_EQ(
        ids(things_to_do(status, facts)),
        (Ids{"run/not_durable", "run/not_still", "trigger/silent", "instrument/air", "outbox"}));
}

TEST(ToDoList, TellsADiskThatFailsOnceWithItsWayOut) {
    StationStatus status = bench();
    RunStatus& run = open_run(status);
    run.last_fault = "not_durable";
    run.last_sentence = "The run file cannot be written to disk. It is full. Make room.";
    ToDoFacts facts;
    facts.disk = {"The run file cannot be written to disk. It is full.", "Make room."};
    const ToDo entry = only(things_to_do(status, facts));
    EXPECT_EQ(entry.source, ToDoSource::disk);
    EXPECT_EQ(entry.rank, ToDoRank::stop);
    EXPECT_EQ(entry.next, "Make room.");
    EXPECT_EQ(things_to_do(status, {}).front().rank, ToDoRank::look) << "the disk works again";
}

TEST(ToDoList, TakesTheWayOutOfAnInstrumentFromItsFault) {
    StationStatus status = bench();
    status.instruments[1].state = InstrumentState::unavailable;
    status.instruments[1].last_fault = Fault::link_timeout;
    status.instruments[1].last_note = std::string{fault_sentence(Fault::link_timeout)} + " tty 2";
    const ToDo entry = only(things_to_do(status, {}));
    EXPECT_EQ(entry.seen, "air: unavailable, The instrument does not answer. tty 2");
    EXPECT_EQ(entry.next, "Check cable, address and power.");
    EXPECT_EQ(entry.since_utc, "2026-11-21T10:00:00Z");
    EXPECT_EQ(entry.rank, ToDoRank::look) << "no run is open";
    open_run(status);
    EXPECT_EQ(things_to_do(status, {}).front().rank, ToDoRank::stop);
    status.channels[1] = channel("air", "", "none");
    EXPECT_EQ(things_to_do(status, {}).front().rank, ToDoRank::note) << "nobody needs it";
}

TEST(ToDoList, SaysNothingOfAnAutocollimatorOnTheWayToTheNextFace) {
    StationStatus status = bench();
    open_run(status);
    status.axis.reads_angle = true;
    status.channels[0] = channel("laser", "axis", "beam_lost");
    status.instruments[0].state = InstrumentState::faulty;
    EXPECT_TRUE(things_to_do(status, {}).empty());
    status.instruments[0].state = InstrumentState::unavailable;
    EXPECT_EQ(ids(things_to_do(status, {})), Ids{"instrument/laser"});
}

TEST(ToDoList, LetsTheBallbarLieInItsBoxWhileTheAxisIsMeasured) {
    StationStatus status = bench();
    status.instruments.push_back(instrument("bar", InstrumentState::unavailable));
    status.channels.push_back(channel("bar", "ballbar", "none"));
    open_run(status).pass = "whole";
    EXPECT_EQ(only(things_to_do(status, {})).rank, ToDoRank::note);
    status.run->pass = "circular";
    EXPECT_EQ(only(things_to_do(status, {})).rank, ToDoRank::stop);
}

TEST(ToDoList, NamesTheChannelsThatAreSilentBeforeTheirInstrumentIsGivenUp) {
    StationStatus status = bench();
    status.channels[1] = channel("air", "environment", "stale");
    ToDo entry = only(things_to_do(status, {}));
    EXPECT_EQ(entry.seen, "air (air channel): An air or material reading is missing or too old.");
    EXPECT_EQ(entry.next, "Check the sensor and its cable.");
    status.channels[1] = channel("air", "environment", "good");
    status.channels[0] = channel("laser", "axis", "stale");
    entry = only(things_to_do(status, {}));
    EXPECT_EQ(entry.seen, "laser (laser channel): The value is older than its limit.");
}

TEST(ToDoList, CallsATapeNoInstrument) {
    StationStatus status = bench();
    status.instruments[0].tape = "/tmp/a.tape";
    EXPECT_EQ(only(things_to_do(status, {})).next,
              "Remove the line `tape` from the station file and restart axiscald");
}

TEST(ToDoList, HasTheChecksAsTheyWereJudgedUntilARunIsOpen) {
    StationStatus status = bench();
    ToDoFacts facts;
    facts.judged.utc = "2026-11-21T10:03:00Z";
    facts.judged.checks = {fails("soak", "Wait."),
                           {"compensation", true, false, "All is stated.", ""},
                           {"dead_path", true, true, "It is 0 mm.", ""},
                           {"drift", false, false, "It drifts.", "because I say so"}};
    const auto list = things_to_do(status, facts);
    EXPECT_EQ(ids(list), (Ids{"preflight/soak", "preflight/dead_path"}));
    EXPECT_EQ(list[0].rank, ToDoRank::look);
    EXPECT_EQ(list[0].next, mend_or_override("soak"));
    EXPECT_EQ(list[0].since_utc, "2026-11-21T10:03:00Z");
    EXPECT_EQ(list[1].rank, ToDoRank::note);
    facts.judged.refused_arming = true;
    EXPECT_EQ(things_to_do(status, facts)[0].rank, ToDoRank::stop);
    open_run(status);
    EXPECT_TRUE(things_to_do(status, facts).empty());
}

TEST(ToDoList, LeavesOutChecksThatSayWhatStandsThereAlreadyAndKeepsTheirRank) {
    StationStatus status = bench();
    status.instruments[1].state = InstrumentState::unavailable;
    status.instruments[0].due_on = "2026-11-20";
    ToDoFacts facts;
    facts.judged.checks = {
        fails("instruments", "air is not available. Check the cables."),
        fails("certificates", "laser was due for calibration on 2026-11-20. Have it calibrated.")};
    facts.judged.refused_arming = true;
    const auto list = things_to_do(status, facts);
    EXPECT_EQ(ids(list), (Ids{"instrument/air", "due/laser"}));
    EXPECT_EQ(list[0].rank, ToDoRank::stop);
    EXPECT_EQ(list[1].rank, ToDoRank::stop);
}

TEST(ToDoList, CountsTheDayThatACertificateNamesAsItsLast) {
    StationStatus status = bench();
    status.instruments[0].due_on = "2026-11-21";
    EXPECT_TRUE(things_to_do(status, {}).empty());
    status.channels[1].due_on = "2026-11-20";
    EXPECT_EQ(ids(things_to_do(status, {})), Ids{"due/air/air channel"});
}

TEST(ToDoList, TellsWhatTheReadingsSayOfTheSetUpWithTheOrderThatAnswersIt) {
    StationStatus status = bench();
    closed(status, "complete");
    ToDoFacts facts;
    facts.findings = {{"moved_optic", "All are 3 um higher.", "An optic moved.", "Look at it."}};
    status.notes = {
        "2026-11-21T10:04:00Z Set-up: All are 3 um higher. An optic moved. Look at it."};
    const ToDo entry = only(things_to_do(status, facts));
    EXPECT_EQ(entry.source, ToDoSource::finding);
    EXPECT_EQ(entry.seen, "All are 3 um higher. An optic moved.");
    EXPECT_EQ(entry.next, "Look at it.");
    EXPECT_EQ(entry.command, "axiscal answer moved_optic TEXT");
    EXPECT_EQ(entry.since_utc, "2026-11-21T10:04:00Z");
}

TEST(ToDoList, NamesTheAbortThatUndoesRetakesWhereNothingElseIsLeft) {
    StationStatus status = bench();
    RunStatus& run = open_run(status);
    run.steps = 12, run.step = 10, run.retakes_asked = 2, run.retakes_left = 2;
    EXPECT_EQ(only(things_to_do(status, {})).undo, "axiscal abort");
    run.step = 8;
    EXPECT_EQ(only(things_to_do(status, {})).undo, "") << "an abort would end the plan, too";
}

TEST(ToDoList, DividesTheWarningOfSkippedPointsAtItsOrder) {
    StationStatus status = bench();
    RunStatus& run = open_run(status);
    run.skipped = 2;
    run.last_sentence = "Warning: 2 points skipped by the CNC, and not taken since: 'axiscal "
                        "retake' takes what is missing, 'axiscal abort' ends the run without.";
    const ToDo entry = only(things_to_do(status, {}));
    EXPECT_EQ(entry.rank, ToDoRank::look);
    EXPECT_EQ(entry.seen, "2 points skipped by the CNC, and not taken since.");
    EXPECT_EQ(entry.next, "'axiscal retake' takes what is missing, 'axiscal abort' ends the run "
                          "without.");
}

TEST(ToDoList, NotesARunThatAPersonEndedAndLooksAtOneThatAFaultEnded) {
    StationStatus status = bench();
    closed(status, "incomplete");
    status.run->last_sentence = "the door";
    EXPECT_EQ(only(things_to_do(status, {})).rank, ToDoRank::note);
    status.run->last_fault = "datum_lost";
    EXPECT_EQ(only(things_to_do(status, {})).rank, ToDoRank::look);
    EXPECT_EQ(only(things_to_do(status, {})).command, "axiscal arm");
}

TEST(ToDoList, SaysHowACertificateThatWasNotMadeIsTriedAgain) {
    StationStatus status = bench();
    closed(status, "complete");
    status.run->last_fault = "io";
    status.run->last_sentence = "axiscal-report failed: no font";
    EXPECT_EQ(only(things_to_do(status, {})).command, "axiscal export runs/run-1.axiscal");
}

TEST(ToDoList, NamesTheUndoOfStartingThePublisher) {
    StationStatus status = bench();
    status.outbox.waiting = 12;
    status.outbox.alarm = "12 results wait for the share since 5 h: axiscal-publish does not run "
                          "(systemctl start axiscal-publish)";
    const ToDo entry = only(things_to_do(status, {}));
    EXPECT_EQ(entry.rank, ToDoRank::look);
    EXPECT_EQ(entry.seen, status.outbox.alarm);
    EXPECT_EQ(entry.command, "sudo systemctl enable --now axiscal-publish");
    EXPECT_EQ(entry.undo, "sudo systemctl disable --now axiscal-publish");
}

TEST(ToDoList, NeverSaysTheSameTwiceAndAlwaysWhatIsNext) {
    StationStatus status = bench();
    for (InstrumentView& view : status.instruments)
        view.state = InstrumentState::faulty;
    status.trigger_note = "the address is taken";
    closed(status, "incomplete");
    status.run->last_sentence = "the door";
    const auto list = things_to_do(status, {});
    EXPECT_EQ(list.size(), 4U);
    for (const ToDo& entry : list) {
        EXPECT_FALSE(entry.next.empty()) << entry.id;
        EXPECT_EQ(std::ranges::count(list, entry.seen, &ToDo::seen), 1) << entry.seen;
        EXPECT_TRUE(entry.undo.empty() || !entry.command.empty()) << entry.id;
    }
}

} // namespace
} // namespace axiscal::to_do_test

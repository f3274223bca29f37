// The table of STATE and PERMIT of docs/trigger.md, row by row, in the words of the sequence-block.
#include "tests/support/full_disk.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::trigger_table_test {
namespace {

using namespace sequence_block;

struct Words {
    std::uint16_t state, permit, done;
    bool operator==(const Words&) const = default;
};
void PrintTo(const Words& words, std::ostream* out) {
    *out << "STATE " << words.state << ", PERMIT " << words.permit << ", done " << words.done;
}

class TriggerTable : public ::testing::Test {
protected:
    void SetUp() override { shop.shorten(); }
    static Words words_of(const Life& life) {
        return {life.port->words.word(state), life.port->words.word(permit),
                life.port->words.word(acknowledged_sequence)};
    }
    /// Words 1 to 9 as one FC16.
    static void write(Life& life,
                      std::uint16_t cmd,
                      std::uint16_t sequence,
                      int step = 0,
                      std::optional<Length> nominal = {}) {
        const PlannedPoint point = life.shop.plan().points[static_cast<std::size_t>(step)];
        const Length place = nominal.value_or(
            life.shop.plan().targets[static_cast<std::size_t>(point.target_index)]);
        const auto counts = static_cast<std::uint32_t>(std::lround(place.in(um)*10));
        const auto news = life.port->words.write_words(
            1,
            {cmd, sequence, static_cast<std::uint16_t>(point.target_index),
             static_cast<std::uint16_t>(point.direction == Direction::positive ? 1 : 2),
             static_cast<std::uint16_t>(counts >> 16), static_cast<std::uint16_t>(counts),
             static_cast<std::uint16_t>(point.approach), 0, 1000},
            life.scheduler.now());
        for (const TriggerEvent& event : news.events)
            life.port->sink->on_trigger(event);
    }
    static void take(Life& life, int step, std::uint16_t sequence) {
        life.drive_to(life.shop.plan().points[static_cast<std::size_t>(step)]);
        write(life, 2, sequence, step);
        life.run(2s);
        ASSERT_EQ(life.port->words.word(acknowledged_sequence), sequence);
    }
    Shop shop;
};

TEST_F(TriggerTable, WithoutARunTheAxisIsFreeAndARequestHolds) {
    Life life{shop};
    life.run(200ms);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
    write(life, 2, 3); // the baseline
    life.port->words.arm(), life.port->words.end_run(RunEnd::at_once);
    write(life, 2, 4);
    EXPECT_EQ(words_of(life), (Words{6, 2, 65535}));
    EXPECT_EQ(life.port->words.word(result), 12);
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
}

TEST_F(TriggerTable, WhileAPersonTiesTheDatumTheAxisStandsThenItMayMove) {
    Life life{shop};
    shop.axis.go(shop.plan().datum.in(mm), life.scheduler.now());
    life.run(4s);
    const auto armed = life.begin_arm();
    life.run(100ms);
    EXPECT_EQ(words_of(life), (Words{3, 0, 65535}));
    life.run(3s);
    EXPECT_EQ(words_of(life), (Words{2, 1, 0}));
}

TEST_F(TriggerTable, FromRequestToPointTheAxisStands) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    life.drive_to(shop.plan().points[0]);
    write(life, 2, 1);
    EXPECT_EQ(words_of(life), (Words{3, 0, 0}));
    life.run(2s);
    EXPECT_EQ(words_of(life), (Words{4, 1, 1}));
}

TEST_F(TriggerTable, ASkipIsAnsweredWithoutAPointAndWarnedOfAtOnce) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    write(life, 3, 1);
    EXPECT_EQ(words_of(life), (Words{3, 0, 0}));
    life.run(200ms);
    EXPECT_EQ(words_of(life), (Words{2, 1, 1}));
    EXPECT_EQ(life.port->words.word(result), 13);
    EXPECT_EQ(life.notes_with("Warning: request 1 of the CNC skipped a point"), 1);
    EXPECT_EQ(life.status().run->skipped, 1);
    EXPECT_EQ(life.status().run->last_fault, "");
    EXPECT_NE(life.status().run->last_sentence.find("axiscal retake"), std::string::npos);
}

TEST_F(TriggerTable, AfterARefusalTheAxisHoldsUntilTheRequestIsTakenBack) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    write(life, 2, 1, 3); // another target than the next
    EXPECT_EQ(words_of(life), (Words{6, 2, 0}));
    EXPECT_EQ(life.port->words.word(fault_sequence), 1);
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{6, 2, 0})) << "as long as it stands there";
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{2, 1, 0}));
    write(life, 7, 1); // no command here
    EXPECT_EQ(words_of(life), (Words{6, 2, 0}));
}

TEST_F(TriggerTable, WhileTheDiskTakesNothingTheAxisHolds) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    {
        const FullDisk full;
        life.drive_to(shop.plan().points[0]);
        write(life, 2, 1);
        life.run(2s);
        EXPECT_EQ(words_of(life), (Words{5, 2, 0}));
    }
    life.run_until([&] { return life.port->done == 1; });
    EXPECT_EQ(words_of(life), (Words{4, 1, 1}));
}

TEST_F(TriggerTable, ACompleteRunAndARetakeShowTheLastNumber) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    for (int step = 0; step < 10; ++step)
        take(life, step, static_cast<std::uint16_t>(step + 1));
    life.run(2s);
    EXPECT_EQ(words_of(life), (Words{1, 5, 10}));
    RevisionRequest again;
    again.selection.target = 2;
    again.reason = "coolant";
    ASSERT_TRUE(life.retake(again));
    EXPECT_EQ(words_of(life), (Words{2, 1, 10}));
    ASSERT_TRUE(life.abort("enough"));
    EXPECT_EQ(words_of(life), (Words{1, 5, 10})) << "it stays complete";
}

TEST_F(TriggerTable, ARunThatAPersonAbortsHoldsTheProgramUntilItBeginsAnew) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    ASSERT_TRUE(life.abort("enough"));
    EXPECT_EQ(words_of(life), (Words{1, 2, 65535}));
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535})) << "done is not 0: the program waits";
}

TEST_F(TriggerTable, ARunAbortedBeforeItsFirstPointShowsNoZeroAnyMore) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    EXPECT_EQ(words_of(life).done, 0);
    ASSERT_TRUE(life.abort("enough"));
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
}

TEST_F(TriggerTable, ARunThatAFaultEndsHolds) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    life.laser->epoch = 1;
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{5, 2, 65535}));
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{5, 1, 65535}));
}

TEST_F(TriggerTable, ARunThatAFaultEndsBetweenTwoRequestsDoesNotHold) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    write(life, 0, 0);
    life.laser->epoch = 1;
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{5, 1, 65535}));
}

TEST_F(TriggerTable, AnAbortWithTheNextNumberIsAnsweredFirst) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    write(life, 4, 2, 1);
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{1, 1, 2}));
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
}

TEST_F(TriggerTable, AnAbortWithAnotherNumberBreaksTheRunOff) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    write(life, 4, 9, 1);
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{1, 2, 65535}));
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
}

TEST_F(TriggerTable, APrepareIsOnDiskBeforeTheAxisMayMove) {
    Life life{shop};
    shop.axis.go(shop.plan().datum.in(mm), life.scheduler.now());
    life.run(4s);
    ArmRequest request;
    request.datum_by_cnc = true;
    ASSERT_TRUE(life.arm(request));
    EXPECT_EQ(words_of(life), (Words{2, 1, 0}));
    write(life, 1, 1, 0, shop.plan().datum);
    EXPECT_EQ(words_of(life), (Words{3, 0, 0}));
    life.run(3s);
    EXPECT_EQ(words_of(life), (Words{2, 1, 1}));
}

TEST_F(TriggerTable, ARefusalIsTakenBackByAnotherNumber) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    write(life, 2, 2, 3); // another target than the next
    EXPECT_EQ(words_of(life), (Words{6, 2, 1}));
    write(life, 2, 1); // the last durable one
    EXPECT_EQ(words_of(life), (Words{4, 1, 1}));
    EXPECT_EQ(life.port->words.word(fault_sequence), 0);
    write(life, 2, 7); // which is refused itself
    EXPECT_EQ(words_of(life), (Words{6, 2, 1}));
    EXPECT_EQ(life.port->words.word(fault_sequence), 7);
}

/// A client that connects anew writes what it stands at again.
TEST_F(TriggerTable, ARestartReleasesNoProgramWhoseRunWasBrokenOff) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        take(life, 0, 1);
        ASSERT_TRUE(life.abort("enough"));
        EXPECT_EQ(words_of(life), (Words{1, 2, 65535}));
    }
    Life life{shop};
    write(life, 2, 1);
    life.run(200ms);
    EXPECT_EQ(words_of(life), (Words{1, 2, 65535}));
    EXPECT_EQ(life.port->words.word(fault_sequence), 0) << "a baseline, and no request";
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
    ASSERT_TRUE(life.arm());
    EXPECT_EQ(words_of(life), (Words{2, 1, 0}));
}

TEST_F(TriggerTable, ARestartHoldsNoProgramThatEndedItsRunItself) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        take(life, 0, 1);
        write(life, 5, 2, 1);
        life.run(1s);
    }
    Life life{shop};
    write(life, 5, 2, 1);
    life.run(200ms);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
}

/// STATE 0 stands in a CNC's own registers only (cnc_mirrored_port_test.cpp).
TEST(TriggerWords, OfTheStationNeverReadStateZero) {
    const MapBench<SequenceBlockMap> words{false, false};
    EXPECT_EQ(words.word(state), 1);
    EXPECT_EQ(words.word(permit), 1);
}

/// The rows of a circular test: two circles, so that request 3 is the last.
class TriggerTableOfCircles : public TriggerTable {
protected:
    void SetUp() override {
        shop.config.circular = CircularConfig{};
        shop.config.circular->setup.bar_instrument = "ballbar";
        shop.config.ballbar = RoleConfig{"ballbar", "ballbar"};
        InstrumentConfig bar;
        bar.name = "ballbar";
        bar.driver = "made";
        shop.config.instruments.push_back(bar);
        shop.ballbar = [](MonotonicTime) { return 1e-3; };
    }
    static void arm_circles(Life& life) {
        life.run(2s);
        ArmRequest request;
        request.kind = TestKind::circular;
        const auto armed = life.begin_arm(request);
        life.run(1s);
        ASSERT_TRUE(*armed && **armed) << describe((**armed).error());
    }
    static void ask(Life& life, std::uint16_t cmd, std::uint16_t sequence) {
        write(life, cmd, sequence);
        life.run(200ms);
    }
};

TEST_F(TriggerTableOfCircles, FromArmingToItsLastRequestTheTestIsArmed) {
    Life life{shop};
    arm_circles(life);
    EXPECT_EQ(words_of(life), (Words{2, 1, 0}));
    ask(life, 2, 1);
    EXPECT_EQ(words_of(life), (Words{2, 1, 1}));
    ask(life, 2, 2);
    EXPECT_EQ(words_of(life), (Words{2, 1, 2}));
    ask(life, 2, 3);
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{1, 5, 3}));
}

TEST_F(TriggerTableOfCircles, ACommandThatNoCircleHasHoldsUntilItIsTakenBack) {
    Life life{shop};
    arm_circles(life);
    for (const std::uint16_t cmd : {std::uint16_t{1}, std::uint16_t{3}, std::uint16_t{5}}) {
        ask(life, cmd, 1);
        EXPECT_EQ(words_of(life), (Words{6, 2, 0})) << cmd;
        EXPECT_EQ(life.port->words.word(result), 5) << cmd;
        ask(life, 0, 0);
        EXPECT_EQ(words_of(life), (Words{2, 1, 0})) << cmd;
    }
    ask(life, 2, 2);
    EXPECT_EQ(words_of(life), (Words{6, 2, 0}));
    EXPECT_EQ(life.port->words.word(result), 11);
    ask(life, 2, 1);
    EXPECT_EQ(words_of(life), (Words{2, 1, 1}));
}

TEST_F(TriggerTableOfCircles, ATestThatIsBrokenOffHoldsTheProgram) {
    for (const bool by_cnc : {true, false}) {
        Life life{shop};
        arm_circles(life);
        ask(life, 2, 1);
        if (by_cnc)
            ask(life, 4, 2); // the next number, and not acknowledged all the same
        else
            ASSERT_TRUE(life.abort("enough"));
        life.run(1s);
        EXPECT_EQ(words_of(life), (Words{1, 2, 65535})) << by_cnc;
        ask(life, 0, 0);
        EXPECT_EQ(words_of(life), (Words{1, 1, 65535})) << by_cnc;
    }
}

TEST_F(TriggerTableOfCircles, ARequestThatTheDiskDoesNotTakeIsRefusedAndAskedForAgain) {
    Life life{shop};
    arm_circles(life);
    {
        const FullDisk full;
        ask(life, 2, 1);
        EXPECT_EQ(words_of(life), (Words{6, 2, 0}));
        EXPECT_EQ(life.port->words.word(result), 7);
    }
    life.run(3s);
    ask(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{2, 1, 0}));
    ask(life, 2, 1);
    EXPECT_EQ(words_of(life), (Words{2, 1, 1}));
}

TEST_F(TriggerTableOfCircles, AfterARestartItShowsNoNumberUntilTheCncHasAskedAgain) {
    {
        Life life{shop};
        arm_circles(life);
        ask(life, 2, 1);
    }
    Life life{shop};
    life.run(2s);
    EXPECT_EQ(words_of(life), (Words{2, 1, 65535}));
    ask(life, 2, 1);
    EXPECT_EQ(words_of(life), (Words{2, 1, 1}));
}

TEST_F(TriggerTable, ARunThatTheCncEndsIsAnsweredFirst) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take(life, 0, 1);
    write(life, 5, 2, 1);
    life.run(1s);
    EXPECT_EQ(words_of(life), (Words{1, 1, 2}));
    write(life, 0, 0);
    EXPECT_EQ(words_of(life), (Words{1, 1, 65535}));
}

/// The record of a skip is enough to know what is missing, also for the next daemon.
TEST_F(TriggerTable, ASkippedPointIsTakenAfterARestartAndTheRunIsComplete) {
    {
        Life life{shop};
        ASSERT_TRUE(life.arm());
        life.run(20s); // long enough to know how fast the laser counts
        take(life, 0, 1);
        write(life, 3, 2, 1);
        life.run(500ms);
        for (int step = 2; step < 10; ++step)
            take(life, step, static_cast<std::uint16_t>(step + 1));
        EXPECT_TRUE(life.status().run_open);
    }
    Life life{shop};
    ASSERT_TRUE(life.status().run_open);
    EXPECT_EQ(life.status().run->skipped, 1);
    RevisionRequest missing;
    missing.selection.target = shop.plan().points[1].target_index;
    missing.reason = "skipped by the CNC";
    missing.selection.direction = shop.plan().points[1].direction;
    ASSERT_TRUE(life.retake(missing));
    take(life, 1, 11);
    life.run(2s);
    const auto file = read_run_file_contents(shop.run_files().at(0));
    ASSERT_TRUE(file) << describe(file.error());
    EXPECT_TRUE(file->run.complete && check_complete(file->run));
    ASSERT_EQ(file->run.points.size(), 10U);
    EXPECT_TRUE(file->revisions.superseded.empty());
}

} // namespace
} // namespace axiscal::testing::trigger_table_test

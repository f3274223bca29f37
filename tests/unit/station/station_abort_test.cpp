// What an abort answers: how the run ended, or who holds up its end. Nobody waits for a reader.
#include "tests/unit/station/file_shell.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::testing::station_abort_test {
namespace {

/// Five points, upwards only.
void make_tiny(Shop& shop) {
    shop.shorten();
    shop.config.cycle.bidirectional = false;
}

void take_all_but(int left, Life& life) {
    const int points = static_cast<int>(life.shop.plan().points.size());
    for (int step = 0; step < points - left; ++step)
        ASSERT_TRUE(life.take(step)) << step;
}

/// Virtual time plays the same twice. @returns when the last point was asked to be written
MonotonicTime ask_for_the_last(Life& life) {
    const PlannedPoint last = life.shop.plan().points.back();
    const auto number = static_cast<std::uint16_t>(life.shop.plan().points.size());
    life.drive_to(last);
    // Laser and capture look at the same instants then, the capture first.
    const Duration beat = life.laser->send_every;
    life.run(beat - life.scheduler.now().time_since_epoch() % beat);
    life.ask(Life::request_for(last, number));
    for (int i = 0; i < 4000 && life.port->done != number && life.status().run_open; ++i)
        life.run(1ms);
    return life.scheduler.now();
}

MonotonicTime when_the_last_is_written() {
    Shop twin;
    make_tiny(twin);
    Life life{twin};
    EXPECT_TRUE(life.arm());
    take_all_but(1, life);
    return ask_for_the_last(life);
}

TEST(StationAborts, ThatTheRunIsCompleteIsSaidWhereTheLastPointWasOnItsWay) {
    const MonotonicTime written = when_the_last_is_written();
    Shop shop;
    make_tiny(shop);
    Life life{shop};
    std::shared_ptr<std::optional<Result<RunEnding>>> answer;
    shop.drift_um = [&](MonotonicTime at) {
        if (at == written && !answer) answer = life.begin_abort("enough");
        return 0.0;
    };
    ASSERT_TRUE(life.arm());
    take_all_but(1, life);
    ask_for_the_last(life);
    life.run(1s);
    ASSERT_TRUE(answer && *answer) << "it came in while the point was written";
    ASSERT_TRUE(**answer) << describe((**answer).error());
    EXPECT_TRUE((**answer)->complete);
    EXPECT_EQ((**answer)->reason, "Every planned point is durable.");
    EXPECT_EQ(life.status().run->state, "complete");
    RevisionRequest again;
    again.selection.target = 0;
    again.reason = "coolant";
    const auto retaken = life.retake(again);
    EXPECT_TRUE(retaken) << describe(retaken.error());
}

TEST(StationAborts, ARunThatIsNotDoneIsAbortedForTheReasonGiven) {
    Shop shop;
    make_tiny(shop);
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    const auto ended = life.abort("the beam is cut by a chip");
    ASSERT_TRUE(ended);
    EXPECT_FALSE(ended->complete);
    EXPECT_EQ(ended->reason, "the beam is cut by a chip");
}

/// The answer comes, and names who reads the file.
void expect_reader_named(const std::optional<Result<RunEnding>>& answer, const Shop& shop) {
    ASSERT_TRUE(answer) << "still at it";
    ASSERT_FALSE(*answer);
    EXPECT_EQ(answer->error().fault, Fault::busy);
    const std::string& told = answer->error().detail;
    EXPECT_NE(told.find(shop.run_files().at(0) + " is read by"), std::string::npos) << told;
    EXPECT_EQ(told.find("way to the disk"), std::string::npos) << told;
}

TEST(StationAborts, AReaderOfTheRunFileIsNamed) {
    Shop shop;
    make_tiny(shop);
    Life life{shop};
    ASSERT_TRUE(life.arm());
    ASSERT_TRUE(life.take(0));
    std::shared_ptr<std::optional<Result<RunEnding>>> answer;
    {
        const FileShell shell{shop.run_files().at(0)};
        answer = life.begin_abort("enough");
        life.run(6s);
        expect_reader_named(*answer, shop);
    }
    life.run(2s);
    EXPECT_EQ(life.status().run->state, "incomplete");
    EXPECT_TRUE(life.arm());
}

TEST(StationAborts, ADriftTestDoesNotWaitForAReaderForEver) {
    Shop shop;
    Life life{shop};
    life.run(2s);
    DriftRequest hour;
    hour.duration = 3600s;
    ASSERT_TRUE(**life.begin_drift(hour));
    life.run(3s);
    std::shared_ptr<std::optional<Result<RunEnding>>> answer;
    {
        const FileShell shell{shop.run_files().at(0)};
        answer = life.begin_abort("enough");
        life.run(6s);
        expect_reader_named(*answer, shop);
        EXPECT_EQ(life.abort("again").error().fault, Fault::busy);
    }
    life.run(2s);
    EXPECT_EQ(life.status().drift->state, "incomplete");
    EXPECT_EQ(life.status().drift->sentence, "enough");
}

/// Nor does who armed a run whose datum could not be tied.
TEST(StationAborts, AnArmingThatFailsDoesNotWaitForAReaderForEver) {
    Shop shop;
    make_tiny(shop);
    Life life{shop};
    life.run(4s);
    shop.drift_um = [n = 0](MonotonicTime) mutable { return ++n % 2 * 50.0; }; // never still
    const auto armed = life.begin_arm();
    life.run(1s);
    const FileShell shell{shop.run_files().at(0)};
    life.run(shop.config.capture.timeout + 10s);
    ASSERT_TRUE(*armed) << "still at it";
    EXPECT_FALSE(**armed);
}

/// Nothing was written then, so that the next order is not refused for it.
TEST(StationAborts, AReaderOfAClosedRunKeepsAnExclusionOnlyWhileItReads) {
    Shop shop;
    make_tiny(shop);
    shop.config.cycle.approaches = 3;
    Life life{shop};
    ASSERT_TRUE(life.arm());
    take_all_but(0, life);
    life.run(2s);
    RevisionRequest reading;
    reading.selection = {0, Direction::positive, 0};
    reading.reason = "coolant";
    {
        const FileShell shell{shop.run_files().at(0)};
        const auto refused = life.exclude(reading);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().fault, Fault::busy) << describe(refused.error());
    }
    const auto left_out = life.exclude(reading);
    EXPECT_TRUE(left_out) << describe(left_out.error());
}

} // namespace
} // namespace axiscal::testing::station_abort_test

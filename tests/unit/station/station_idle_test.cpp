// A station with nothing to do: what it wakes for, what it opens, and that it is there at once.
#include "acquisition/runfile/run_store.hpp"
#include "tests/support/opening_count.hpp"
#include "tests/unit/runfile/random_run.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <algorithm>

namespace axiscal::testing::station_idle_test {
namespace {

class StationIdle : public ::testing::Test {
protected:
    StationIdle() {
        shop.linked = true;
        shop.port_looks_every = 1000h; // the bench's port is not what is counted
    }
    static void unplug_all(Life& life) {
        life.links.plugged = false;
        for (BenchInstrument* one : {life.laser, life.air, life.material})
            one->unplugged = true;
    }
    static void plug_in_all(Life& life) {
        for (BenchInstrument* one : {life.laser, life.air, life.material})
            one->unplugged = false;
        life.links.plug_in();
    }
    static bool all_are(Life& life, InstrumentState state) {
        return std::ranges::all_of(life.status().instruments,
                                   [state](const auto& one) { return one.state == state; });
    }
    /// Of an hour, everything that time has woken.
    static std::uint64_t wakeups_of_an_hour(Life& life) {
        const std::uint64_t before = life.scheduler.wakeups();
        life.run(1h);
        return life.scheduler.wakeups() - before;
    }
    static int looks_of_an_hour(Life& life) {
        const int before = life.port->published;
        life.run(1h);
        return life.port->published - before;
    }
    /// Three instruments, each looked for every five minutes although nobody told of it.
    static constexpr std::uint64_t late_looks = 3 * 12;

    Shop shop;
};

TEST_F(StationIdle, WithoutDevicesItWakesForLateLooksAlone) {
    Life life{shop, "/nonexistent/axiscal-report", 0s};
    unplug_all(life);
    life.run(5min);
    ASSERT_TRUE(all_are(life, InstrumentState::unavailable));
    const int before = life.links.openings;
    EXPECT_LE(wakeups_of_an_hour(life), late_looks);
    EXPECT_LE(life.links.openings - before, static_cast<int>(late_looks));
}

TEST_F(StationIdle, WhatIsPluggedInIsBackAtOnceAndTheStationIsAwake) {
    Life life{shop};
    unplug_all(life);
    life.run(10h);
    EXPECT_FALSE(life.port->status.air_degC);
    plug_in_all(life);
    life.run(2s); // the slowest sends once a second
    EXPECT_TRUE(all_are(life, InstrumentState::available));
    EXPECT_EQ(life.port->status.air_degC, 23.0) << "shown to the CNC within a tenth of a second";
    EXPECT_GE(looks_of_an_hour(life), 35'900) << "ten times a second while somebody speaks";
}

TEST_F(StationIdle, WhatIsThereAndMuteIsTriedAgainHoweverEmptyTheNextPlaceIs) {
    Life life{shop};
    LinkSettings next = *life.laser->link;
    next.path = PlugBoard::nowhere;
    life.laser->asks_the_next_too = next;
    life.laser->unplugged = true;
    life.run(1s);
    life.laser->unplugged = false;
    const int before = life.laser->opened;
    life.run(1min);
    EXPECT_GE(life.laser->opened - before, 29) << "every two seconds";
    life.laser->asks_the_next_too.reset();
    life.run(5s);
    EXPECT_TRUE(all_are(life, InstrumentState::available));
}

/// The opener knows nothing of plugs (a network): the pauses are those of a cable back within 5 s.
TEST_F(StationIdle, WhereNobodyTellsOfPlugsItGoesOnTrying) {
    Life life{shop};
    life.links.deaf = true;
    unplug_all(life);
    life.run(1h);
    plug_in_all(life);
    life.run(5s);
    EXPECT_TRUE(all_are(life, InstrumentState::available));
}

TEST_F(StationIdle, FallsAsleepWhenEverythingReadHasGrownOldAndTheCncSeesItAbsent) {
    Life life{shop};
    life.run(10s);
    EXPECT_TRUE(life.port->status.air_degC);
    EXPECT_TRUE(life.port->status.material_degC);
    unplug_all(life);
    life.run(2min); // a reading is none after 60 s
    EXPECT_FALSE(life.port->status.air_degC);
    EXPECT_FALSE(life.port->status.material_degC);
    EXPECT_LE(wakeups_of_an_hour(life), late_looks);
}

TEST_F(StationIdle, AnInstrumentThatIsConnectedAndFallsSilentIsJudgedBeforeItSleeps) {
    Life life{shop};
    life.run(10s);
    for (BenchInstrument* one : {life.laser, life.air, life.material})
        one->silent = true;
    life.run(15s);
    EXPECT_TRUE(all_are(life, InstrumentState::unavailable));
}

TEST_F(StationIdle, ARunThatIsOpenKeepsTheTime) {
    Life life{shop};
    ASSERT_TRUE(life.arm());
    unplug_all(life);
    life.run(5min);
    EXPECT_GE(looks_of_an_hour(life), 35'900);
}

/// A person may put a result there, or the share be lost while nothing is measured.
TEST_F(StationIdle, AnAlarmOfTheOutboxIsToldWhileItIdles) {
    shop.config.publish.destination = "/nonexistent/share";
    shop.config.publish.alarm_count = 1;
    Life life{shop};
    unplug_all(life);
    life.run(10min);
    EXPECT_EQ(life.notes_with("Alarm"), 0);
    EXPECT_LE(wakeups_of_an_hour(life), late_looks + 61) << "once a minute into an empty outbox";
    std::filesystem::create_directory(shop.scratch.file("outbox/result"));
    life.run(1min);
    EXPECT_EQ(life.notes_with("Alarm"), 1);
}

TEST_F(StationIdle, IsReadyBeforeTheStoredRunsAreLookedInto) {
    constexpr int many = 200;
    std::filesystem::create_directories(shop.scratch.file("runs"));
    const std::string folder = shop.scratch.file("runs/"), first = folder + "first.axiscal";
    RandomRun random{3};
    RunRecord run = random.header();
    run.opened.utc_ns = 1'795'262'400'000'000'000; // 2026-11-21T12:00:00Z
    auto writer = RunFileWriter::create(first, run);
    ASSERT_TRUE(writer && writer->close(false, "aborted", random.tie()));
    for (std::int64_t i = 0; i < many; ++i) { // each a second before the other
        const std::string instant = instant_in_name(run.opened.utc_ns - i * 1'000'000'000);
        std::filesystem::copy_file(first, folder + "bench-" + instant + "-X.axiscal");
    }
    std::filesystem::remove(first);
    OpeningCount openings{shop.scratch.file("runs")};
    Life life{shop, "/nonexistent/axiscal-report", 0s};
    EXPECT_TRUE(life.started);
    const auto at_the_start = openings.take();
    EXPECT_EQ(at_the_start.size(), std::size_t{many});
    const auto opened = std::ranges::count_if(at_the_start, [](const auto& file) {
        return file.second > 1; // beyond the look at its first bytes
    });
    EXPECT_LE(opened, 2);
    life.run(3s);
    EXPECT_EQ(openings.take().size(), std::size_t{many}) << "whether one lacks its certificate";
}

} // namespace
} // namespace axiscal::testing::station_idle_test

// Which stored runs a starting station must open: every state that a life of a run file can be left
// in, made by the writer itself, and how many files are opened, counted by the kernel.
#include "acquisition/runfile/run_store.hpp"

#include "tests/support/opening_count.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::run_store_test {
namespace {

using testing::append;
using testing::open_run_files;
using testing::OpeningCount;
using testing::RandomRun;
using testing::read_bytes;
using testing::ScratchFolder;
using testing::write_bytes;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t noon_utc_ns = 1'795'262'400 * second_ns; // 2026-11-21T12:00:00Z

class RunStore : public ::testing::Test {
protected:
    RunFileWriter begin(const std::string& name, std::int64_t opened_utc_ns = noon_utc_ns) {
        RunRecord run = random.header();
        run.opened.utc_ns = opened_utc_ns;
        return RunFileWriter::create(scratch.file(name), run).value();
    }
    void store(const std::string& name, std::int64_t opened_utc_ns = noon_utc_ns) {
        RunFileWriter writer = begin(name, opened_utc_ns);
        EXPECT_TRUE(append(writer, random.point(0)));
        EXPECT_TRUE(writer.close(true, "done", random.tie()));
    }
    /// Opened in this boot so many seconds after its start, when the clock said that many after
    /// noon. @returns its path
    std::string store_run_of(const std::string& boot, double uptime_s, std::int64_t after_noon_s) {
        RunRecord run = random.header();
        run.boot_id = {boot};
        run.opened = tie_at(uptime_s, after_noon_s);
        const std::string path =
            scratch.file("bench-" + instant_in_name(run.opened.utc_ns) + "-X.axiscal");
        RunFileWriter writer = RunFileWriter::create(path, run).value();
        EXPECT_TRUE(writer.close(true, "done", random.tie()));
        return path;
    }
    static ClockTie tie_at(double uptime_s, std::int64_t after_noon_s) {
        const MonotonicTime at{from_seconds(uptime_s)};
        return {at, noon_utc_ns + after_noon_s * second_ns, at};
    }
    /// At a start of the station.
    [[nodiscard]] std::string newest_of(const PresentBoot& present) const {
        return look_through_runs(scratch.path(), present)->newest->path;
    }
    [[nodiscard]] StoredRuns look() const { return look_through_runs(scratch.path()).value(); }
    /// Not taken for a closed one that need not be opened.
    void expect_found_open(const std::string& name) const {
        const StoredRuns runs = look();
        EXPECT_TRUE(runs.folded.empty());
        ASSERT_EQ(runs.looked_into.size(), 1U);
        EXPECT_EQ(runs.looked_into[0].path, scratch.file(name));
        EXPECT_FALSE(runs.looked_into[0].closed);
        EXPECT_EQ(open_run_files(scratch.path()), std::vector{scratch.file(name)});
    }
    [[nodiscard]] unsigned char head(const std::string& name, std::size_t place) const {
        return static_cast<unsigned char>(read_bytes(scratch.file(name)).at(place));
    }

    ScratchFolder scratch;
    RandomRun random{1};
};

TEST_F(RunStore, OfAThousandClosedRunsOnlyTheNewestIsOpened) {
    constexpr int many = 1000;
    store("bench-20261121T120000Z-X.axiscal");
    const std::string bytes = read_bytes(scratch.file("bench-20261121T120000Z-X.axiscal"));
    for (int i = 1; i < many; ++i) // each a minute before the other
        write_bytes(scratch.file("bench-" + instant_in_name(noon_utc_ns - 60 * second_ns * i) +
                                 "-X.axiscal"),
                    bytes);
    OpeningCount openings{scratch.path()};
    const StoredRuns runs = look();
    const auto counts = openings.take();
    EXPECT_EQ(runs.folded.size(), std::size_t{many});
    EXPECT_TRUE(runs.looked_into.empty());
    EXPECT_EQ(runs.unreadable, 0U);
    EXPECT_EQ(runs.newest->path, scratch.file("bench-20261121T120000Z-X.axiscal"));
    // One look at the first bytes each; SQLite opens the newest besides.
    EXPECT_EQ(counts.size(), std::size_t{many});
    const auto more_than_once =
        std::ranges::count_if(counts, [](const auto& file) { return file.second > 1; });
    EXPECT_LE(more_than_once, 1);
}

TEST_F(RunStore, ARunIsFoundOpenWhileItIsWritten) {
    RunFileWriter writer = begin("r.axiscal");
    expect_found_open("r.axiscal");
    ASSERT_TRUE(append(writer, random.point(0)));
    expect_found_open("r.axiscal");
}

/// SQLite removes the WAL when the last connection is closed; the header still bears it.
TEST_F(RunStore, ARunIsFoundOpenAfterADaemonThatEndedInOrder) {
    {
        RunFileWriter writer = begin("r.axiscal");
        ASSERT_TRUE(append(writer, random.point(0)));
    }
    EXPECT_FALSE(std::filesystem::exists(scratch.file("r.axiscal-wal")));
    EXPECT_EQ(head("r.axiscal", 18), 2);
    expect_found_open("r.axiscal");
}

/// The name is there and the WAL is not yet: versions 1 like those of a closed run.
TEST_F(RunStore, ARunIsFoundOpenThatWasInterruptedBetweenItsNameAndItsWal) {
    std::filesystem::create_directory(scratch.file("r.axiscal-wal")); // no WAL can be made
    RunRecord run = random.header();
    EXPECT_FALSE(RunFileWriter::create(scratch.file("r.axiscal"), run));
    std::filesystem::remove(scratch.file("r.axiscal-wal"));
    ASSERT_EQ(head("r.axiscal", 18), 1);
    EXPECT_EQ(head("r.axiscal", 27), 1) << "file change counter";
    expect_found_open("r.axiscal");
}

TEST_F(RunStore, AClosedRunThatWasReopenedIsFoundOpen) {
    store("r.axiscal");
    RunBatch order;
    order.exclusions = {{0, monotonic_from_ns(9), 11, "a chip under the mirror"}};
    {
        auto writer = RunFileWriter::reopen_closed(scratch.file("r.axiscal"), order);
        ASSERT_TRUE(writer) << describe(writer.error());
        expect_found_open("r.axiscal");
    }
    expect_found_open("r.axiscal");
}

/// Database and WAL as a power cut leaves them after the closing row, before the folding.
TEST_F(RunStore, ARunThatWasInterruptedInItsClosingIsFoldedAndThenTakenForClosed) {
    const auto path = scratch.file("r.axiscal"), cut = scratch.file("cut.axiscal");
    std::optional writer{begin("r.axiscal")};
    const auto bytes = read_bytes(path);
    sqlite3* keeper = nullptr; // a reader keeps the WAL from being folded
    ASSERT_EQ(sqlite3_open(path.c_str(), &keeper), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(keeper, "BEGIN; SELECT * FROM run", nullptr, nullptr, nullptr), 0);
    EXPECT_FALSE(writer->close(true, "done", random.tie()));
    write_bytes(cut, bytes);
    write_bytes(cut + "-wal", read_bytes(path + "-wal"));
    sqlite3_close(keeper);
    writer.reset();
    std::filesystem::remove(path);
    const StoredRuns runs = look();
    EXPECT_EQ(runs.folded, std::vector{cut});
    EXPECT_TRUE(runs.newest->complete);
    EXPECT_TRUE(read_run_file(cut)->complete);
}

/// The closing row is in the file and the header still bears the WAL.
TEST_F(RunStore, AClosedRunThatWasNotFoldedIsLookedInto) {
    store("r.axiscal");
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(scratch.file("r.axiscal").c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, "PRAGMA journal_mode=WAL", nullptr, nullptr, nullptr), 0);
    sqlite3_close(connection);
    const StoredRuns runs = look();
    EXPECT_TRUE(runs.folded.empty());
    ASSERT_EQ(runs.looked_into.size(), 1U);
    EXPECT_TRUE(runs.looked_into[0].closed);
}

TEST_F(RunStore, AFileWithAnIndexBesideItIsLookedInto) {
    store("r.axiscal");
    EXPECT_EQ(look().folded.size(), 1U);
    write_bytes(scratch.file("r.axiscal-shm"), "left behind");
    const StoredRuns runs = look();
    EXPECT_TRUE(runs.folded.empty());
    EXPECT_EQ(runs.looked_into.size(), 1U);
}

/// Another process that finds the lock of the database given up takes itself for the last one and
/// removes the WAL. POSIX gives up all locks of a process with any descriptor of the file.
bool is_locked(const std::string& path) {
    const pid_t child = ::fork();
    if (child == 0) {
        constexpr off_t pending_byte = 0x40000000, lock_bytes = 512; // SQLite's
        struct flock wanted {};
        wanted.l_type = F_WRLCK;
        wanted.l_whence = SEEK_SET;
        wanted.l_start = pending_byte;
        wanted.l_len = lock_bytes;
        const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
        const bool asked = file >= 0 && ::fcntl(file, F_GETLK, &wanted) == 0;
        ::_exit(asked && wanted.l_type != F_UNLCK ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

TEST_F(RunStore, ARunThatIsWrittenKeepsItsLock) {
    std::optional writer{begin("r.axiscal")};
    ASSERT_TRUE(is_locked(scratch.file("r.axiscal")));
    EXPECT_EQ(look().looked_into.size(), 1U);
    EXPECT_TRUE(is_locked(scratch.file("r.axiscal")));
    writer.reset();
    EXPECT_FALSE(is_locked(scratch.file("r.axiscal")));
}

TEST_F(RunStore, WhatIsNoRunIsCounted) {
    store("r.axiscal");
    write_bytes(scratch.file("strange.axiscal"), "somebody else's");
    write_bytes(scratch.file("notes.txt"), "not looked at");
    const StoredRuns runs = look();
    EXPECT_EQ(runs.folded.size(), 1U);
    EXPECT_EQ(runs.unreadable, 1U);
}

TEST_F(RunStore, TheNewestIsTheOneThatWasOpenedLastWhateverNamesSay) {
    store("bench-20261121T110000Z-X.axiscal", noon_utc_ns - 3600 * second_ns);
    store("kept by hand.axiscal", noon_utc_ns);
    EXPECT_EQ(look().newest->path, scratch.file("kept by hand.axiscal"));
    store("bench-20261121T130000Z-X.axiscal", noon_utc_ns + 3600 * second_ns);
    EXPECT_EQ(look().newest->path, scratch.file("bench-20261121T130000Z-X.axiscal"));
    store("bench-20991231T235959Z-X.axiscal", noon_utc_ns - 7200 * second_ns);
    EXPECT_EQ(look().newest->path, scratch.file("bench-20261121T130000Z-X.axiscal"));
    store("other-20261121T130000Z-Y.axiscal", noon_utc_ns + 3600 * second_ns + 500'000'000);
    EXPECT_EQ(look().newest->path, scratch.file("other-20261121T130000Z-Y.axiscal"))
        << "in the same second";
}

TEST_F(RunStore, AfterASetBackOfTheClockTheLaterRunOfTheBootIsTheNewest) {
    store_run_of("b", 100, -7200);
    const auto before = store_run_of("b", 7300, 0);
    const auto after = store_run_of("b", 9100, 1800 - 3600); // by an hour, half an hour later
    OpeningCount openings{scratch.path()};
    EXPECT_EQ(newest_of({"b", tie_at(9700, 2400 - 3600)}), after);
    const auto counts = openings.take();
    EXPECT_EQ(std::ranges::count_if(counts, [](const auto& file) { return file.second > 1; }), 2)
        << "what lies before the hour is not looked into";
    const auto long_after = store_run_of("b", 20'000, 9100);
    EXPECT_EQ(newest_of({"b", tie_at(20'100, 9200)}), long_after) << "later by both";
    EXPECT_NE(newest_of({"b", tie_at(20'100, 9200)}), before);
}

TEST_F(RunStore, ARunOfThePresentBootIsNewerThanOnesInTheFuture) {
    constexpr std::int64_t year_s = 365 * 86'400;
    store_run_of("an evil clock", 100, year_s);
    store_run_of("an evil clock", 4000, year_s + 3900);
    store_run_of("an earlier one", 100, -86'400);
    const auto present = store_run_of("b", 300, 0);
    EXPECT_EQ(newest_of({"b", tie_at(900, 600)}), present);
}

TEST_F(RunStore, OfRunsThatAllLieInTheFutureTheLatestAloneIsLookedInto) {
    for (int i = 0; i < 20; ++i)
        store_run_of("b", 100 + 60 * i, 60 * i);
    OpeningCount openings{scratch.path()};
    look_through_runs(scratch.path(), {"c", tie_at(50, -86'400)});
    const auto counts = openings.take();
    EXPECT_EQ(std::ranges::count_if(counts, [](const auto& file) { return file.second > 1; }), 1);
}

RunSummary summary_of(const std::string& path, const std::string& boot, double uptime_s, int utc) {
    RunSummary run;
    run.path = path, run.boot_id = {boot};
    run.opened_at = MonotonicTime{from_seconds(uptime_s)};
    run.opened_utc_ns = utc;
    return run;
}

TEST(RunOrder, WithinABootGoesByItsMonotonicClockAndBootsByTheirLatestUtc) {
    const std::vector runs{summary_of("a", "one", 10, 5), summary_of("b", "one", 20, 3),
                           summary_of("c", "two", 90, 4), summary_of("d", "two", 5, 1)};
    EXPECT_EQ(newest_run(runs, {""})->path, "b");
    EXPECT_EQ(newest_run(runs, {"two"})->path, "c") << "this boot is later than any other";
    EXPECT_EQ(newest_run(runs, {"three"})->path, "b");
    EXPECT_EQ(newest_run({}, {"one"}), nullptr);
}

TEST(RunOrder, OfRunsThatStateNoBootTheUtcAloneDecides) {
    const std::vector runs{summary_of("a", "", 90, 5), summary_of("b", "", 10, 7),
                           summary_of("c", "one", 10, 6)};
    EXPECT_EQ(newest_run(runs, {""})->path, "b");
}

TEST_F(RunStore, NoFolderHoldsNoRuns) {
    const auto runs = look_through_runs(scratch.file("missing"));
    ASSERT_TRUE(runs);
    EXPECT_FALSE(runs->newest);
}

} // namespace
} // namespace axiscal::run_store_test

#include "acquisition/journal/journal.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/virtual_scheduler.hpp"
#include "tests/unit/journal/manual_clock.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::journal_test {
namespace {

using namespace std::chrono_literals;
using testing::ManualClock;
using testing::open_run_files;
using testing::RandomRun;
using testing::same_bits;
using testing::ScratchFolder;

/// Runs one coroutine to its end and hands over what it returns.
template <class T> Result<T> finish(boost::asio::io_context& loop, Task<Result<T>> task) {
    std::optional<Result<T>> outcome;
    std::exception_ptr thrown;
    boost::asio::co_spawn(loop, std::move(task), [&](std::exception_ptr error, Result<T> result) {
        thrown = error;
        outcome.emplace(std::move(result));
    });
    loop.restart();
    loop.run();
    if (thrown) std::rethrow_exception(thrown);
    return std::move(outcome).value();
}

using Receipt = std::pair<int, int>; // sequence, step: a JournalReceipt cannot be made here

struct Station {
    boost::asio::io_context loop{1};
    AsioScheduler scheduler{loop};
    Journal journal;
    explicit Station(JournalThread thread = JournalThread::own,
                     JournalClock& clock = JournalClock::steady())
        : journal{scheduler, thread, clock} {}
    Result<void> run(Task<Result<void>> task) { return finish(loop, std::move(task)); }
    Result<Receipt> receipt(Task<Result<JournalReceipt>> task) {
        return finish(loop, unpack(std::move(task)));
    }
    static Task<Result<Receipt>> unpack(Task<Result<JournalReceipt>> task) {
        const auto receipt = co_await std::move(task);
        if (!receipt) co_return tl::unexpected<Error>(receipt.error());
        co_return Receipt{receipt->sequence(), receipt->step()};
    }
};

/// Runs `child` in a process of its own; its wait status.
template <class Child> int in_child(Child child) {
    const pid_t pid = ::fork();
    if (pid == 0) {
        child();
        ::_exit(::testing::Test::HasFailure() ? 1 : 0);
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    return status;
}

class JournalOnEitherThread : public ::testing::TestWithParam<JournalThread> {};
INSTANTIATE_TEST_SUITE_P(Threads,
                         JournalOnEitherThread,
                         ::testing::Values(JournalThread::own, JournalThread::caller));

TEST_P(JournalOnEitherThread, GivesAReceiptForWhatIsOnDisk) {
    const ScratchFolder scratch;
    Station station{GetParam()};
    RandomRun random{1};
    const auto path = scratch.file("r.axiscal");
    RunRecord run = random.header();
    ASSERT_TRUE(station.run(station.journal.open(path, run)));
    run.datums.push_back(random.datum());
    const auto tied = station.receipt(station.journal.commit(run.datums[0]));
    EXPECT_EQ(tied.value(), Receipt(run.datums[0].sequence, -1));
    for (int step = 0; step < 5; ++step) {
        run.points.push_back(random.point(step));
        run.events.push_back(random.event());
        run.environment.push_back({1, MonotonicTime{Duration{step}}, 20.0 + step});
        station.journal.note(run.events.back());
        station.journal.note(std::vector{run.environment.back()});
        const auto receipt = station.receipt(station.journal.commit(run.points.back()));
        EXPECT_EQ(receipt.value(), Receipt(run.points.back().sequence, step));
        EXPECT_TRUE(same_bits(run, read_run_file(path).value())); // not only in memory
    }
}

TEST_P(JournalOnEitherThread, GivesAReceiptForAnEventThatTheCncWaitsFor) {
    const ScratchFolder scratch;
    Station station{GetParam()};
    RandomRun random{2};
    const auto path = scratch.file("r.axiscal");
    RunRecord run = random.header();
    ASSERT_TRUE(station.run(station.journal.open(path, run)));
    run.events.push_back(random.event());
    const auto receipt = station.receipt(station.journal.commit(run.events[0], 3));
    EXPECT_EQ(receipt.value(), Receipt(run.events[0].sequence, 3));
    EXPECT_TRUE(same_bits(run, read_run_file(path).value()));
}

TEST_P(JournalOnEitherThread, ClosesAndOpensTheNextRun) {
    const ScratchFolder scratch;
    Station station{GetParam()};
    RandomRun random{2};
    const auto first = scratch.file("a.axiscal"), second = scratch.file("b.axiscal");
    ASSERT_TRUE(station.run(station.journal.open(first, random.header())));
    EXPECT_EQ(station.run(station.journal.open(second, random.header())).error().fault,
              Fault::busy);
    station.journal.note(random.event());
    ASSERT_TRUE(station.run(station.journal.close(true, "done")));
    const auto closed = read_run_file(first).value();
    EXPECT_TRUE(closed.complete);
    EXPECT_EQ(closed.events.size(), 1U);
    EXPECT_TRUE(station.run(station.journal.open(second, random.header())));
}

TEST(Journal, RefusesToCommitWithoutARun) {
    Station station;
    RandomRun random{3};
    EXPECT_EQ(station.receipt(station.journal.commit(random.point(0))).error().fault,
              Fault::no_run_armed);
    EXPECT_EQ(station.run(station.journal.close(true, "")).error().fault, Fault::no_run_armed);
}

TEST(Journal, WritesNotesWithoutACommitOnFlushAndAtTheEnd) {
    const ScratchFolder scratch;
    RandomRun random{4};
    const auto path = scratch.file("r.axiscal");
    {
        Station station;
        ASSERT_TRUE(station.run(station.journal.open(path, random.header())));
        station.journal.note(random.event());
        ASSERT_TRUE(station.run(station.journal.flush()));
        EXPECT_EQ(read_run_file(path)->events.size(), 1U);
        station.journal.note(random.event());
    }
    EXPECT_EQ(read_run_file(path)->events.size(), 2U);
}

std::size_t events_on_disk(const std::string& path) {
    return read_run_file(path)->events.size();
}

TEST(Journal, WritesNotesByItselfAfterTwoSeconds) {
    const ScratchFolder scratch;
    ManualClock clock;
    Station station{JournalThread::own, clock};
    RandomRun random{10};
    const auto path = scratch.file("r.axiscal");
    ASSERT_TRUE(station.run(station.journal.open(path, random.header())));
    station.journal.note(random.event());
    ASSERT_TRUE(clock.rests_until(2s));
    EXPECT_EQ(events_on_disk(path), 0U);
    clock.advance(2s);
    ASSERT_TRUE(clock.rests());
    EXPECT_EQ(events_on_disk(path), 1U);
    station.journal.note(random.event()); // not only once
    ASSERT_TRUE(clock.rests_until(4s));
    clock.advance(2s);
    ASSERT_TRUE(clock.rests());
    EXPECT_EQ(events_on_disk(path), 2U);
}

// 2026-11-21: each job began the two seconds anew.
TEST(Journal, WritesNotesByItselfAlsoWhileItIsAskedAllTheTime) {
    const ScratchFolder scratch;
    ManualClock clock;
    Station station{JournalThread::own, clock};
    RandomRun random{11};
    const auto path = scratch.file("r.axiscal");
    ASSERT_TRUE(station.run(station.journal.open(path, random.header())));
    station.journal.note(random.event());
    for (int asked = 0; asked < 4; ++asked) {
        EXPECT_EQ(events_on_disk(path), 0U);
        clock.advance(500ms);
        EXPECT_FALSE(station.receipt(station.journal.receipt_for(0)));
    }
    EXPECT_EQ(events_on_disk(path), 1U); // before it answered the last time
}

TEST(Journal, KeepsWhatIsNotedBeforeARunForTheRun) {
    const ScratchFolder scratch;
    ManualClock clock;
    Station station{JournalThread::own, clock};
    RandomRun random{12};
    station.journal.note(random.event());
    ASSERT_TRUE(clock.rests_until(2s));
    clock.advance(2s); // the time to save it comes first
    ASSERT_TRUE(clock.rests_until(4s));
    const auto path = scratch.file("r.axiscal");
    ASSERT_TRUE(station.run(station.journal.open(path, random.header())));
    clock.advance(2s);
    ASSERT_TRUE(clock.rests());
    EXPECT_EQ(events_on_disk(path), 1U);
}

TEST(Journal, GivesReceiptsOnResumeOnlyForWhatIsInTheFile) {
    const ScratchFolder scratch;
    RandomRun random{5};
    const auto path = scratch.file("r.axiscal");
    const auto datum = random.datum();
    const auto point = random.point(0);
    {
        Station before;
        ASSERT_TRUE(before.run(before.journal.open(path, random.header())));
        ASSERT_TRUE(before.receipt(before.journal.commit(datum)));
        ASSERT_TRUE(before.receipt(before.journal.commit(point)));
    }
    Station after;
    ASSERT_TRUE(after.run(after.journal.reopen(path)));
    EXPECT_EQ(after.receipt(after.journal.receipt_for(0)).value().first, point.sequence);
    EXPECT_EQ(after.receipt(after.journal.receipt_for(-1)).value().first, datum.sequence);
    EXPECT_EQ(after.receipt(after.journal.receipt_for(1)).error().fault, Fault::not_found);
}

TEST(Journal, RunsUnderAVirtualClockInTheCallersThread) {
    const ScratchFolder scratch;
    testing::VirtualScheduler scheduler;
    Journal journal{scheduler, JournalThread::caller};
    RandomRun random{6};
    std::vector<Result<void>> outcomes;
    const auto keep = [&](const std::exception_ptr&, Result<void> result) {
        outcomes.push_back(std::move(result));
    };
    boost::asio::co_spawn(scheduler.loop(),
                          journal.open(scratch.file("r.axiscal"), random.header()), keep);
    scheduler.run_for(std::chrono::seconds{1});
    boost::asio::co_spawn(scheduler.loop(), journal.close(false, "end"), keep);
    scheduler.run_for(std::chrono::seconds{1});
    ASSERT_EQ(outcomes.size(), 2U);
    EXPECT_TRUE(outcomes[0] && outcomes[1]);
    const auto run = read_run_file(scratch.file("r.axiscal")).value();
    EXPECT_EQ(run.closed.before, monotonic_from_ns(2'000'000'000)); // starts at 1 s
}

/// Up to the size at which SQLite folds its log back by itself: 1000 pages.
TEST(Journal, GivesTheLogItsWholeLengthBeforeTheFirstPoint) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal"), log = path + "-wal";
    constexpr std::uintmax_t whole = 32 + 1000 * (24 + 4096); // file format of SQLite, section 4.1
    Station station;
    RandomRun random{7};
    RunRecord run = random.header();
    ASSERT_TRUE(station.run(station.journal.open(path, run)));
    EXPECT_EQ(std::filesystem::file_size(log), whole);
    EXPECT_TRUE(same_bits(run, read_run_file(path).value())); // zeros are no records
    for (int step = 0; step < 20; ++step) {
        run.points.push_back(random.point(step));
        ASSERT_TRUE(station.receipt(station.journal.commit(run.points.back())));
    }
    EXPECT_EQ(std::filesystem::file_size(log), whole);
    EXPECT_TRUE(same_bits(run, read_run_file(path).value()));
}

TEST(Journal, CarriesARunWhereTheLogFindsNoRoomForItsLength) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    const int status = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{2'000'000, RLIM_INFINITY};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        Station station;
        RandomRun random{7};
        EXPECT_TRUE(station.run(station.journal.open(path, random.header())));
        EXPECT_EQ(std::filesystem::file_size(path + "-wal"), 0U); // what was begun is given back
        EXPECT_TRUE(station.receipt(station.journal.commit(random.point(0))));
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(read_run_file(path)->points.size(), 1U);
}

// The disk is full for this process: its file-size limit makes every growth fail.
TEST(Journal, NeverAcknowledgesAgainAfterTheDiskWasFull) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    const int status = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        Station station;
        RandomRun random{7};
        EXPECT_TRUE(station.run(station.journal.open(path, random.header())));
        EXPECT_TRUE(station.receipt(station.journal.commit(random.point(0))));
        rlimit limit{200'000, RLIM_INFINITY};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        int step = 1;
        Result<Receipt> receipt = Receipt{};
        for (; receipt && step < 1000; ++step) {
            auto point = random.point(step);
            point.samples = std::vector<WindowSample>(500);
            receipt = station.receipt(station.journal.commit(point));
        }
        EXPECT_FALSE(receipt);
        EXPECT_EQ(receipt.error().fault, Fault::not_durable);
        limit.rlim_cur = RLIM_INFINITY; // space again: still no
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const auto later = station.receipt(station.journal.commit(random.point(step)));
        EXPECT_FALSE(later);
        EXPECT_EQ(later.error().fault, Fault::not_durable);
        EXPECT_EQ(later.error().detail, receipt.error().detail); // the first cause
        EXPECT_TRUE(station.journal.failure());
        // All that was acknowledged is there, and nothing in between is missing.
        EXPECT_GE(read_run_file(path)->points.size(), static_cast<std::size_t>(step - 1));
    });
    EXPECT_EQ(status, 0);
}

TEST(Journal, SaysThatAReadOnlyFolderTakesNoRun) {
    const ScratchFolder scratch;
    std::filesystem::permissions(scratch.path(), std::filesystem::perms{0555});
    const int status = in_child([&] {
        EXPECT_TRUE(::geteuid() != 0 || ::setuid(65534) == 0); // root may write anywhere
        Station station;
        const auto path = scratch.file("r.axiscal");
        const auto opened = station.run(station.journal.open(path, RandomRun{8}.header()));
        EXPECT_FALSE(opened);
        EXPECT_EQ(opened.error().fault, Fault::not_durable);
        EXPECT_NE(opened.error().detail.find(path), std::string::npos);
    });
    EXPECT_EQ(status, 0);
}

/// Commits points until killed; writes each acknowledged step as one byte to the pipe.
[[noreturn]] void commit_for_ever(const std::string& path, unsigned seed, int pipe) {
    Station station;
    RandomRun random{seed};
    if (!station.run(station.journal.open(path, random.header()))) ::_exit(1);
    for (int step = 0;; ++step) {
        station.journal.note(random.event());
        const auto receipt = station.receipt(station.journal.commit(random.point(step)));
        if (!receipt || receipt->second != step) ::_exit(1);
        const auto byte = static_cast<unsigned char>(step);
        if (::write(pipe, &byte, 1) != 1) ::_exit(1);
    }
}

TEST(Journal, KeepsEveryAcknowledgedPointThroughKill9) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const ScratchFolder scratch;
        const auto path = scratch.file("r.axiscal");
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t pid = ::fork();
        if (pid == 0) commit_for_ever(path, seed, ends[1]);
        ::close(ends[1]);
        int acknowledged = 0, kill_after = RandomRun{seed}.pick(25) + 1;
        unsigned char step = 0;
        while (acknowledged < kill_after && ::read(ends[0], &step, 1) == 1)
            ++acknowledged;
        ::kill(pid, SIGKILL);
        while (::read(ends[0], &step, 1) == 1)
            ++acknowledged; // said before the kill arrived
        ::waitpid(pid, nullptr, 0);
        ::close(ends[0]);
        ASSERT_GE(acknowledged, kill_after);
        const auto read = read_run_file(path);
        ASSERT_TRUE(read) << describe(read.error());
        ASSERT_GE(read->points.size(), static_cast<std::size_t>(acknowledged));
        EXPECT_LE(read->points.size(), static_cast<std::size_t>(acknowledged) + 1);
        for (int i = 0; i < acknowledged; ++i)
            EXPECT_EQ(read->points[static_cast<std::size_t>(i)].step, i);
        EXPECT_EQ(open_run_files(scratch.path()), std::vector{path});
        EXPECT_TRUE(RunFileWriter::reopen(path));
    }
}

} // namespace
} // namespace axiscal::journal_test

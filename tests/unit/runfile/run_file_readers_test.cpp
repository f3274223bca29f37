// Another program reads the run file that is to be closed: SQLite's own locks,
// sqlite.org/lockingv3.
#include "acquisition/runfile/file_users.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_store.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::run_file_readers_test {
namespace {

using testing::append;
using testing::RandomRun;
using testing::ScratchFolder;

/// A process that has the file open as a sqlite3 shell has it: with the shared lock of its main
/// file, bytes 0x40000002 and 509 more.
class OtherProcess {
public:
    explicit OtherProcess(const std::string& path) {
        std::array<int, 2> ready{};
        if (::pipe2(ready.data(), O_CLOEXEC) != 0) return;
        pid_ = ::fork();
        if (pid_ == 0) hold(path, ready[1]);
        char byte = 0;
        ::close(ready[1]);
        holds_ = ::read(ready[0], &byte, 1) == 1;
        ::close(ready[0]);
    }
    ~OtherProcess() { end(); }
    OtherProcess(const OtherProcess&) = delete;
    OtherProcess& operator=(const OtherProcess&) = delete;
    void end() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }
    [[nodiscard]] pid_t pid() const { return pid_; }
    [[nodiscard]] bool holds() const { return holds_; }

private:
    [[noreturn]] static void hold(const std::string& path, int ready) {
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        struct flock shared {};
        shared.l_type = F_RDLCK, shared.l_whence = SEEK_SET;
        shared.l_start = 0x40000002, shared.l_len = 510;
        if (file < 0 || ::fcntl(file, F_SETLK, &shared) != 0) ::_exit(1);
        if (::write(ready, "r", 1) == 1) ::pause();
        ::_exit(0);
    }
    pid_t pid_ = -1;
    bool holds_ = false;
};

class RunFileThatIsRead : public ::testing::Test {
protected:
    RunFileWriter begin() {
        RunFileWriter writer = RunFileWriter::create(path, random.header()).value();
        EXPECT_TRUE(append(writer, random.point(0)));
        return writer;
    }
    Result<void> close(RunFileWriter& writer) { return writer.close(true, "done", random.tie()); }
    [[nodiscard]] bool alone() const { return !std::filesystem::exists(path + "-wal"); }

    ScratchFolder scratch;
    RandomRun random{7};
    std::string path = scratch.file("run.axiscal");
};

/// It was told as a disk that fails.
TEST_F(RunFileThatIsRead, IsClosedAtOnceAndFoldedWhenTheReaderThatItNamesHasEnded) {
    RunFileWriter writer = begin();
    OtherProcess reader{path};
    ASSERT_TRUE(reader.holds());
    const auto held = close(writer);
    ASSERT_FALSE(held);
    EXPECT_EQ(held.error().fault, Fault::busy);
    EXPECT_NE(held.error().detail.find("process " + std::to_string(reader.pid()) + " ("),
              std::string::npos)
        << held.error().detail;
    EXPECT_TRUE(writer.closed());
    EXPECT_TRUE(read_run_file_contents(path).value().closed) << "before the reader has ended";
    reader.end();
    const auto closed = close(writer);
    ASSERT_TRUE(closed) << describe(closed.error());
    EXPECT_TRUE(alone());
    EXPECT_EQ(summarize_run_file(path).value().closings, 1);
}

/// A shell whose query stands still, in `less` for instance.
TEST_F(RunFileThatIsRead, IsFoldedAfterAQueryThatStoodStill) {
    RunFileWriter writer = begin();
    sqlite3* shell = nullptr;
    sqlite3_stmt* query = nullptr;
    ASSERT_EQ(sqlite3_open_v2(path.c_str(), &shell, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    ASSERT_EQ(sqlite3_prepare_v2(shell, "SELECT * FROM plan_point", -1, &query, nullptr),
              SQLITE_OK);
    ASSERT_EQ(sqlite3_step(query), SQLITE_ROW);
    const auto held = close(writer);
    sqlite3_finalize(query);
    sqlite3_close(shell);
    ASSERT_FALSE(held);
    EXPECT_EQ(held.error().fault, Fault::busy);
    EXPECT_TRUE(close(writer));
    EXPECT_TRUE(alone());
}

TEST_F(RunFileThatIsRead, DoesNotKeepTheNextDaemonFromStarting) {
    {
        RunFileWriter writer = begin();
        const OtherProcess reader{path};
        ASSERT_FALSE(close(writer));
    }
    OtherProcess reader{path};
    ASSERT_TRUE(reader.holds());
    const auto runs = look_through_runs(scratch.path());
    ASSERT_TRUE(runs) << describe(runs.error());
    ASSERT_EQ(runs->looked_into.size(), 1U);
    EXPECT_TRUE(runs->looked_into[0].closed);
    EXPECT_EQ(tidy_run_files(scratch.path()).error().fault, Fault::busy);
    reader.end();
    EXPECT_TRUE(tidy_run_files(scratch.path()));
    EXPECT_TRUE(alone());
}

/// What docs/run-file.md recommends: no lock is taken.
TEST_F(RunFileThatIsRead, IsNotHeldUpByAnImmutableReader) {
    RunFileWriter writer = begin();
    sqlite3* shell = nullptr;
    sqlite3_stmt* query = nullptr;
    const std::string uri = "file:" + path + "?immutable=1";
    ASSERT_EQ(sqlite3_open_v2(uri.c_str(), &shell, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr),
              SQLITE_OK);
    ASSERT_EQ(sqlite3_prepare_v2(shell, "SELECT * FROM run", -1, &query, nullptr), SQLITE_OK);
    ASSERT_EQ(sqlite3_step(query), SQLITE_ROW);
    EXPECT_TRUE(close(writer));
    sqlite3_finalize(query);
    sqlite3_close(shell);
    EXPECT_TRUE(alone());
}

TEST(FileUsers, AreTheOthersOfThatFileAndNoneWhoOnlyWaits) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("a"), list = scratch.file("locks");
    std::ofstream{path} << "a";
    struct stat file {};
    ASSERT_EQ(::stat(path.c_str(), &file), 0);
    std::array<char, 64> place{};
    std::snprintf(place.data(), place.size(), "%02x:%02x:%lu", major(file.st_dev),
                  minor(file.st_dev), file.st_ino);
    const std::string here = place.data();
    const std::string none = "4194305"; // above the kernel's greatest process number
    std::ofstream{list} << "1: POSIX  ADVISORY  READ " << none << " " << here << " 1 2\n"
                        << "1: -> POSIX  ADVISORY  WRITE 4194306 " << here << " 1 2\n"
                        << "2: POSIX  ADVISORY  WRITE " << ::getpid() << " " << here << " 1 2\n"
                        << "3: FLOCK  ADVISORY  WRITE 4194307 00:00:1 0 EOF\n";
    EXPECT_EQ(file_users_text(path, list), "process " + none);
    EXPECT_EQ(file_users_text(path, scratch.file("missing")), "another program");
    EXPECT_EQ(file_users_text(scratch.file("gone"), list), "another program");
}

} // namespace
} // namespace axiscal::run_file_readers_test

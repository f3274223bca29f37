#include "acquisition/runfile/run_file.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"
#include "tests/unit/runfile/written_run.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace axiscal::run_file_test {
namespace {

using testing::append;
using testing::open_run_files;
using testing::RandomRun;
using testing::read_bytes;
using testing::refusal_of;
using testing::run_sql;
using testing::same_bits;
using testing::ScratchFolder;
using testing::write_bytes;
using testing::write_run;

TEST(RunFile, GivesBackEveryBitOfRandomRuns) {
    const ScratchFolder scratch;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        RandomRun random{seed};
        const auto path = scratch.file(std::to_string(seed) + ".axiscal");
        const RunRecord written = write_run(path, random, random.pick(12));
        const auto read = read_run_file(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(written, *read)) << "seed " << seed;
    }
}

/// Bytes of a closed file, and of what lies beside it, in the middle of a write that changes its
/// pages.
void copy_in_mid_write(const std::string& path, const std::string& copy) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &connection), SQLITE_OK);
    const char* begin = "PRAGMA cache_size=1; BEGIN IMMEDIATE; DELETE FROM point;"
                        "INSERT INTO result(digest, document, hash) "
                        "VALUES('d', hex(zeroblob(200000)), x'00')";
    EXPECT_EQ(sqlite3_exec(connection, begin, nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    write_bytes(copy, read_bytes(path));
    write_bytes(copy + "-journal", read_bytes(path + "-journal"));
    sqlite3_close(connection);
}

// 2026-11-22: after a power cut in such a write `axiscal verify` asked for a database it could
// write.
TEST(RunFile, IsReadAsItWasBeforeAWriteThatAPowerCutInterrupted) {
    const ScratchFolder scratch;
    RandomRun random{8};
    const auto path = scratch.file("run.axiscal"), copy = scratch.file("cut.axiscal");
    const RunRecord written = write_run(path, random, 12);
    copy_in_mid_write(path, copy);
    ASSERT_NE(read_bytes(copy), read_bytes(path)) << "nothing had reached the file";
    const auto read = read_run_file(copy);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_TRUE(same_bits(written, *read));
    EXPECT_FALSE(std::filesystem::exists(copy + "-journal"));
}

TEST(RunFile, IsOneSingleFileOnceClosed) {
    const ScratchFolder scratch;
    RandomRun random{7};
    write_run(scratch.file("r.axiscal"), random, 3);
    const std::filesystem::directory_iterator all{scratch.path()};
    EXPECT_EQ(std::distance(begin(all), end(all)), 1);
}

TEST(RunFile, IsNeverMadeOverAnother) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    write_bytes(path, "somebody else's");
    const auto made = RunFileWriter::create(path, RandomRun{1}.header());
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().fault, Fault::refused);
    EXPECT_EQ(read_bytes(path), "somebody else's");
}

TEST(RunFile, SaysWhoItIsInItsFirstBytes) {
    const ScratchFolder scratch;
    RandomRun random{2};
    const auto path = scratch.file("r.axiscal");
    write_run(path, random, 1);
    const auto bytes = read_bytes(path);
    EXPECT_EQ(bytes.substr(0, 15), "SQLite format 3");
    EXPECT_EQ(bytes.substr(68, 4), "AXCL");                       // application_id
    EXPECT_EQ(bytes.substr(60, 4), (std::string{"\0\0\0\1", 4})); // user_version
}

TEST(RunFile, TellsAnotherFormatFromADamagedFile) {
    const ScratchFolder scratch;
    RandomRun random{13};
    const auto path = scratch.file("r.axiscal");
    write_run(path, random, 1);
    for (const std::string version : {"99", "2", "0"}) {
        run_sql(path, "PRAGMA user_version = " + version);
        EXPECT_NE(refusal_of(path).find("written in format " + version + " by another axiscal"),
                  std::string::npos);
    }
    run_sql(path, "PRAGMA application_id = 1");
    EXPECT_NE(refusal_of(path).find("not an axiscal run file"), std::string::npos);
}

TEST(RunFile, IsRefusedWithoutOneOfItsTables) {
    const ScratchFolder scratch;
    RandomRun random{22};
    const auto path = scratch.file("r.axiscal");
    write_run(path, random, 1);
    run_sql(path, "DROP TABLE linear_scale");
    EXPECT_NE(refusal_of(path).find("tables are not those"), std::string::npos);
}

TEST(RunFile, CanBeReadWhileItIsOpen) {
    const ScratchFolder scratch;
    RandomRun random{3};
    const auto path = scratch.file("r.axiscal");
    auto writer = RunFileWriter::create(path, random.header()).value();
    ASSERT_TRUE(append(writer, random.point(0)));
    const auto read = read_run_file_contents(path);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_FALSE(read->closed);
    EXPECT_EQ(read->run.points.size(), 1U);
}

TEST(RunFile, GoesOnAfterReopening) {
    const ScratchFolder scratch;
    RandomRun random{4};
    const auto path = scratch.file("r.axiscal");
    RunRecord written = write_run(path, random, 4, false);
    auto writer = RunFileWriter::reopen(path);
    ASSERT_TRUE(writer) << describe(writer.error());
    EXPECT_EQ(writer->sequence_of_point(3).value(), written.points[3].sequence);
    EXPECT_EQ(writer->sequence_of_point(4).value(), std::nullopt);
    written.points.push_back(random.point(4));
    ASSERT_TRUE(append(*writer, written.points.back()));
    EXPECT_TRUE(same_bits(written, read_run_file(path).value()));
}

TEST(RunFile, TakesNothingAfterClosing) {
    const ScratchFolder scratch;
    RandomRun random{5};
    const auto path = scratch.file("r.axiscal");
    auto writer = RunFileWriter::create(path, random.header()).value();
    ASSERT_TRUE(writer.close(false, "aborted", random.tie()));
    EXPECT_EQ(append(writer, random.point(0)).error().fault, Fault::refused);
    EXPECT_EQ(RunFileWriter::reopen(path).error().fault, Fault::refused);
}

TEST(RunFile, RefusesANumberThatIsNone) {
    const ScratchFolder scratch;
    RandomRun random{6};
    auto writer = RunFileWriter::create(scratch.file("r.axiscal"), random.header()).value();
    auto in_field = random.point(0), in_sample = random.point(0);
    in_field.reading = metre(std::numeric_limits<double>::quiet_NaN());
    in_sample.samples = {{MonotonicTime{}, std::numeric_limits<double>::infinity(), 0}};
    EXPECT_EQ(append(writer, in_field).error().fault, Fault::internal);
    EXPECT_EQ(append(writer, in_sample).error().fault, Fault::internal);
    EXPECT_TRUE(append(writer, random.point(0)));
}

TEST(RunFile, TakesEachStepOnce) {
    const ScratchFolder scratch;
    RandomRun random{8};
    auto writer = RunFileWriter::create(scratch.file("r.axiscal"), random.header()).value();
    ASSERT_TRUE(append(writer, random.point(0)));
    EXPECT_EQ(append(writer, random.point(0)).error().fault, Fault::not_durable);
    EXPECT_EQ(append(writer, random.point(1)).error().fault, Fault::not_durable);
}

TEST(RunFile, BringsBackWhatStandsBesideTheRun) {
    const ScratchFolder scratch;
    for (unsigned seed = 0; seed < 30; ++seed) {
        RandomRun random{seed};
        const auto path = scratch.file(std::to_string(seed) + ".axiscal");
        const RunRecord run = random.header();
        const RunAttachments beside = random.attachments(run.kind);
        ASSERT_TRUE(RunFileWriter::create(path, run, beside));
        const auto read = read_run_file_contents(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(run, read->run));
        EXPECT_TRUE(same_bits(beside, read->attachments));
        EXPECT_EQ(summarize_run_file(path)->kind, run.kind);
    }
}

TEST(RunFile, KeepsResultsOnlyOnceClosed) {
    const ScratchFolder scratch;
    RandomRun random{16};
    const auto open = scratch.file("open.axiscal"), closed = scratch.file("closed.axiscal");
    write_run(open, random, 1, false);
    const RunRecord written = write_run(closed, random, 1);
    EXPECT_EQ(store_result(open, {"d", "{}"}).error().fault, Fault::refused);
    EXPECT_EQ(read_stored_result(closed).error().fault, Fault::not_found);
    ASSERT_TRUE(store_result(closed, {"d1", "{\"a\":1}"}));
    ASSERT_TRUE(store_result(closed, {"d2", "{\"a\":2}"}));
    EXPECT_EQ(read_stored_result(closed)->document, "{\"a\":2}");
    EXPECT_TRUE(same_bits(written, read_run_file(closed).value()));
    run_sql(closed, "UPDATE result SET document = '{\"a\":3}'");
    EXPECT_EQ(read_stored_result(closed).error().fault, Fault::bad_run_file);
}

TEST(RunFile, ListsOpenAndClosedRunsAndLeavesOutTheRest) {
    const ScratchFolder scratch;
    RandomRun random{17};
    write_run(scratch.file("a.axiscal"), random, 2, false);
    write_run(scratch.file("b.axiscal"), random, 3);
    write_bytes(scratch.file("c.axiscal"), "nothing");
    const auto all = list_run_files(scratch.path());
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].points, 3);
    EXPECT_TRUE(all[1].closed);
    EXPECT_EQ(open_run_files(scratch.path()), std::vector{scratch.file("a.axiscal")});
    EXPECT_TRUE(open_run_files(scratch.file("missing")).empty());
}

TEST(RunFile, IsTidiedAfterAPowerCutInItsClosing) {
    const ScratchFolder scratch;
    RandomRun random{18};
    const auto path = scratch.file("r.axiscal"), cut = scratch.file("cut.axiscal");
    std::optional writer{RunFileWriter::create(path, random.header()).value()};
    // As a power cut leaves it: database and WAL copied after the closing row, before the tidying.
    const auto header = read_bytes(path);
    sqlite3* keeper = nullptr; // a reader keeps the WAL from being folded
    ASSERT_EQ(sqlite3_open(path.c_str(), &keeper), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(keeper, "BEGIN; SELECT * FROM run", nullptr, nullptr, nullptr), 0);
    EXPECT_FALSE(writer->close(true, "done", random.tie()));
    write_bytes(cut, header);
    write_bytes(cut + "-wal", read_bytes(path + "-wal"));
    write_bytes(scratch.file("half.axiscal.new"), "half a header");
    sqlite3_close(keeper);
    writer.reset();
    ASSERT_TRUE(tidy_run_files(scratch.path()));
    EXPECT_FALSE(std::filesystem::exists(cut + "-wal"));
    EXPECT_FALSE(std::filesystem::exists(scratch.file("half.axiscal.new")));
    EXPECT_TRUE(read_run_file(cut)->complete);
}

} // namespace
} // namespace axiscal::run_file_test

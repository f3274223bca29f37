#include "acquisition/journal/run_file.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/unit/journal/older_format.hpp"
#include "tests/unit/journal/one_row.hpp"
#include "tests/unit/journal/random_run.hpp"
#include "tests/unit/journal/written_run.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::run_file_formats_test {
namespace {

using testing::append;
using testing::drop_format_4;
using testing::drop_format_5;
using testing::RandomRun;
using testing::read_bytes;
using testing::refusal_of;
using testing::run_sql;
using testing::same_bits;
using testing::ScratchFolder;
using testing::to_format_5;
using testing::write_bytes;
using testing::write_run;

TEST(RunFile, TellsANewerFormatFromADamagedFile) {
    const ScratchFolder scratch;
    RandomRun random{13};
    const auto path = scratch.file("r.axiscal");
    write_run(path, random, 1);
    run_sql(path, "PRAGMA user_version = 99");
    EXPECT_NE(refusal_of(path).find("newer axiscal"), std::string::npos);
    run_sql(path, "PRAGMA user_version = 0");
    EXPECT_NE(refusal_of(path).find("does not exist"), std::string::npos);
    run_sql(path, "PRAGMA application_id = 1");
    EXPECT_NE(refusal_of(path).find("not an axiscal run file"), std::string::npos);
}

/// Made before the uncertainty statement was recorded; kept so that old runs stay readable.
const std::string file_of_format_1 = test::source_dir() + "/tests/reference/fifty_points.axiscal";

TEST(RunFile, OfFormat1IsReadWithoutUncertaintyStatement) {
    EXPECT_EQ(read_bytes(file_of_format_1).substr(60, 4), (std::string{"\0\0\0\1", 4}));
    const auto read = read_run_file(file_of_format_1);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(read->points.size(), 50U);
    EXPECT_TRUE(read->complete);
    EXPECT_FALSE(read->uncertainty);
    EXPECT_TRUE(read_stored_result(file_of_format_1));
    EXPECT_TRUE(summarize_run_file(file_of_format_1));
}

/// An open file as a version before this one left it.
void make_format_1(const std::string& path) {
    run_sql(path,
            drop_format_4 +
                "DROP TABLE uncertainty; DROP TABLE uncertainty_target; DROP TABLE circular; "
                "DROP TABLE circular_bar; DROP TABLE circular_uncertainty; DROP TABLE stream; "
                "DROP TABLE stream_block; DROP TABLE preflight; DROP TABLE retake; "
                "DROP TABLE retake_point; DROP TABLE exclusion; DROP TABLE alignment; "
                "DROP TABLE alignment_place; DROP TABLE drift; DROP TABLE eve_source; "
                "PRAGMA user_version=1");
}

TEST(RunFile, OfFormat1GoesOnAndIsClosedAsFormat1) {
    const ScratchFolder scratch;
    RandomRun random{21};
    const auto path = scratch.file("r.axiscal");
    RunRecord run = random.header();
    run.uncertainty.reset();
    run.calibrations.clear();
    run.rotary.reset();
    ASSERT_TRUE(RunFileWriter::create(path, run));
    make_format_1(path);
    auto writer = RunFileWriter::reopen(path);
    ASSERT_TRUE(writer) << describe(writer.error());
    run.points.push_back(random.point(0));
    ASSERT_TRUE(append(*writer, run.points.back()));
    run.complete = true, run.closing_reason = "done", run.closed = random.tie();
    ASSERT_TRUE(writer->close(true, "done", run.closed));
    EXPECT_EQ(read_bytes(path).substr(60, 4), (std::string{"\0\0\0\1", 4}));
    EXPECT_TRUE(same_bits(run, read_run_file(path).value()));
}

TEST(RunFile, OfFormat3IsReadAndGoesOnAsFormat3) {
    const ScratchFolder scratch;
    RandomRun random{25};
    const auto path = scratch.file("r.axiscal");
    RunRecord run = random.header();
    run.calibrations.clear();
    run.rotary.reset();
    ASSERT_TRUE(RunFileWriter::create(path, run));
    run_sql(path, drop_format_4 + "PRAGMA user_version=3");
    auto writer = RunFileWriter::reopen(path);
    ASSERT_TRUE(writer) << describe(writer.error());
    run.complete = true, run.closing_reason = "done", run.closed = random.tie();
    ASSERT_TRUE(writer->close(true, "done", run.closed));
    EXPECT_EQ(read_bytes(path).substr(60, 4), (std::string{"\0\0\0\3", 4}));
    EXPECT_TRUE(same_bits(run, read_run_file(path).value()));
    EXPECT_TRUE(summarize_run_file(path));
}

TEST(RunFile, OfFormat5KeepsTheSamplesOfItsPointsAsTheyAre) {
    const ScratchFolder scratch;
    RandomRun random{27};
    const auto path = scratch.file("r.axiscal");
    RunRecord run = random.header();
    ASSERT_TRUE(RunFileWriter::create(path, run));
    run_sql(path, to_format_5);
    auto writer = RunFileWriter::reopen(path);
    ASSERT_TRUE(writer) << describe(writer.error());
    run.points.push_back(random.point(0));
    ASSERT_TRUE(append(*writer, run.points.back()));
    run.complete = true, run.closing_reason = "done", run.closed = random.tie();
    ASSERT_TRUE(writer->close(true, "done", run.closed));
    EXPECT_EQ(read_bytes(path).substr(60, 4), (std::string{"\0\0\0\5", 4}));
    EXPECT_TRUE(same_bits(run, read_run_file(path).value()));
    run_sql(path, "PRAGMA user_version=6");
    EXPECT_NE(refusal_of(path).find("does not hold packed samples"), std::string::npos);
}

TEST(RunFile, OfFormat4IsReadAndGoesOnAsFormat4) {
    const ScratchFolder scratch;
    RandomRun random{26};
    const auto path = scratch.file("r.axiscal");
    RunRecord run = random.header();
    ASSERT_TRUE(RunFileWriter::create(path, run));
    run_sql(path, drop_format_5 + "PRAGMA user_version=4");
    auto writer = RunFileWriter::reopen(path);
    ASSERT_TRUE(writer) << describe(writer.error());
    run.complete = true, run.closing_reason = "done", run.closed = random.tie();
    ASSERT_TRUE(writer->close(true, "done", run.closed));
    EXPECT_EQ(read_bytes(path).substr(60, 4), (std::string{"\0\0\0\4", 4}));
    EXPECT_TRUE(same_bits(run, read_run_file(path).value()));
    EXPECT_FALSE(read_run_file(path)->scale);
    EXPECT_TRUE(summarize_run_file(path));
}

TEST(RunFile, IsRefusedUnderTheNumberOfAnotherFormat) {
    const ScratchFolder scratch;
    RandomRun random{22};
    const auto path = scratch.file("r.axiscal"), old = scratch.file("old.axiscal");
    write_run(path, random, 1);
    write_bytes(old, read_bytes(file_of_format_1));
    run_sql(path, "PRAGMA user_version = 1");
    run_sql(old, "PRAGMA user_version = 2");
    EXPECT_NE(refusal_of(path).find("tables are not those"), std::string::npos);
    EXPECT_NE(refusal_of(old).find("tables are not those"), std::string::npos);
}

} // namespace
} // namespace axiscal::run_file_formats_test

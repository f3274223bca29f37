// Which tables a run file may lack: those of a kind of test that came after format 1, all together.
#include "acquisition/runfile/run_file.hpp"

#include "acquisition/runfile/run_file_verify.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/random_run.hpp"
#include "tests/unit/runfile/written_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace axiscal::older_run_file_test {
namespace {

using testing::RandomRun;
using testing::refusal_of;
using testing::run_sql;
using testing::same_bits;
using testing::ScratchFolder;
using testing::write_run;

constexpr const char* other_tables = "the tables are not those of a run file";

/// A closed run of three points, changed from outside.
std::string written(const ScratchFolder& scratch, const std::string& change) {
    const auto path = scratch.file(sha256_hex(change) + ".axiscal");
    RandomRun random{41};
    write_run(path, random, 3);
    run_sql(path, change);
    return path;
}

TEST(OlderRunFile, HasAllTablesOfFormatOne) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"DROP TABLE drift", "DROP TABLE probing; DROP TABLE probing_touch",
          "DROP TABLE circular; DROP TABLE circular_bar; DROP TABLE circular_uncertainty",
          "DROP TABLE rotary; DROP TABLE rotary_deviation"}) {
        const auto path = written(scratch, change);
        EXPECT_EQ(refusal_of(path), path + ": " + other_tables) << change;
    }
}

constexpr const char* before_reversal =
    "DROP TABLE straightness_reversal; DROP TABLE straightness_reversal_row";
constexpr const char* before_squareness =
    "DROP TABLE squareness; DROP TABLE squareness_uncertainty; DROP TABLE squareness_other; "
    "DROP TABLE squareness_line_row";
constexpr const char* before_straightness =
    "DROP TABLE straightness; DROP TABLE straightness_uncertainty";

TEST(OlderRunFile, IsReadWithoutTheTablesOfALaterKind) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{42};
    const RunRecord written_run = write_run(path, random, 3);
    for (const char* before : {before_reversal, before_squareness, before_straightness})
        run_sql(path, before);
    const auto read = read_run_file(path);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_TRUE(same_bits(written_run, *read));
    const auto summary = summarize_run_file(path);
    ASSERT_TRUE(summary) << describe(summary.error());
    EXPECT_EQ(summary->run_id, written_run.run_id);
    const auto chain = verify_chain(path);
    ASSERT_TRUE(chain) << describe(chain.error());
    EXPECT_TRUE(chain->intact());
    for (const char* table : {"straightness", "straightness_reversal", "squareness"}) {
        const std::pair<std::string, std::int64_t> no_rows{table, 0};
        EXPECT_EQ(std::ranges::count(chain->rows, no_rows), 1) << table;
    }
}

TEST(OlderRunFile, HasAllTablesOfALaterKindOrNone) {
    const ScratchFolder scratch;
    const std::string none = before_straightness;
    for (const std::string& change :
         {std::string{"DROP TABLE straightness"},
          std::string{"DROP TABLE straightness_uncertainty"},
          std::string{"ALTER TABLE straightness ADD COLUMN more TEXT"},
          std::string{"ALTER TABLE straightness RENAME COLUMN factor TO factors"},
          std::string{"CREATE INDEX i ON straightness(factor)"},
          none + "; CREATE TABLE straightness(link INTEGER PRIMARY KEY, hash BLOB NOT NULL) STRICT",
          none + "; CREATE VIEW straightness AS SELECT 1",
          none + "; CREATE TABLE \"STRAIGHTNESS\"(link INTEGER PRIMARY KEY)",
          std::string{"DROP TABLE straightness_reversal"},
          std::string{"DROP TABLE straightness_reversal_row"}, std::string{"DROP TABLE squareness"},
          std::string{"DROP TABLE squareness_line_row"},
          std::string{"DROP TABLE squareness_other; DROP TABLE squareness_uncertainty"}}) {
        const auto path = written(scratch, change);
        EXPECT_EQ(refusal_of(path), path + ": " + other_tables) << change;
    }
}

/// A closed run with this set-up and nothing measured.
std::string closed_run(const ScratchFolder& scratch, TestKind kind, const TestSetup& setup) {
    const auto path = scratch.file("closed.axiscal");
    RandomRun random{43};
    RunRecord run = random.header();
    run.kind = kind;
    RunAttachments beside;
    beside.setup = setup;
    auto writer = RunFileWriter::create(path, run, beside).value();
    EXPECT_TRUE(writer.close(true, "done", random.tie()));
    return path;
}

StraightnessSetup reversed_straightness() {
    StraightnessSetup setup;
    setup.mirror = MirrorPosition::reversed;
    setup.reversal_of = "bench-20261121T100000Z-X";
    return setup;
}

// Made when the straightness was known and what its reversal gave was not kept.
TEST(OlderRunFile, SaysTheStraightnessThatItKnewWithoutTheTablesOfItsReversal) {
    const ScratchFolder scratch;
    const TestSetup setup = reversed_straightness();
    const auto path = closed_run(scratch, TestKind::straightness, setup);
    run_sql(path, before_reversal);
    run_sql(path, before_squareness);
    const auto read = read_run_file_contents(path);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_TRUE(same_bits(setup, read->attachments.setup));
    const auto chain = verify_chain(path);
    ASSERT_TRUE(chain) << describe(chain.error());
    EXPECT_TRUE(chain->intact());
}

TEST(OlderRunFile, IsNoneWhereTheDroppedReversalHeldRows) {
    const ScratchFolder scratch;
    StraightnessSetup setup = reversed_straightness();
    setup.reversal = RecordedLine{setup.reversal_of, "X", "Y", 5, um(0.2), {}};
    setup.reversal->rows = {{mm(0), um(1), um(2)}, {mm(100), um(3), um(4)}};
    const auto path = closed_run(scratch, TestKind::straightness, setup);
    ASSERT_TRUE(read_run_file(path));
    run_sql(path, before_reversal);
    EXPECT_NE(refusal_of(path).find("is missing: the file was changed"), std::string::npos)
        << refusal_of(path);
    const auto chain = verify_chain(path);
    ASSERT_TRUE(chain) << describe(chain.error());
    EXPECT_EQ(chain->findings.size(), 3U); // the line and its two rows
}

TEST(OlderRunFile, IsNoneWhereADroppedTableHeldRows) {
    const ScratchFolder scratch;
    const auto path = closed_run(scratch, TestKind::straightness, StraightnessSetup{});
    ASSERT_TRUE(read_run_file(path));
    run_sql(path, before_straightness);
    EXPECT_NE(refusal_of(path).find("is missing: the file was changed"), std::string::npos)
        << refusal_of(path);
    const auto chain = verify_chain(path);
    ASSERT_TRUE(chain) << describe(chain.error());
    ASSERT_EQ(chain->findings.size(), 2U); // the set-up and its statement
    for (const RowFinding& found : chain->findings)
        EXPECT_EQ(found.damage, RowDamage::missing) << found.sentence;
}

} // namespace
} // namespace axiscal::older_run_file_test

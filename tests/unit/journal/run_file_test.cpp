#include "acquisition/journal/run_file.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/unit/journal/older_format.hpp"
#include "tests/unit/journal/random_run.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

namespace axiscal {
namespace {

using testing::drop_format_4;
using testing::RandomRun;
using testing::read_bytes;
using testing::same_bits;
using testing::ScratchFolder;
using testing::write_bytes;

/// Writes a random run and returns what was written.
RunRecord write_run(const std::string& path, RandomRun& random, int points, bool close = true) {
    RunRecord run = random.header();
    auto writer = RunFileWriter::create(path, run).value();
    for (int step = 0; step < points; ++step) {
        RunBatch batch;
        batch.environment = random.environment();
        if (random.pick(2) == 0) batch.events.push_back(random.event());
        if (random.pick(9) == 0) batch.datum = random.datum();
        batch.point = random.point(step);
        EXPECT_TRUE(writer.write(batch));
        run.environment.insert(run.environment.end(), batch.environment.begin(),
                               batch.environment.end());
        run.events.insert(run.events.end(), batch.events.begin(), batch.events.end());
        if (batch.datum) run.datums.push_back(*batch.datum);
        run.points.push_back(*batch.point);
    }
    if (!close) return run;
    run.complete = random.pick(2) == 0;
    run.closing_reason = "done";
    run.closed = random.tie();
    EXPECT_TRUE(writer.close(run.complete, run.closing_reason, run.closed));
    return run;
}

void run_sql(const std::string& path, const std::string& sql) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    sqlite3_close(connection);
}

std::string refusal_of(const std::string& path) {
    const auto read = read_run_file(path);
    if (read) return "accepted";
    EXPECT_EQ(read.error().fault, Fault::bad_run_file);
    return read.error().detail;
}

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
    EXPECT_EQ(bytes.substr(60, 4), (std::string{"\0\0\0\4", 4})); // user_version
}

TEST(RunFile, CanBeReadWhileItIsOpen) {
    const ScratchFolder scratch;
    RandomRun random{3};
    const auto path = scratch.file("r.axiscal");
    auto writer = RunFileWriter::create(path, random.header()).value();
    ASSERT_TRUE(writer.append_point(random.point(0)));
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
    ASSERT_TRUE(writer->append_point(written.points.back()));
    EXPECT_TRUE(same_bits(written, read_run_file(path).value()));
}

TEST(RunFile, TakesNothingAfterClosing) {
    const ScratchFolder scratch;
    RandomRun random{5};
    const auto path = scratch.file("r.axiscal");
    auto writer = RunFileWriter::create(path, random.header()).value();
    ASSERT_TRUE(writer.close(false, "aborted", random.tie()));
    EXPECT_EQ(writer.append_point(random.point(0)).error().fault, Fault::refused);
    EXPECT_EQ(RunFileWriter::reopen(path).error().fault, Fault::refused);
}

TEST(RunFile, RefusesANumberThatIsNone) {
    const ScratchFolder scratch;
    RandomRun random{6};
    auto writer = RunFileWriter::create(scratch.file("r.axiscal"), random.header()).value();
    auto in_field = random.point(0), in_sample = random.point(0);
    in_field.reading = metre(std::numeric_limits<double>::quiet_NaN());
    in_sample.samples.push_back({MonotonicTime{}, std::numeric_limits<double>::infinity(), 0});
    EXPECT_EQ(writer.append_point(in_field).error().fault, Fault::internal);
    EXPECT_EQ(writer.append_point(in_sample).error().fault, Fault::internal);
    EXPECT_TRUE(writer.append_point(random.point(0)));
}

TEST(RunFile, TakesEachStepOnce) {
    const ScratchFolder scratch;
    RandomRun random{8};
    auto writer = RunFileWriter::create(scratch.file("r.axiscal"), random.header()).value();
    ASSERT_TRUE(writer.append_point(random.point(0)));
    EXPECT_EQ(writer.append_point(random.point(0)).error().fault, Fault::not_durable);
    EXPECT_EQ(writer.append_point(random.point(1)).error().fault, Fault::not_durable);
}

TEST(RunFile, NamesTheRowThatWasChanged) {
    const ScratchFolder scratch;
    RandomRun random{9};
    const auto path = scratch.file("r.axiscal");
    write_run(path, random, 6);
    run_sql(path, "UPDATE point SET reading_m = 0.123 WHERE step = 3");
    EXPECT_NE(refusal_of(path).find("(table point) was changed"), std::string::npos)
        << refusal_of(path);
}

TEST(RunFile, NamesTheRowThatIsMissing) {
    const ScratchFolder scratch;
    RandomRun random{10};
    const auto path = scratch.file("r.axiscal");
    write_run(path, random, 6);
    run_sql(path, "DELETE FROM point WHERE step = 2");
    EXPECT_NE(refusal_of(path).find("is missing"), std::string::npos) << refusal_of(path);
}

TEST(RunFile, NoticesChangedHeaderStatementsAndClosing) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"UPDATE statement SET value = 'x' WHERE name = 'customer'",
          "UPDATE closing SET complete = 1 - complete", "UPDATE laser SET sign = -sign",
          "UPDATE run SET opened_utc_ns = 1"}) {
        RandomRun random{11};
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        write_run(path, random, 2);
        run_sql(path, change);
        EXPECT_NE(refusal_of(path).find("was changed"), std::string::npos) << change;
    }
}

TEST(RunFile, RefusesForeignTablesViewsAndTriggers) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"CREATE TABLE more(a)", "CREATE INDEX i ON point(n)", "CREATE VIEW v AS SELECT 1",
          "CREATE TRIGGER t AFTER INSERT ON point BEGIN SELECT 1; END", "DROP TABLE air",
          "ALTER TABLE air ADD COLUMN c TEXT"}) {
        RandomRun random{12};
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        write_run(path, random, 1);
        run_sql(path, change);
        EXPECT_NE(refusal_of(path).find("tables are not those"), std::string::npos) << change;
    }
}

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
    ASSERT_TRUE(writer->append_point(run.points.back()));
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

TEST(RunFile, ChainsTheCertificatesOfChannels) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"UPDATE channel_calibration SET due_on = '2030-01-01'",
          "UPDATE channel_calibration SET expanded_uncertainty = 0.01",
          "UPDATE channel_calibration SET expanded_uncertainty = NULL",
          "UPDATE channel_correction SET correction = 0.0 WHERE reading = 20.0",
          "DELETE FROM channel_correction WHERE reading = 15.0",
          "DELETE FROM channel_calibration"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        RunRecord run = RandomRun{26}.header();
        ChannelCalibration own;
        own.channel = 3, own.due_on = "2026-12-01", own.expanded_uncertainty = 0.05;
        own.corrections = {{15, 0.02}, {20, -0.01}};
        run.calibrations = {own};
        ASSERT_TRUE(RunFileWriter::create(path, run));
        ASSERT_TRUE(read_run_file(path));
        run_sql(path, change);
        EXPECT_NE(refusal_of(path), "accepted") << change;
    }
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

TEST(RunFile, BringsBackWhatStandsBesideTheRun) {
    const ScratchFolder scratch;
    for (unsigned seed = 0; seed < 30; ++seed) {
        RandomRun random{seed};
        const auto path = scratch.file(std::to_string(seed) + ".axiscal");
        const RunRecord run = random.header();
        const RunAttachments beside = random.attachments();
        ASSERT_TRUE(RunFileWriter::create(path, run, beside));
        const auto read = read_run_file_contents(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(run, read->run));
        EXPECT_TRUE(same_bits(beside, read->attachments));
        EXPECT_EQ(summarize_run_file(path)->drift, beside.drift.has_value());
        EXPECT_EQ(summarize_run_file(path)->probing, beside.probing.has_value());
    }
}

RunAttachments some_attachments() {
    RunAttachments beside;
    beside.alignment.emplace().far = FarRest{metre(1), um(8), um(2), um(1), 9, true};
    beside.alignment->places = {{mm(0), mm(40), 100, 71, 80, 90}};
    beside.drift = DriftSetup{std::chrono::minutes{30}, std::chrono::seconds{1}, mm(900)};
    beside.probing.emplace().touches = {{{-1, 0, 0}, false, mm(2), {um(3), mm(-10), mm(-10)}}};
    beside.eve_source = "bench-20261121T100000Z-X";
    return beside;
}

TEST(RunFile, ChainsWhatStandsBesideTheRun) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"UPDATE alignment SET far_last_m = 1e-9", "UPDATE alignment SET lost = lost + 1",
          "DELETE FROM alignment", "DELETE FROM alignment_place",
          "UPDATE alignment_place SET weakest_percent = 99.0", "UPDATE drift SET place_m = 0.0",
          "DELETE FROM drift", "UPDATE probing_touch SET x_m = 1.0", "DELETE FROM probing",
          "UPDATE eve_source SET run_id = 'another'"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        ASSERT_TRUE(RunFileWriter::create(path, RandomRun{23}.header(), some_attachments()));
        EXPECT_TRUE(read_run_file(path)) << change;
        run_sql(path, change);
        EXPECT_FALSE(read_run_file(path)) << change;
    }
}

TEST(RunFile, ChainsHowAnAngleWasMeasured) {
    const ScratchFolder scratch;
    RunRecord run = RandomRun{25}.header();
    RotarySetup& rotary = run.rotary.emplace();
    rotary.deviations_arcsec = {0, 0.3, -0.2};
    rotary.run_out = "6 um";
    for (const std::string change :
         {"UPDATE rotary SET step_deg = 2.0", "UPDATE rotary SET run_out = ''",
          "UPDATE rotary_deviation SET deviation_arcsec = -0.3 WHERE deviation_arcsec = 0.3",
          "DELETE FROM rotary_deviation WHERE deviation_arcsec = -0.2", "DELETE FROM rotary"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        ASSERT_TRUE(RunFileWriter::create(path, run));
        const auto read = read_run_file(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(run.rotary, read->rotary));
        run_sql(path, change);
        EXPECT_FALSE(read_run_file(path)) << change;
    }
}

TEST(RunFile, RefusesAFarRestInParts) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    ASSERT_TRUE(RunFileWriter::create(path, RandomRun{24}.header(), some_attachments()));
    run_sql(path, "UPDATE alignment SET far_scatter_m = NULL");
    EXPECT_FALSE(read_run_file(path));
}

TEST(RunFile, ChainsTheUncertaintyStatement) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"UPDATE uncertainty SET eve_m = 1e-9", "UPDATE uncertainty SET eve_model = 'difference'",
          "UPDATE uncertainty SET device_k = 3.0", "DELETE FROM uncertainty_target",
          "UPDATE uncertainty_target SET limit_m = 1.0", "DELETE FROM uncertainty"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        RunRecord run = RandomRun{23}.header();
        run.uncertainty.emplace().eve = um(1.7);
        run.uncertainty->targets = {{"A", um(5)}};
        ASSERT_TRUE(RunFileWriter::create(path, run));
        ASSERT_TRUE(read_run_file(path));
        run_sql(path, change);
        EXPECT_NE(refusal_of(path), "accepted") << change;
    }
}

TEST(RunFile, RefusesWhatIsNoDatabaseAtAll) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    for (const std::string& bytes :
         {std::string{}, std::string{"{\"analysis\":\"positioning\"}"}, std::string(5000, '\0'),
          std::string{"SQLite format 3\0", 16}, "SQLite format 3" + std::string(9000, '\xff')}) {
        write_bytes(path, bytes);
        EXPECT_NE(refusal_of(path), "accepted");
    }
    EXPECT_EQ(read_run_file(scratch.file("none")).error().fault, Fault::not_found);
    EXPECT_EQ(read_run_file(scratch.path()).error().fault, Fault::not_found);
}

TEST(RunFile, RefusesEveryTruncation) {
    const ScratchFolder scratch;
    RandomRun random{14};
    const auto path = scratch.file("r.axiscal"), cut = scratch.file("cut.axiscal");
    write_run(path, random, 5);
    const auto bytes = read_bytes(path);
    for (std::size_t size = 0; size < bytes.size();
         size += 1777) { // the last step cuts less than a page
        write_bytes(cut, bytes.substr(0, size));
        EXPECT_NE(refusal_of(cut), "accepted") << size << " of " << bytes.size();
    }
}

TEST(RunFile, NeverGivesAnotherRunWhateverByteIsChanged) {
    const ScratchFolder scratch;
    RandomRun random{15};
    const auto path = scratch.file("r.axiscal"), hurt = scratch.file("hurt.axiscal");
    const RunRecord written = write_run(path, random, 4);
    const auto bytes = read_bytes(path);
    int refused = 0;
    for (int trial = 0; trial < 400; ++trial) {
        auto changed = bytes;
        const auto place = static_cast<std::size_t>(random.pick(static_cast<int>(bytes.size())));
        changed[place] = static_cast<char>(changed[place] ^ (1 << random.pick(8)));
        write_bytes(hurt, changed);
        const auto read = read_run_file(hurt);
        refused += read ? 0 : 1;
        EXPECT_TRUE(!read || same_bits(written, *read)) << "byte " << place;
    }
    EXPECT_GT(refused, 20);
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
} // namespace axiscal

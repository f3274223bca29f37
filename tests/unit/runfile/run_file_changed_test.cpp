#include "acquisition/runfile/run_file.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/random_run.hpp"
#include "tests/unit/runfile/written_run.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::run_file_changed_test {
namespace {

using testing::RandomRun;
using testing::read_bytes;
using testing::refusal_of;
using testing::run_sql;
using testing::same_bits;
using testing::ScratchFolder;
using testing::write_bytes;
using testing::write_run;

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

RunAttachments some_attachments(TestSetup setup) {
    RunAttachments beside;
    beside.alignment.emplace().far = FarRest{metre(1), um(8), um(2), um(1), 9, true};
    beside.alignment->places = {{mm(0), mm(40), 100, 71, 80, 90}};
    beside.setup = std::move(setup);
    beside.eve_source = "bench-20261121T100000Z-X";
    return beside;
}

DriftSetup some_drift() {
    return {std::chrono::minutes{30}, std::chrono::seconds{1}, mm(900)};
}

ProbingRecord some_probing() {
    ProbingRecord probing;
    probing.touches = {{{-1, 0, 0}, false, mm(2), {um(3), mm(-10), mm(-10)}}};
    return probing;
}

RunRecord header_of(TestKind kind) {
    RunRecord run = RandomRun{23}.header();
    run.kind = kind;
    return run;
}

void expect_chained(TestKind kind,
                    const TestSetup& setup,
                    std::initializer_list<const char*> changes) {
    const ScratchFolder scratch;
    for (const std::string change : changes) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        ASSERT_TRUE(RunFileWriter::create(path, header_of(kind), some_attachments(setup)));
        EXPECT_TRUE(read_run_file(path)) << change;
        run_sql(path, change);
        EXPECT_FALSE(read_run_file(path)) << change;
    }
}

TEST(RunFile, ChainsWhatStandsBesideTheRun) {
    expect_chained(TestKind::positioning, {},
                   {"UPDATE alignment SET far_last_m = 1e-9",
                    "UPDATE alignment SET lost = lost + 1", "DELETE FROM alignment",
                    "DELETE FROM alignment_place",
                    "UPDATE alignment_place SET weakest_percent = 99.0",
                    "UPDATE eve_source SET run_id = 'another'"});
}

TEST(RunFile, ChainsTheSetUpOfADriftTest) {
    expect_chained(TestKind::drift, some_drift(),
                   {"UPDATE drift SET place_m = 0.0", "DELETE FROM drift"});
}

TEST(RunFile, ChainsTheTouchesOfAProbingTest) {
    expect_chained(TestKind::probing, some_probing(),
                   {"UPDATE probing_touch SET x_m = 1.0", "DELETE FROM probing"});
}

StraightnessSetup some_straightness() {
    StraightnessSetup setup;
    setup.across = "Y";
    setup.factor = 36.012;
    setup.uncertainty.eve = um(0.4);
    return setup;
}

TEST(RunFile, ChainsTheSetUpOfAStraightnessTest) {
    expect_chained(TestKind::straightness, some_straightness(),
                   {"UPDATE straightness SET factor = 36.0", "UPDATE straightness SET sign = -1",
                    "UPDATE straightness SET mirror = 'reversed'",
                    "UPDATE straightness SET mirror = 'turned'",
                    "UPDATE straightness_uncertainty SET eve_m = NULL",
                    "DELETE FROM straightness_uncertainty", "DELETE FROM straightness"});
}

RecordedLine some_line(const char* run_id) {
    RecordedLine line{run_id, "X", "Y", 5, um(0.2), {}};
    line.rows = {{mm(0), um(1), um(2)}, {mm(100), um(3), um(4)}, {mm(200), um(2), um(1)}};
    return line;
}

TEST(RunFile, ChainsWhatTheReversedMirrorGave) {
    StraightnessSetup setup = some_straightness();
    setup.reversal_of = "bench-20261121T100000Z-X";
    setup.reversal = some_line("bench-20261121T100000Z-X");
    expect_chained(TestKind::straightness, setup,
                   {"UPDATE straightness_reversal SET scatter_m = 0.0",
                    "UPDATE straightness_reversal SET readings = 6",
                    "UPDATE straightness_reversal_row SET backward_m = NULL",
                    "UPDATE straightness_reversal_row SET forward_m = 0.0 WHERE target_m = 0.1",
                    "DELETE FROM straightness_reversal_row WHERE target_m = 0.1",
                    "DELETE FROM straightness_reversal"});
}

SquarenessSetup some_squareness() {
    SquarenessSetup setup;
    setup.optics = some_straightness();
    setup.first = some_line("bench-20261121T100000Z-X");
    setup.square = SquarePosition::turned;
    setup.stated.error = arcsec(0.3);
    setup.other =
        OtherSquare{some_line("bench-20261120T100000Z-X"), some_line("bench-20261120T110000Z-Y")};
    return setup;
}

TEST(RunFile, ChainsTheSetUpOfASquarenessTest) {
    expect_chained(
        TestKind::squareness, some_squareness(),
        {"UPDATE squareness SET square = 'normal'", "UPDATE squareness SET square = 'upside down'",
         "UPDATE squareness SET factor = 36.0", "UPDATE squareness SET first_run_id = 'another'",
         "UPDATE squareness SET first_readings = 6",
         "UPDATE squareness_uncertainty SET eve_m = NULL",
         "UPDATE squareness_uncertainty SET error_rad = 0.0", "DELETE FROM squareness_uncertainty",
         "DELETE FROM squareness"});
}

TEST(RunFile, ChainsTheLinesThatASquarenessIsEvaluatedWith) {
    expect_chained(TestKind::squareness, some_squareness(),
                   {"UPDATE squareness_other SET second_run_id = 'another'",
                    "UPDATE squareness_other SET first_scatter_m = 0.0",
                    "UPDATE squareness_line_row SET line = 'first' WHERE line = 'other_first'",
                    "UPDATE squareness_line_row SET forward_m = 0.0 WHERE target_m = 0.1",
                    "UPDATE squareness_line_row SET backward_m = NULL",
                    "DELETE FROM squareness_line_row WHERE line = 'other_second'",
                    "DELETE FROM squareness_other"});
}

TEST(RunFile, RefusesTheSetUpOfAnotherKindOfTest) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    const auto made =
        RunFileWriter::create(path, header_of(TestKind::circular), some_attachments(some_drift()));
    ASSERT_FALSE(made);
    EXPECT_NE(describe(made.error()).find("a circular test with the set-up of a drift test"),
              std::string::npos)
        << describe(made.error());
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

TEST(RunFile, ChainsTheScaleThatMeasuredTheAxis) {
    const ScratchFolder scratch;
    RunRecord run = RandomRun{26}.header();
    run.scale = ScaleSetup{um(0.1), um_per_m_kelvin(8.5), um_per_m_kelvin(0.5), {}, {7, 5}};
    for (const std::string change :
         {"UPDATE linear_scale SET resolution_m = 1e-6",
          "UPDATE linear_scale SET coefficient_per_K = 1e-5",
          "UPDATE linear_scale SET temperature_width_K = 0.1", "DELETE FROM linear_scale",
          "UPDATE linear_scale_sensor SET channel = 4 WHERE channel = 7",
          "DELETE FROM linear_scale_sensor WHERE channel = 5"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        ASSERT_TRUE(RunFileWriter::create(path, run));
        const auto read = read_run_file(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(run.scale, read->scale));
        run_sql(path, change);
        EXPECT_FALSE(read_run_file(path)) << change;
    }
}

TEST(RunFile, ChainsWhereImportedReadingsComeFrom) {
    const ScratchFolder scratch;
    RunRecord run = RandomRun{28}.header();
    run.imported = ImportedReadings{"x.rtl", "Laser10 text", "ab12", "2026-11-21", "sorted"};
    for (const std::string change :
         {"UPDATE imported SET file = 'y.rtl'", "UPDATE imported SET form = 'table'",
          "UPDATE imported SET sha256 = 'ab13'", "UPDATE imported SET measured = ''",
          "UPDATE imported SET remark = ''", "DELETE FROM imported"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        ASSERT_TRUE(RunFileWriter::create(path, run));
        const auto read = read_run_file(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(run.imported, read->imported));
        run_sql(path, change);
        EXPECT_FALSE(read_run_file(path)) << change;
    }
}

TEST(RunFile, RefusesAFarRestInParts) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    ASSERT_TRUE(RunFileWriter::create(path, RandomRun{24}.header(), some_attachments({})));
    run_sql(path, "UPDATE alignment SET far_scatter_m = NULL");
    EXPECT_FALSE(read_run_file(path));
}

TEST(RunFile, ChainsTheLimitsTheRuleAndTheStandards) {
    const ScratchFolder scratch;
    RunRecord run = RandomRun{27}.header();
    run.tolerances = ToleranceRecord{
        "agreed", "order 17", "um", DecisionRule::guard_U, false, {{"A", 500, 20}, {"B", {}, 6}}};
    run.standards = {"ISO 230-2:2006", "VDI/DGQ 3441"};
    for (const std::string change :
         {"UPDATE tolerance_set SET rule = 'simple'", "UPDATE tolerance_set SET rule = 'mine'",
          "UPDATE tolerance_limit SET largest = 30.0 WHERE parameter = 'A'",
          "UPDATE tolerance_limit SET travel_up_to = NULL", "DELETE FROM tolerance_limit",
          "DELETE FROM tolerance_set", "UPDATE standard SET name = 'mine' WHERE name LIKE 'V%'",
          "DELETE FROM standard"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        ASSERT_TRUE(RunFileWriter::create(path, run));
        const auto read = read_run_file(path);
        ASSERT_TRUE(read) << describe(read.error());
        EXPECT_TRUE(same_bits(run.tolerances, read->tolerances));
        EXPECT_EQ(run.standards, read->standards);
        run_sql(path, change);
        EXPECT_FALSE(read_run_file(path)) << change;
    }
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

} // namespace
} // namespace axiscal::run_file_changed_test

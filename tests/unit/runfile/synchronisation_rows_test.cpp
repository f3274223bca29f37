// What the uncertain time of the samples adds to each capture, in the row of its point or datum.
#include "random_run.hpp"

#include "acquisition/runfile/record_rows.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_verify.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

namespace axiscal::synchronisation_rows_test {
namespace {

using testing::RandomRun;
using testing::ScratchFolder;

// 0.25 um/s seen by samples that are known within 48 us: 0.25 * 48e-6 um.
constexpr Synchronisation known{std::chrono::microseconds{48}, 12e-6};

void run_sql(const std::string& path, const std::string& sql) {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(connection);
    sqlite3_close(connection);
}

class SynchronisationRows : public ::testing::Test {
protected:
    /// A datum and three points; the second one's time is not known.
    void write_run() {
        auto writer = RunFileWriter::create(path, random.header()).value();
        RunBatch tied;
        tied.datum = random.datum();
        tied.datum->id = "L-1/1/1";
        tied.synchronisation = known;
        ASSERT_TRUE(writer.write(tied));
        for (int step = 0; step < 3; ++step) {
            RunBatch batch;
            batch.point = random.point(step);
            batch.point->datum_id = "L-1/1/1";
            if (step != 1) batch.synchronisation = known;
            ASSERT_TRUE(writer.write(batch));
        }
        ASSERT_TRUE(writer.close(false, "done", random.tie()));
    }
    [[nodiscard]] std::vector<RowFinding> findings() const {
        const auto report = verify_chain(path);
        EXPECT_TRUE(report) << describe(report.error());
        return report ? report->findings : std::vector<RowFinding>{};
    }

    ScratchFolder scratch;
    RandomRun random{51};
    const std::string path = scratch.file("r.axiscal");
};

TEST_F(SynchronisationRows, ComeBackWithTheirPointsAndWhatIsNotStatedStaysSo) {
    write_run();
    const auto read = read_run_file_contents(path);
    ASSERT_TRUE(read) << describe(read.error());
    const auto& records = read->attachments.synchronisation;
    ASSERT_EQ(records.size(), 4U);
    EXPECT_EQ(records[0].step, -1);
    EXPECT_EQ(records[0].datum_id, "L-1/1/1");
    for (const std::size_t stated : {0U, 1U, 3U}) {
        ASSERT_TRUE(records[stated].stated);
        EXPECT_EQ(records[stated].stated->time_uncertainty, known.time_uncertainty);
        EXPECT_EQ(records[stated].stated->error_um, known.error_um);
    }
    EXPECT_EQ(records[2].step, 1);
    EXPECT_FALSE(records[2].stated) << "never 0";
    EXPECT_TRUE(findings().empty());
}

TEST_F(SynchronisationRows, AChangedOneIsNamed) {
    write_run();
    run_sql(path, "UPDATE point SET synchronisation_um = 0.0 WHERE step = 2");
    const auto found = findings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].damage, RowDamage::changed);
    EXPECT_EQ(found[0].table, "point");
    EXPECT_EQ(found[0].row, "step=2");
    EXPECT_FALSE(read_run_file(path));
}

TEST_F(SynchronisationRows, AnUncertaintyOfNothingIsNotWritten) {
    RunBatch of_point, of_datum;
    of_point.point = random.point(0);
    of_datum.datum = random.datum();
    for (RunBatch* batch : {&of_point, &of_datum}) {
        std::filesystem::remove(path);
        auto writer = RunFileWriter::create(path, random.header()).value();
        batch->synchronisation = Synchronisation{Duration{}, 0};
        const auto written = writer.write(*batch);
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().fault, Fault::internal);
    }
}

TEST_F(SynchronisationRows, HalfOfAStatementIsRefused) {
    for (const std::size_t from_the_end : {1U, 2U}) {
        ChainedRow half = row_of(random.datum(), known);
        half.row[half.row.size() - from_the_end] = Value{};
        RecordedRun run;
        const auto placed = place_row(run, *half.table, half.row);
        ASSERT_FALSE(placed);
        EXPECT_EQ(placed.error().fault, Fault::bad_run_file);
    }
}

} // namespace
} // namespace axiscal::synchronisation_rows_test

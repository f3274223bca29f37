// Checks, retakes, exclusions and answers in the run file, also after its closing row.
#include "random_run.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_verify.hpp"
#include "acquisition/runfile/statement.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/one_row.hpp"

#include <gtest/gtest.h>

namespace axiscal::revision_rows_test {
namespace {

using testing::append;
using testing::open_run_files;
using testing::RandomRun;
using testing::ScratchFolder;

RetakeRecord order_for(int step, int planned_step) {
    return {1, monotonic_from_ns(5), 7, "coolant on the mirror", {{step, planned_step}}};
}

PointRecord again(RandomRun& random, const PointRecord& first, int step) {
    PointRecord point = random.point(step);
    point.planned = first.planned;
    return point;
}

/// Four points, closed complete.
std::vector<PointRecord> closed_run(const std::string& path, RandomRun& random) {
    auto writer = RunFileWriter::create(path, random.header()).value();
    std::vector<PointRecord> points;
    for (int step = 0; step < 4; ++step) {
        points.push_back(random.point(step));
        EXPECT_TRUE(append(writer, points.back()));
    }
    EXPECT_TRUE(writer.close(true, "done", random.tie()));
    return points;
}

RunBatch first_rows(RetakeRecord order) {
    RunBatch batch;
    batch.retakes.push_back(std::move(order));
    return batch;
}

TEST(RevisionRows, AReplacedReadingStaysInTheFileBesideTheNewOne) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{31};
    const auto points = closed_run(path, random);
    auto writer = RunFileWriter::reopen_closed(path, first_rows(order_for(4, 2)));
    ASSERT_TRUE(writer) << describe(writer.error());
    EXPECT_FALSE(summarize_run_file(path)->closed);
    EXPECT_EQ(open_run_files(scratch.path()).size(), 1U);
    const auto fresh = again(random, points[2], 4);
    ASSERT_TRUE(append(*writer, fresh));
    ASSERT_TRUE(writer->close(true, "again", random.tie()));
    const auto read = read_run_file_contents(path);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_TRUE(read->closed);
    EXPECT_EQ(read->run.closing_reason, "again");
    EXPECT_EQ(read->revisions.closings, 2);
    ASSERT_EQ(read->run.points.size(), 4U);
    EXPECT_EQ(read->run.points[2].reading, fresh.reading);
    ASSERT_EQ(read->revisions.superseded.size(), 1U);
    EXPECT_EQ(read->revisions.superseded[0].reading, points[2].reading);
    EXPECT_EQ(read->revisions.retakes.at(0).reason, "coolant on the mirror");
    const auto chain = verify_chain(path);
    ASSERT_TRUE(chain);
    EXPECT_TRUE(chain->intact());
    EXPECT_TRUE(chain->complete);
    const auto summary = summarize_run_file(path);
    EXPECT_TRUE(summary->closed && summary->complete);
    EXPECT_EQ(summary->points, 4);
}

TEST(RevisionRows, ChecksAndExclusionsComeBackAsTheyWere) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{32};
    auto writer = RunFileWriter::create(path, random.header()).value();
    RunBatch batch;
    batch.preflight = {{"soak", false, false, "Wait.", "the customer waits"},
                       {"drift", true, true, "Calm.", ""}};
    batch.exclusions = {{3, monotonic_from_ns(9), 11, "somebody leaned on the table"}};
    ASSERT_TRUE(writer.write(batch));
    const auto read = read_run_file_contents(path);
    ASSERT_TRUE(read) << describe(read.error());
    ASSERT_EQ(read->revisions.preflight.size(), 2U);
    EXPECT_EQ(read->revisions.preflight[0].override_reason, "the customer waits");
    EXPECT_FALSE(read->revisions.preflight[0].warning);
    EXPECT_TRUE(read->revisions.preflight[1].passed && read->revisions.preflight[1].warning);
    ASSERT_EQ(read->revisions.exclusions.size(), 1U);
    EXPECT_EQ(read->revisions.exclusions[0].step, 3);
    EXPECT_EQ(read->revisions.exclusions[0].utc_ns, 11);
}

TEST(RevisionRows, AnAnswerReopensAClosedRunAndComesBackAsItWas) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{36};
    closed_run(path, random);
    RunBatch batch;
    batch.answers = {{"moved_optic", monotonic_from_ns(9), 11, "the bracket was tight"}};
    {
        auto writer = RunFileWriter::reopen_closed(path, batch);
        ASSERT_TRUE(writer) << describe(writer.error());
        EXPECT_FALSE(read_run_file_contents(path)->closed);
        EXPECT_FALSE(summarize_run_file(path)->closed);
        ASSERT_TRUE(writer->close(true, "again", random.tie()));
    }
    const auto read = read_run_file_contents(path);
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_TRUE(read->closed);
    ASSERT_EQ(read->revisions.answers.size(), 1U);
    const auto& [finding, at, utc_ns, text] = read->revisions.answers[0];
    EXPECT_EQ(finding, "moved_optic");
    EXPECT_EQ(at, monotonic_from_ns(9));
    EXPECT_EQ(utc_ns, 11);
    EXPECT_EQ(text, "the bracket was tight");
    EXPECT_TRUE(verify_chain(path)->intact());
}

TEST(RevisionRows, OnlyAnOrderReopensAClosedRun) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{33};
    closed_run(path, random);
    EXPECT_FALSE(RunFileWriter::reopen(path));
    RunBatch no_order;
    no_order.events.push_back({EventKind::note, monotonic_from_ns(1), 1, "hello", Fault::none, 0});
    EXPECT_FALSE(RunFileWriter::reopen_closed(path, no_order));
    EXPECT_TRUE(read_run_file_contents(path)->closed);
}

TEST(RevisionRows, AReadingThatNobodyOrderedIsRefused) {
    const ScratchFolder scratch;
    const auto path = scratch.file("r.axiscal");
    RandomRun random{34};
    auto writer = RunFileWriter::create(path, random.header()).value();
    const auto first = random.point(0);
    ASSERT_TRUE(append(writer, first));
    ASSERT_TRUE(append(writer, again(random, first, 7)));
    const auto read = read_run_file(path);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().detail.find("no retake asked for it"), std::string::npos);
}

TEST(RevisionRows, AnOrderOrAnExclusionThatIsChangedShows) {
    const ScratchFolder scratch;
    for (const std::string change :
         {"UPDATE retake SET reason = 'better'", "UPDATE retake_point SET planned_step = 1",
          "DELETE FROM retake", "UPDATE preflight SET passed = 1"}) {
        const auto path = scratch.file(sha256_hex(change) + ".axiscal");
        RandomRun random{35};
        closed_run(path, random);
        {
            auto writer = RunFileWriter::reopen_closed(path, first_rows(order_for(4, 2)));
            ASSERT_TRUE(writer);
            RunBatch more;
            more.preflight = {{"soak", false, false, "Wait.", "why"}};
            ASSERT_TRUE(writer->write(more));
            ASSERT_TRUE(writer->close(true, "again", random.tie()));
        }
        ASSERT_TRUE(read_run_file(path));
        auto database = Database::open(path, Database::Access::read_write, Fault::io).value();
        ASSERT_TRUE(database->execute(change));
        database.reset();
        EXPECT_FALSE(read_run_file(path)) << change;
        EXPECT_FALSE(verify_chain(path)->intact()) << change;
    }
}

} // namespace
} // namespace axiscal::revision_rows_test

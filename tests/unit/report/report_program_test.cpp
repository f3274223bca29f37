// The program as the daemon starts it: a closed run file in, an outbox entry out.

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/documents/probed_block.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace axiscal::report_program_test {
namespace {

using testing::append;
using testing::read_bytes;
using testing::ScratchFolder;

class ReportProgram : public ::testing::Test {
protected:
    std::string
    write_run(RunRecord run, bool complete = true, const RunAttachments& attachments = {}) {
        const std::string path = folder_.file(run.run_id + ".axiscal");
        auto writer = RunFileWriter::create(path, run, attachments).value();
        EXPECT_TRUE(append(writer, run.environment));
        for (const DatumRecord& datum : run.datums)
            EXPECT_TRUE(append(writer, datum));
        for (const PointRecord& point : run.points)
            EXPECT_TRUE(append(writer, point));
        EXPECT_TRUE(writer.close(complete, complete ? "" : "aborted by the operator", run.closed));
        return path;
    }

    /// Exit code; stdout and stderr are kept.
    int start(const std::string& arguments) {
        const std::string command = "'" AXISCAL_REPORT_PROGRAM "' " + arguments + " >'" +
                                    folder_.file("out") + "' 2>'" + folder_.file("err") + "'";
        const int status = std::system(command.c_str());
        out_ = read_bytes(folder_.file("out"));
        err_ = read_bytes(folder_.file("err"));
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    ScratchFolder folder_;
    std::string out_, err_;
};

TEST_F(ReportProgram, StagesTheFourFilesAndPrintsTheirPaths) {
    const std::string run = write_run(test::synthetic_run());
    ASSERT_EQ(start(run + " --outbox " + folder_.file("outbox")), 0) << err_;
    const auto line = nlohmann::json::parse(out_);
    EXPECT_EQ(line.at("entry"), folder_.file("outbox/20260101T000000Z-X"));
    for (const char* key : {"json", "csv", "pdf", "run_file"})
        EXPECT_GT(std::filesystem::file_size(line.at(key).get<std::string>()), 500u) << key;
    const std::string copy = line.at("run_file");
    const auto document = nlohmann::json::parse(read_bytes(line.at("json")));
    EXPECT_EQ(document.at("run").at("run_file_sha256"), sha256_of_file(copy).value());
    EXPECT_EQ(document.at("run").at("result_digest").get<std::string>().size(), 64u);
    const auto entries = std::filesystem::directory_iterator{folder_.file("outbox")};
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "no temporary folder is left";
}

TEST_F(ReportProgram, GivesEqualBytesEachTime) {
    const std::string run = write_run(test::synthetic_run());
    ASSERT_EQ(start(run + " --to " + folder_.file("a")), 0) << err_;
    const auto a = nlohmann::json::parse(out_);
    ASSERT_EQ(start(run + " --to " + folder_.file("b")), 0) << err_;
    const auto b = nlohmann::json::parse(out_);
    for (const char* key : {"json", "csv", "pdf", "run_file"})
        EXPECT_TRUE(read_bytes(a.at(key)) == read_bytes(b.at(key))) << key;
}

TEST_F(ReportProgram, StagesTheFourFilesOfAProbingTest) {
    RunAttachments attachments;
    attachments.setup = test::probed_block();
    const std::string run = write_run(test::probing_header(), true, attachments);
    for (const char* place : {"outbox", "to"}) { // the station's own report, and an export
        const std::string folder = folder_.file(place);
        ASSERT_EQ(start(run + " --" + place + " " + folder), 0) << err_;
        const auto line = nlohmann::json::parse(out_);
        EXPECT_EQ(line.at("entry"), folder + "/20260101T010000Z-probing");
        const auto document = nlohmann::json::parse(read_bytes(line.at("json")));
        EXPECT_EQ(document.at("run").at("run_file_sha256"),
                  sha256_of_file(line.at("run_file").get<std::string>()).value());
        const std::string words = test::text_of(line.at("pdf"));
        for (const char* word : {"E_TD,X", "E_TD,Y", "E_TD,Z", "40.00"})
            EXPECT_NE(words.find(word), std::string::npos) << word;
        EXPECT_GT(std::filesystem::file_size(line.at("csv").get<std::string>()), 500u);
    }
    EXPECT_TRUE(read_stored_result(run)) << "the first evaluation is kept in the run file";
}

TEST_F(ReportProgram, OfTwoAtOnceOnOneRunOneStagesItAndTheOtherSaysSo) {
    const std::string run = write_run(test::synthetic_run());
    const std::string outbox = folder_.file("outbox");
    const std::string one = "'" AXISCAL_REPORT_PROGRAM "' '" + run + "' --outbox '" + outbox + "'";
    const std::string said = folder_.file("said");
    for (const char* again : {"first", "second"}) {
        const std::string both = one + " >>'" + said + "' 2>&1 & other=$!; " + one + " >>'" + said +
                                 "' 2>&1; a=$?; wait $other; exit $((a + $?))";
        const int code = WEXITSTATUS(std::system(both.c_str()));
        EXPECT_EQ(code, again == std::string{"first"} ? 3 : 6) << read_bytes(said);
    }
    EXPECT_NE(read_bytes(said).find("exists already"), std::string::npos);
    const std::string place = outbox + "/20260101T000000Z-X";
    const auto document = nlohmann::json::parse(read_bytes(place + "/certificate.json"));
    EXPECT_EQ(document.at("run").at("run_file_sha256"),
              sha256_of_file(place + "/20260101T000000Z-X.axiscal").value());
    const auto entries = std::filesystem::directory_iterator{outbox};
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(ReportProgram, LeavesTheMarkOfAnUnfinishedCertificateWhereTheDiskFailed) {
    const std::string run = write_run(test::synthetic_run());
    const std::string staging = folder_.file("outbox/.20260101T000000Z-X.staging");
    const std::string full = "ulimit -f 1; exec '" AXISCAL_REPORT_PROGRAM "' '" + run +
                             "' --outbox '" + folder_.file("outbox") + "' 2>/dev/null";
    EXPECT_NE(std::system(full.c_str()), 0);
    EXPECT_TRUE(std::filesystem::is_empty(staging));
    ASSERT_EQ(start(run + " --outbox " + folder_.file("outbox")), 0) << err_;
    EXPECT_FALSE(std::filesystem::exists(staging));
}

TEST_F(ReportProgram, RefusesAnIncompleteRunWithASentence) {
    RunRecord run = test::synthetic_run();
    run.points.resize(7);
    const std::string path = write_run(run, false);
    EXPECT_EQ(start(path + " --outbox " + folder_.file("outbox")), 3);
    EXPECT_EQ(out_, "");
    EXPECT_NE(err_.find("aborted by the operator"), std::string::npos) << err_;
    EXPECT_TRUE(std::filesystem::is_empty(folder_.file("outbox")));
}

TEST_F(ReportProgram, RefusesWhatIsNoRunFileAndAWrongCommandLine) {
    testing::write_bytes(folder_.file("x.axiscal"), "not a run file");
    EXPECT_EQ(start(folder_.file("x.axiscal") + " --to " + folder_.file("a")), 3) << err_;
    EXPECT_EQ(start(folder_.file("x.axiscal")), 2) << "no place named";
}

const char* const circular_case =
    R"({"analysis":"circular","id":"hall 3/left","nominal_radius_mm":150,"feed_mm_per_min":750,
"report":{"customer":"Example customer","date":"2026-01-01"},"traces":[{"sense":"ccw",
"angle_rad":[0,0.785,1.571,2.356,3.142,3.927,4.712,5.498],
"radial_deviation_mm":[0.002,-0.001,0.002,0.005,0.002,-0.001,0.002,0.005]}]})";

TEST_F(ReportProgram, DrawsTheCertificateOfACircularCase) {
    testing::write_bytes(folder_.file("mine.json"), circular_case);
    ASSERT_EQ(start(folder_.file("mine.json") + " --to " + folder_.file("out-folder")), 0) << err_;
    const auto line = nlohmann::json::parse(out_);
    EXPECT_EQ(line.at("entry"), folder_.file("out-folder/hall-3-left"));
    const auto document = nlohmann::json::parse(read_bytes(line.at("json")));
    EXPECT_EQ(document.at("run").at("case_sha256"),
              sha256_of_file(folder_.file("mine.json")).value());
    EXPECT_EQ(read_bytes(line.at("case")), circular_case);
    const std::string words = test::text_of(line.at("pdf"));
    EXPECT_NE(words.find("Example customer"), std::string::npos);
}

TEST_F(ReportProgram, RefusesACaseThatIsNotCircularOrGoesIntoTheOutbox) {
    testing::write_bytes(folder_.file("other.json"), R"({"analysis":"drift"})");
    EXPECT_EQ(start(folder_.file("other.json") + " --to " + folder_.file("a")), 3);
    EXPECT_NE(err_.find("analysis: "), std::string::npos) << err_;
    testing::write_bytes(folder_.file("mine.json"), circular_case);
    EXPECT_EQ(start(folder_.file("mine.json") + " --outbox " + folder_.file("a")), 3);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("a/hall-3-left")));
}

} // namespace
} // namespace axiscal::report_program_test

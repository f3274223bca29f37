// From the run file of a probing test to its documents. The truth is a block whose delays are
// known.

#include "acquisition/documents/probing/probing_document.hpp"

#include "acquisition/documents/run_verify.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "evaluated.hpp"
#include "probed_block.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace axiscal::probing_document_test {
namespace {

using testing::ScratchFolder;

class ProbingPapers : public ::testing::Test {
protected:
    std::string written(bool close = true) {
        const std::string path = folder_.file("probing.axiscal");
        RunRecord run = test::probing_header();
        run.statements.machine = "Machining centre MC-800";
        RunAttachments attachments;
        attachments.setup = test::probed_block();
        auto writer = RunFileWriter::create(path, run, attachments).value();
        if (close) {
            EXPECT_TRUE(writer.close(true, "", run.closed));
        }
        return path;
    }
    ScratchFolder folder_;
};

TEST_F(ProbingPapers, TellFeedFiguresAndWhatIsMissing) {
    const auto document = test::evaluated<ProbingResult>(written());
    ASSERT_TRUE(document) << describe(document.error());
    const auto json = probing_to_json(*document);
    EXPECT_EQ(json.at("format"), "axiscal.probing/1");
    EXPECT_EQ(json.at("feed_mm_per_min"), 480);
    EXPECT_EQ(json.at("feed_mm_per_ms"), 0.008); // of the standard: 0.008 mm a millisecond
    EXPECT_EQ(json.at("preliminary"), true);
    EXPECT_EQ(json.at("missing"), nlohmann::ordered_json::array({"an uncertainty budget"}));
    const auto& series = json.at("parameters");
    ASSERT_EQ(series.size(), 6U);
    EXPECT_NEAR(series[1].at("variation_ms").get<double>(), 0.8, 1e-9);
    EXPECT_NEAR(series[1].at("period_ms").get<double>(), 1, 1e-9);
    EXPECT_NEAR(series[3].at("variation_mm").get<double>(), 0.040, 1e-12);
    EXPECT_NEAR(series[3].at("variation_ms").get<double>(), 5, 1e-9);
    EXPECT_NEAR(series[5].at("net_variation_mm").get<double>(), 0.004, 1e-12);
    const auto& statements = json.at("run").at("statements");
    EXPECT_EQ(statements.at("machine"), "Machining centre MC-800");
    EXPECT_TRUE(statements.at("customer").is_null());
}

TEST_F(ProbingPapers, ListEveryTouch) {
    const std::string csv = probing_csv(test::evaluated<ProbingResult>(written()).value());
    EXPECT_EQ(csv.substr(0, csv.find("\r\n")), "direction,kind,approach_mm,x_mm,y_mm,z_mm");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * (5 + 11));
    EXPECT_NE(csv.find("\r\n0 -1 0,touch,2.009600,-10.000000,-0.056000,-10.000000\r\n"),
              std::string::npos);
    EXPECT_NE(csv.find("\r\n0 0 -1,reference,2.000000,-10.000000,-10.000000,-0.019000\r\n"),
              std::string::npos);
}

TEST_F(ProbingPapers, AreHeldAgainstTheRunFile) {
    const std::string path = written();
    ASSERT_TRUE(test::stored_first(path));
    auto document = probing_to_json(test::evaluated<ProbingResult>(path).value());
    const std::string json = folder_.file("certificate.json");
    std::ofstream{json} << document.dump();
    EXPECT_TRUE(verify_run(path, {json, {}, {}}).value().intact());
    document["parameters"][3]["variation_mm"] = 0.030;
    std::ofstream{json} << document.dump();
    const auto report = verify_run(path, {json, {}, {}}).value();
    ASSERT_EQ(report.certificate_findings.size(), 1U);
    EXPECT_EQ(report.certificate_findings[0].place, "/parameters/3/variation_mm");
}

TEST_F(ProbingPapers, OfAnOpenRunAreRefused) {
    const auto document = test::evaluated<ProbingResult>(written(false));
    ASSERT_FALSE(document);
    EXPECT_EQ(document.error().fault, Fault::incomplete_run);
}

} // namespace
} // namespace axiscal::probing_document_test

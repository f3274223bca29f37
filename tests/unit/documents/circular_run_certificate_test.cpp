// From the run file of a circular test to its certificate, and back.

#include "acquisition/documents/circular/circular_certificate_json.hpp"
#include "acquisition/documents/run_verify.hpp"
#include "evaluated.hpp"
#include "written_circle.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace axiscal::circular_run_certificate_test {
namespace {

using testing::ScratchFolder;

class CircularRunCertificate : public ::testing::Test {
protected:
    std::string written(bool close = true, const std::string& eve_source = "") {
        test::DrivenBar bar = test::bar_of_the_shop();
        bar.setup.uncertainty.device_width_um = 0.5;
        bar.setup.uncertainty.repeatability_um = 0.3;
        bar.setup.uncertainty.eve_um = 0.4;
        truth_ = bar.truth;
        RunAttachments beside;
        beside.eve_source = eve_source;
        return test::write_circles(folder_, bar, bar.drive(), close, beside);
    }
    ScratchFolder folder_;
    test::CircleTruth truth_;
};

TEST_F(CircularRunCertificate, HoldsTheTruthThatWasDriven) {
    const auto certificate = test::evaluated<CircularCertificate>(written());
    ASSERT_TRUE(certificate) << describe(certificate.error());
    const CircularMeasurement& measured = certificate->measured;
    EXPECT_EQ(measured.run.run_id, "bay3-circle");
    EXPECT_FALSE(measured.taken_elsewhere);
    EXPECT_NEAR(certificate->parameters.ccw->cover.arc_deg, 220, 0.1);
    const auto& backlash = certificate->diagnosis.of(circular::Cause::backlash_x);
    EXPECT_NEAR(*backlash.value, truth_["backlash_x"], 3.5 * backlash.standard_uncertainty + 1e-4);
    EXPECT_NE(certificate->uncertainty_of("G_b"), nullptr) << "its three terms are stated";
    EXPECT_EQ(certificate->uncertainty_of("D"), nullptr) << "no length of the bar is known";
    EXPECT_TRUE(certificate->preliminary);
    EXPECT_NEAR(*measured.conditions.machine.mean_degC, 21.0, 1e-12);
}

TEST_F(CircularRunCertificate, IsTheSameWhenItIsComputedAnew) {
    const std::string path = written();
    ASSERT_TRUE(test::stored_first(path));
    const auto stored = read_stored_result(path);
    ASSERT_TRUE(stored);
    const auto again = test::evaluated<CircularCertificate>(path);
    ASSERT_TRUE(again) << describe(again.error());
    EXPECT_EQ(stored->digest, again->result_digest);
    EXPECT_EQ(stored->digest.size(), 64u);
    EXPECT_NE(stored->document.find("\"standard\":\"ISO 230-4\""), std::string::npos);
    EXPECT_TRUE(test::stored_first(path)) << "a file that has a result keeps it";
}

TEST_F(CircularRunCertificate, BearsTheNumberThatItsFirstEvaluationTook) {
    const std::string path = written();
    EXPECT_TRUE(circular_certificate_to_json(test::evaluated<CircularCertificate>(path).value())
                    .at("certificate")
                    .at("number")
                    .is_null())
        << "it was not issued";
    const std::string state = std::filesystem::path{path}.parent_path().string();
    const Issue numbered{nullptr, state};
    ASSERT_TRUE(test::evaluated<CircularCertificate>(path, &numbered));
    const auto made = test::evaluated<CircularCertificate>(path).value();
    const std::string stated = "N-17"; // of written_circle.hpp
    EXPECT_EQ(made.measured.run.statements.certificate_number, stated);
    EXPECT_EQ(circular_certificate_to_json(made).at("certificate").at("number"), stated);
    EXPECT_EQ(made.replaces, "");
    EXPECT_TRUE(verify_run(path)->intact());
}

TEST_F(CircularRunCertificate, OfAnOpenRunIsRefused) {
    const auto certificate = test::evaluated<CircularCertificate>(written(false));
    ASSERT_FALSE(certificate);
    EXPECT_EQ(certificate.error().fault, Fault::incomplete_run);
}

TEST_F(CircularRunCertificate, SaysWhichDriftTestItsEveIsOf) {
    const auto sources_in = [](const std::string& path) {
        const auto certificate = test::evaluated<CircularCertificate>(path);
        EXPECT_TRUE(certificate) << describe(certificate.error());
        std::vector<std::string> sources;
        const auto document = circular_certificate_to_json(*certificate);
        for (const auto& term : document.at("budget").at("contributions"))
            if (term.contains("source"))
                sources.push_back(term["term"].get<std::string>() + " of " +
                                  term["source"].get<std::string>());
        return sources;
    };
    const std::string path = written(true, "bay3-XY-ballbar-drift");
    EXPECT_EQ(sources_in(path), std::vector<std::string>{"environment of bay3-XY-ballbar-drift"});
    ASSERT_TRUE(test::stored_first(path));
    EXPECT_TRUE(verify_run(path)->intact());
    ASSERT_TRUE(std::filesystem::remove(path));
    EXPECT_TRUE(sources_in(written()).empty()) << "of an E_VE that somebody stated";
}

TEST_F(CircularRunCertificate, IsVerifiedAgainstItsRunFile) {
    const std::string path = written();
    ASSERT_TRUE(test::stored_first(path));
    auto document =
        circular_certificate_to_json(test::evaluated<CircularCertificate>(path).value());
    const std::string json = folder_.file("certificate.json");
    std::ofstream{json} << document.dump();
    const auto intact = verify_run(path, {json, {}, {}});
    ASSERT_TRUE(intact);
    EXPECT_TRUE(intact->intact()) << to_text(*intact);
    document["parameters"]["G_b"]["value"] = 0.001;
    std::ofstream{json} << document.dump();
    const auto altered = verify_run(path, {json, {}, {}});
    ASSERT_TRUE(altered);
    ASSERT_EQ(altered->certificate_findings.size(), 1u);
    EXPECT_EQ(altered->certificate_findings.front().place, "/parameters/G_b/value");
}

} // namespace
} // namespace axiscal::circular_run_certificate_test

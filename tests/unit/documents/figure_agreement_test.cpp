// What counts as the same figure on another processor, and for which runs.

#include "acquisition/documents/figure_agreement.hpp"

#include "acquisition/documents/circular/circular_json.hpp"
#include "acquisition/documents/run_verify.hpp"
#include "evaluated.hpp"
#include "tests/unit/analysis/rotary_truth.hpp"
#include "written_circle.hpp"

#include <cmath>

namespace axiscal::figure_agreement_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ScratchFolder;

TEST(FigureAgreement, OfALinearAxisIsTheSameBits) {
    const RunRecord run = test::simulated_run({});
    EXPECT_TRUE(agreement_of(run).holds(0.3, 0.3));
    EXPECT_FALSE(agreement_of(run).holds(0.3, std::nextafter(0.3, 1.0)));
}

TEST(FigureAgreement, OfAnArcSineIsItsRounding) {
    RunRecord run = test::truth_with_a_bad_table().run();
    EXPECT_TRUE(agreement_of(run).holds(0.0129, 0.0129 + 9e-9));
    EXPECT_FALSE(agreement_of(run).holds(0.0129, 0.0129 + 1.1e-8));
    run.rotary->method = AngleMethod::polygon;
    EXPECT_FALSE(agreement_of(run).holds(0.0129, 0.0129 + 1e-15)) << "an autocollimator needs none";
}

TEST(FigureAgreement, OfFreezingAirIsThatOfTheExponential) {
    test::Truth truth;
    truth.air_C = [](double) { return 0.0; };
    EXPECT_FALSE(agreement_of(test::simulated_run(truth)).holds(0, 1e-15));
    truth.air_C = [](double s) { return s > 600 ? -0.1 : 0.0; };
    EXPECT_TRUE(agreement_of(test::simulated_run(truth)).holds(0, 1e-15));
    truth.air_C = [](double) { return 20.0; };
    truth.material_C = [](double) { return -5.0; };
    EXPECT_FALSE(agreement_of(test::simulated_run(truth)).holds(0, 1e-15)) << "material, no air";
}

TEST(FigureAgreement, OfAStatedAngleIsThatOfItsSine) {
    RunRecord run = test::simulated_run({});
    run.uncertainty = UncertaintySetup{};
    EXPECT_FALSE(agreement_of(run).holds(0, 1e-15));
    run.uncertainty->misalignment_angle = radian(0.001);
    EXPECT_TRUE(agreement_of(run).holds(0, 1e-15));
}

TEST(FigureAgreement, CountsForFiguresAloneNeverForWordsOrStructure) {
    const Json right = {
        {"value", 1.0}, {"n", 5}, {"words", "1.0"}, {"rows", Json::array({1.5, 2.5})}};
    EXPECT_TRUE(disagreements(right, right, rounding_of_the_library).empty());
    Json near = right;
    near["rows"][1] = 2.5 + 9e-9;
    EXPECT_TRUE(disagreements(near, right, rounding_of_the_library).empty());
    EXPECT_EQ(disagreements(near, right, same_bits), std::vector<std::string>{"/rows/1"});
    for (const auto& [place, other] : {std::pair{"/value", Json(1.0 + 1e-7)},
                                       {"/value", Json("1.0")},
                                       {"/n", Json(6)},
                                       {"/words", Json("1.00000000001")}}) {
        Json changed = right;
        changed[Json::json_pointer{place}] = other;
        EXPECT_EQ(disagreements(changed, right, rounding_of_the_library),
                  std::vector<std::string>{place});
    }
    Json shorter = right;
    shorter["rows"].erase(1);
    EXPECT_EQ(disagreements(shorter, right, rounding_of_the_library).size(), 1u);
    Json longer = right;
    longer["more"] = 1.0;
    EXPECT_EQ(disagreements(longer, right, rounding_of_the_library),
              std::vector<std::string>{"/more"});
}

/// A circular run file with the result that another processor stored: each figure `by_mm` away.
class StoredElsewhere : public ::testing::Test {
protected:
    std::string stored_with(double by_mm) {
        test::DrivenBar bar = test::bar_of_the_shop();
        const std::string path = test::write_circles(folder_, bar, bar.drive());
        const CircularCertificate made = test::evaluated<CircularCertificate>(path).value();
        Json figures = circular_to_json(
            {made.measured.test, made.measured.axes, made.parameters, made.diagnosis, made.budget});
        for (const auto& one : figures["parameters"].items())
            one.value()["value"] = one.value()["value"].get<double>() + by_mm;
        EXPECT_TRUE(store_result(path, {digest_, figures.dump()}));
        return path;
    }
    std::string digest_ = std::string(64, 'a'); ///< never that of this processor
    ScratchFolder folder_;
};

TEST_F(StoredElsewhere, FiguresThatAgreeKeepTheDigestOfTheFirstEvaluation) {
    const std::string path = stored_with(1e-12);
    const auto again = test::evaluated<CircularCertificate>(path);
    ASSERT_TRUE(again) << describe(again.error());
    EXPECT_EQ(again->result_digest, digest_);
    EXPECT_EQ(verify_run(path).value().result_digest, digest_);
}

TEST_F(StoredElsewhere, FiguresThatDoNotAgreeAreRefused) {
    const auto again = test::evaluated<CircularCertificate>(stored_with(2e-8));
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().fault, Fault::bad_run_file);
}

} // namespace
} // namespace axiscal::figure_agreement_test

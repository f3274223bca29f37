// From the run file of a straightness test to its documents. The numbers are those of
// straightness_numbers.py.

#include "acquisition/documents/straightness/straightness_document.hpp"

#include "acquisition/documents/run_verify.hpp"
#include "acquisition/documents/straightness/straightness_csv.hpp"
#include "acquisition/documents/straightness/straightness_json.hpp"
#include "config/json_text.hpp"
#include "evaluated.hpp"
#include "straightness_run.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace axiscal::straightness_document_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ScratchFolder;

constexpr double rounding_um = 1e-9; ///< of a reading at 1 mm times the factor

StraightnessResult result_of(RunFileContents contents) {
    auto result = straightness_result_of("bow.axiscal", std::move(contents));
    EXPECT_TRUE(result) << (result ? "" : describe(result.error()));
    return std::move(result).value();
}

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

double value_of(const Json& document, const std::string& key) {
    return document.at("parameters").at(key).at("value").get<double>();
}

double expanded_of(const Json& document, const std::string& key) {
    return document.at("parameters").at(key).at("expanded_uncertainty").at("value").get<double>();
}

TEST(StraightnessDocument, TellsTheErrorAgainstEachReferenceLine) {
    const Json document = straightness_to_json(result_of(test::bow_contents()));
    for (const auto& [key, value] : {std::pair{"straightness_end_points", 3.95},
                                     {"straightness_least_squares", 3.97},
                                     {"straightness_minimum_zone", 3.95},
                                     {"straightness_end_points_forward", 4.0},
                                     {"straightness_least_squares_forward", 4.0},
                                     {"straightness_minimum_zone_forward", 4.0},
                                     {"straightness_end_points_backward", 3.9},
                                     {"straightness_least_squares_backward", 3.94},
                                     {"straightness_minimum_zone_backward", 3.9},
                                     {"straightness_B_mean", 0.62},
                                     {"straightness_R", 1.931370849898476}})
        EXPECT_NEAR(value_of(document, key), value, rounding_um) << key;
    EXPECT_NEAR(std::fabs(value_of(document, "straightness_B")), 0.8, rounding_um);
    EXPECT_EQ(document.at("standard"), "ISO 230-1:2012");
    EXPECT_EQ(document.at("symbol"), "E_YX");
    EXPECT_EQ(document.at("reference"), "least_squares");
    EXPECT_EQ(document.at("unit"), "um");
}

/// The same bow with the mirror turned: its form, 0.5 (2, -1, -2, -1, 2) um, which no line
/// explains, counts with the other sign; slope and offset are those of another set-up.
StraightnessSetup bow_with_reversal() {
    constexpr double mirror_um[]{1, -0.5, -1, -0.5, 1};
    constexpr double forward_um[]{0.1, 3.2, 5.1, 4.2, 2.1}, backward_um[]{-0.3, 2.4, 4.5, 3.5, 1.5};
    StraightnessSetup setup = test::bow_setup();
    setup.reversal_of = "station-20260101T000000Z-X";
    RecordedLine& other = setup.reversal.emplace();
    other.run_id = setup.reversal_of;
    other.readings = test::bow_approaches;
    for (int i = 0; i < test::bow_targets; ++i) {
        const double moved = 0.01 * 100 * i + 3 - 2 * mirror_um[i];
        other.rows.push_back(
            {mm(100.0 * i), um(forward_um[i] + moved), um(backward_um[i] + moved)});
    }
    return setup;
}

TEST(StraightnessDocument, ReversalPartsTheMirrorFromTheMotion) {
    const StraightnessResult result = result_of(test::bow_contents(bow_with_reversal()));
    const Json document = straightness_to_json(result);
    const double residuals[]{-2.76, 1.155, 3.17, 1.235, -2.8};
    const Json& rows = document.at("positions");
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_NEAR(rows[i].at("residual_least_squares").get<double>(), residuals[i], 1e-8);
    EXPECT_NEAR(value_of(document, "straightness_least_squares"), 5.97, 1e-8);
    EXPECT_NEAR(document.at("mirror").at("least_squares").get<double>(), 2, 1e-8);
    EXPECT_NEAR(value_of(document, "straightness_B_mean"), 0.62, 1e-8);
    EXPECT_EQ(document.at("run").at("reversal").at("run"), "station-20260101T000000Z-X");
    const auto& remarks = result.remarks;
    EXPECT_TRUE(std::ranges::any_of(remarks, [](const std::string& remark) {
        return holds(remark, "parted from the motion by reversal") && holds(remark, "2 \u00B5m");
    })) << json_text(document.at("run").at("remarks"));
}

TEST(StraightnessDocument, OfAPartialResultTheMirrorIsNotParted) {
    RunFileContents contents = test::bow_contents(bow_with_reversal());
    contents.run.complete = false;
    contents.run.closing_reason = "aborted";
    contents.run.points.pop_back();
    const StraightnessResult result = result_of(std::move(contents));
    EXPECT_FALSE(result.mirror);
    EXPECT_TRUE(std::ranges::any_of(result.remarks, [](const std::string& remark) {
        return holds(remark, "This is the result of one position alone");
    }));
}

TEST(StraightnessDocument, TellsMeansResidualsAndTheSlopeOfTheSetUp) {
    const Json document = straightness_to_json(result_of(test::bow_contents()));
    const Json& rows = document.at("positions");
    ASSERT_EQ(rows.size(), 5U);
    const double residuals[]{-1.76, 0.655, 2.17, 0.735, -1.8};
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_NEAR(rows[i].at("residual_least_squares").get<double>(), residuals[i], rounding_um);
    EXPECT_NEAR(rows[1].at("mean_forward").get<double>(), 3.2, rounding_um);
    EXPECT_NEAR(rows[1].at("mean_backward").get<double>(), 2.4, rounding_um);
    EXPECT_NEAR(rows[1].at("mean").get<double>(), 2.8, rounding_um);
    EXPECT_NEAR(rows[1].at("B").get<double>(), 0.8, rounding_um);
    EXPECT_NEAR(rows[1].at("s_forward").get<double>(), 0.2 * std::sqrt(2), rounding_um);
    const Json& line = document.at("lines")[1];
    EXPECT_EQ(line.at("line"), "mean");
    EXPECT_EQ(line.at("reference"), "least_squares");
    EXPECT_NEAR(line.at("slope_um_per_m").get<double>(), 4.85, 1e-7);
}

TEST(StraightnessDocument, TellsUWithItsTerms) {
    const Json document = straightness_to_json(result_of(test::bow_contents()));
    EXPECT_NEAR(expanded_of(document, "straightness_least_squares"), 0.24893560311855756, 1e-9);
    EXPECT_NEAR(expanded_of(document, "straightness_least_squares_forward"), 0.3503925113355021,
                1e-9);
    EXPECT_NEAR(expanded_of(document, "straightness_least_squares_backward"), 0.3503755156970874,
                1e-9);
    const Json& mean = document.at("budget")[0];
    EXPECT_EQ(mean.at("line"), "mean");
    EXPECT_EQ(mean.at("environment_by"), "scatter"); // 0.195 um; E_VE / (2 sqrt 3) is 0.115 um
    const Json& terms = mean.at("references")[1].at("contributions");
    ASSERT_EQ(terms.size(), 4U);
    const double u_um[]{0.009925, 0.01385640646055102, 0.0013145341380123988, 0.12328828005937953};
    for (std::size_t i = 0; i < terms.size(); ++i)
        EXPECT_NEAR(terms[i].at("u").get<double>(), u_um[i], 1e-9) << i;
    EXPECT_EQ(document.at("preliminary"), false);
    EXPECT_FALSE(document.at("parameters").at("straightness_R").contains("expanded_uncertainty"));
}

TEST(StraightnessDocument, WithoutAStatedTermThereIsNoU) {
    StraightnessSetup setup = test::bow_setup();
    setup.uncertainty.mirror_limit_um_per_m2.reset();
    const Json document = straightness_to_json(result_of(test::bow_contents(setup)));
    EXPECT_EQ(document.at("preliminary"), true);
    EXPECT_EQ(document.at("missing"), Json::array({"a limit of the mirror's form"}));
    EXPECT_FALSE(document.at("parameters")
                     .at("straightness_least_squares")
                     .contains("expanded_uncertainty"));
    EXPECT_TRUE(document.at("monte_carlo").is_null());
}

TEST(StraightnessDocument, ATurnedPrismGivesTheSameFigures) {
    StraightnessSetup setup = test::bow_setup();
    setup.sign = -1;
    const Json document = straightness_to_json(result_of(test::bow_contents(setup)));
    EXPECT_NEAR(value_of(document, "straightness_least_squares"), 3.97, rounding_um);
    EXPECT_NEAR(document.at("positions")[2].at("mean").get<double>(), 4.8, rounding_um);
}

TEST(StraightnessDocument, SaysWhatTheFigureIsAndIsNot) {
    const auto remarks = result_of(test::bow_contents()).remarks;
    for (const char* words :
         {"Positions by the control of the machine",
          "The mirror's form is part of the result; its limit stands in the budget.",
          "No reading is compensated for the expansion of the axis",
          "In no budget: the roll of the prism"})
        EXPECT_TRUE(std::ranges::any_of(remarks, [&](const std::string& remark) {
            return holds(remark, words);
        })) << words;
}

TEST(StraightnessDocument, IsJudgedByTheLimitsOfItsOwnFigures) {
    RunFileContents contents = test::bow_contents();
    contents.run.tolerances = ToleranceRecord{"agreed",
                                              "order 17",
                                              "um",
                                              DecisionRule::guard_U,
                                              false,
                                              {{"straightness_least_squares", {}, 5.0},
                                               {"straightness_end_points", {}, 4.0},
                                               {"straightness_R", {}, 5.0}}};
    const Json document = straightness_to_json(result_of(std::move(contents)));
    const Json& rows = document.at("verdicts");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].at("verdict"), "pass");          // 3.97 + 0.25 <= 5
    EXPECT_EQ(rows[1].at("verdict"), "not_provable");  // 3.95 + 0.25 > 4 > 3.95 - 0.25
    EXPECT_EQ(rows[2].at("verdict"), "not_evaluated"); // R has no U
}

TEST(StraightnessDocument, OfAnOpenRunIsPartialAndBearsNoNumber) {
    RunFileContents contents = test::bow_contents();
    contents.closed = contents.run.complete = false;
    contents.run.statements.certificate_number = "CAL-{year}";
    contents.run.points.pop_back();
    const StraightnessResult result = result_of(std::move(contents));
    EXPECT_TRUE(result.completeness.partial());
    EXPECT_EQ(result.run.statements.certificate_number, "");
    EXPECT_FALSE(result.conformity);
    EXPECT_EQ(straightness_to_json(result).at("completeness").at("used"), 19);
}

TEST(StraightnessDocument, CsvHoldsEveryDeviation) {
    const std::string csv = straightness_csv(result_of(test::bow_contents()));
    EXPECT_EQ(std::ranges::count(csv, '\n') - std::ranges::count(csv, '#'), 1 + 20);
    EXPECT_TRUE(holds(csv, "\r\nforward,100,2,3.")) << csv;
    EXPECT_TRUE(holds(csv, "\r\n# parameter,straightness_least_squares,3.9")) << csv;
}

TEST(StraightnessDocument, ARunFileGivesTheSameAndVerifies) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("bow.axiscal");
    test::write_bow(path, test::bow_contents());
    const auto first = test::stored_first(path);
    ASSERT_TRUE(first) << describe(first.error());
    const auto again = test::evaluated<StraightnessResult>(path);
    ASSERT_TRUE(again) << describe(again.error());
    EXPECT_EQ(digest_of(*first), again->result_digest);
    EXPECT_EQ(again->result_digest, result_of(test::bow_contents()).result_digest);
    const auto report = verify_run(path);
    ASSERT_TRUE(report) << describe(report.error());
    EXPECT_TRUE(report->intact());
    EXPECT_EQ(report->result_digest, again->result_digest);
}

TEST(StraightnessDocument, RefusesARunWithoutItsSetUpAndARotaryAxis) {
    RunFileContents bare = test::bow_contents();
    bare.attachments.setup = TestSetup{};
    EXPECT_EQ(straightness_result_of("r", std::move(bare)).error().detail,
              "r has no row straightness");
    RunFileContents rotary = test::bow_contents();
    rotary.run.plan.axis_kind = AxisKind::rotary;
    EXPECT_EQ(straightness_result_of("r", std::move(rotary)).error().fault, Fault::bad_run_file);
}

} // namespace
} // namespace axiscal::straightness_document_test

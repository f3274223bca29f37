// From the run file of a squareness test to its documents. The numbers are those of
// squareness_numbers.py.

#include "acquisition/documents/squareness/squareness_document.hpp"

#include "acquisition/documents/run_verify.hpp"
#include "acquisition/documents/squareness/squareness_csv.hpp"
#include "acquisition/documents/squareness/squareness_json.hpp"
#include "evaluated.hpp"
#include "squareness_run.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace axiscal::squareness_document_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ScratchFolder;

constexpr double rounding = 1e-7; ///< um/m: of readings at 1 mm times the factor, over 0.4 m

SquarenessResult result_of(RunFileContents contents) {
    auto result = squareness_result_of("square.axiscal", std::move(contents));
    EXPECT_TRUE(result) << (result ? "" : describe(result.error()));
    return std::move(result).value();
}

Json document_of(const SquarenessSetup& setup = test::square_setup()) {
    return squareness_to_json(result_of(test::square_contents(setup)));
}

double value_of(const Json& document, const std::string& key) {
    return document.at("parameters").at(key).at("value").get<double>();
}

bool has_remark(const Json& document, const std::string& words) {
    return std::ranges::any_of(document.at("run").at("remarks"), [&](const Json& remark) {
        return remark.get<std::string>().find(words) != std::string::npos;
    });
}

void expect_terms(const Json& document, const std::vector<double>& u_um_per_m, double expanded) {
    const Json& terms = document.at("budget").at("contributions");
    ASSERT_EQ(terms.size(), u_um_per_m.size());
    for (std::size_t i = 0; i < terms.size(); ++i)
        EXPECT_NEAR(terms[i].at("u").get<double>(), u_um_per_m[i], rounding) << terms[i].at("term");
    const Json& main = document.at("parameters").at("squareness_least_squares");
    EXPECT_NEAR(main.at("expanded_uncertainty").at("value").get<double>(), expanded, rounding);
}

TEST(SquarenessDocument, TellsTheAngleByEachReferenceLine) {
    const Json document = document_of();
    EXPECT_NEAR(value_of(document, "squareness_least_squares"), -10.487059709902903, rounding);
    EXPECT_NEAR(value_of(document, "squareness_end_points"), -10.609281932074424, rounding);
    EXPECT_NEAR(value_of(document, "squareness_minimum_zone"), -10.609281932074424, rounding);
    EXPECT_NEAR(document.at("method_spread").at("value").get<double>(), 0.12222222217152101,
                rounding);
    EXPECT_NEAR(document.at("parameters").at("squareness_least_squares").at("arcsec").get<double>(),
                -2.163111339164853, rounding);
    EXPECT_EQ(document.at("unit"), "um/m");
    EXPECT_EQ(document.at("standard"), "ISO 230-1:2012");
    EXPECT_EQ(document.at("title"), "Squareness of axis Y to axis X");
    EXPECT_EQ(document.at("sign"),
              "> 0 where the angle between +X and +Y is larger than 90 degrees");
    EXPECT_EQ(document.at("reference"), "least_squares");
}

TEST(SquarenessDocument, OpensWhereBothAxesLeanApart) {
    // each axis falls away from the other by 10 um/m, the square is true: 90 degrees and 20 um/m
    SquarenessSetup setup = test::square_setup();
    setup.stated.error = arcsec(0);
    setup.first = test::kept_line("x", "X", "Y", 150, {{0, 0}, {-1.5, -1.5}, {-3, -3}});
    RunFileContents contents = test::square_contents(setup);
    for (PointRecord& point : contents.run.points)
        point.reading = mm(1) - um(1.000271 * point.planned.target_index / setup.optics.factor);
    const Json document = squareness_to_json(result_of(std::move(contents)));
    EXPECT_NEAR(value_of(document, "squareness_least_squares"), 2e6 * std::atan(1e-5), rounding);
}

TEST(SquarenessDocument, WithoutAStatedErrorTheSquareIsPartOfTheResult) {
    SquarenessSetup setup = test::square_setup();
    setup.stated.error.reset();
    setup.stated.error_U.reset();
    const Json document = document_of(setup);
    EXPECT_NEAR(value_of(document, "squareness_least_squares"), -20.183333332093625, rounding);
    EXPECT_EQ(document.at("square").at("error_by"), "not taken out");
    EXPECT_TRUE(document.at("square").at("error_taken_out").is_null());
    EXPECT_TRUE(has_remark(document, "the error of the square is part of the result"));
    EXPECT_EQ(document.at("missing"), Json::array({"the uncertainty of the error of the square"}));
}

TEST(SquarenessDocument, TakesTheStatedErrorAtItsWord) {
    const Json document = document_of();
    EXPECT_EQ(document.at("square").at("position"), "normal");
    EXPECT_EQ(document.at("square").at("error_by"), "stated");
    EXPECT_NEAR(document.at("square").at("error_taken_out").at("arcsec").get<double>(), 2, 1e-9);
    EXPECT_TRUE(has_remark(document, "the error of the square was taken out as stated"));
}

TEST(SquarenessDocument, ATurnedSquareCountsItsErrorTheOtherWay) {
    SquarenessSetup setup = test::square_setup();
    setup.square = SquarePosition::turned;
    const Json document = document_of(setup);
    EXPECT_NEAR(value_of(document, "squareness_least_squares"), -29.87960695428434, rounding);
    EXPECT_EQ(document.at("square").at("position"), "turned");
}

TEST(SquarenessDocument, PartsTheSquareFromTheAxesByReversal) {
    SquarenessSetup setup = test::square_setup();
    setup.other = test::turned_square();
    const Json document = document_of(setup);
    EXPECT_NEAR(value_of(document, "squareness_least_squares"), -10.024999999381398, rounding);
    EXPECT_NEAR(value_of(document, "squareness_end_points"), -10.222222221575404, rounding);
    EXPECT_NEAR(value_of(document, "squareness_minimum_zone"), -9.777777777139766, rounding);
    const Json& square = document.at("square");
    EXPECT_EQ(square.at("error_by"), "reversal");
    EXPECT_NEAR(square.at("error_taken_out").at("value").get<double>(), 10.158333332712225,
                rounding);
    EXPECT_TRUE(has_remark(document, "by reversal, with run station-20251231T030000Z-Y"));
    ASSERT_EQ(document.at("lines").size(), 4U);
    EXPECT_EQ(document.at("lines")[2].at("square"), "turned");
    expect_terms(document,
                 {0.025062499998453495, 0.12513992168768526, 0, 0.9896217825323027,
                  0.003193743884534263, 0.2165598027061997},
                 2.042104551208613);
}

TEST(SquarenessDocument, TellsBothLinesAndWhoseTheyAre) {
    const Json document = document_of();
    const Json& lines = document.at("lines");
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].at("run_id"), "station-20251231T010000Z-X");
    EXPECT_EQ(lines[0].at("axis"), "X");
    EXPECT_EQ(lines[0].at("across"), "Y");
    EXPECT_EQ(lines[1].at("run_id"), "station-20260101T010000Z-Y");
    EXPECT_EQ(lines[1].at("axis"), "Y");
    const double slopes[]{15.333333333333332, 4.85}, errors_um[]{0.7, 3.97};
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Json& fitted = lines[i].at("references")[1];
        EXPECT_EQ(fitted.at("reference"), "least_squares");
        EXPECT_NEAR(fitted.at("slope_um_per_m").get<double>(), slopes[i], rounding);
        EXPECT_NEAR(fitted.at("straightness_um").get<double>(), errors_um[i], 1e-9);
    }
    EXPECT_NEAR(lines[0].at("means")[2].at("mean_backward_um").get<double>(), 4, 1e-9);
    EXPECT_NEAR(lines[1].at("means")[1].at("mean_forward_um").get<double>(), 3.2, 1e-9);
    EXPECT_EQ(document.at("run").at("deviations").at("forward").size(), 5U);
    EXPECT_TRUE(has_remark(document, "The line of axis X is that of run station-20251231T010000Z"));
}

TEST(SquarenessDocument, TellsUWithItsTerms) {
    const Json document = document_of();
    expect_terms(document,
                 {0.050458333330234056, 0.12513992168768526, 2.42406840554768, 1.39953654647702,
                  0.004516635916254487, 0.35302921922927233},
                 5.648952558742688);
    EXPECT_EQ(document.at("preliminary"), false);
    for (const char* key : {"squareness_end_points", "squareness_minimum_zone"})
        EXPECT_FALSE(document.at("parameters").at(key).contains("expanded_uncertainty")) << key;
}

TEST(SquarenessDocument, WithoutAStatedMountThereIsNoU) {
    SquarenessSetup setup = test::square_setup();
    setup.stated.mount_limit.reset();
    const Json document = document_of(setup);
    EXPECT_EQ(document.at("preliminary"), true);
    EXPECT_EQ(document.at("missing"), Json::array({"how far mirror and square may have turned"}));
    EXPECT_FALSE(
        document.at("parameters").at("squareness_least_squares").contains("expanded_uncertainty"));
    EXPECT_TRUE(has_remark(document, "between the two lines is not stated"));
}

TEST(SquarenessDocument, SaysWhatTheFigureIsAndIsNot) {
    const Json document = document_of();
    for (const char* words :
         {"Positions by the control of the machine",
          "The mirror's form is part of both slopes; its limit stands in the budget.",
          "In no budget: the roll of the prism", "the offset between the places of both lines",
          "The slope of a single line belongs to the set-up"})
        EXPECT_TRUE(has_remark(document, words)) << words;
    EXPECT_FALSE(has_remark(document, "is not stated"));
}

ToleranceRecord limits_in(const std::string& unit, double main_limit) {
    return {"agreed",
            "order 17",
            unit,
            DecisionRule::guard_U,
            false,
            {{"squareness_least_squares", {}, main_limit}, {"squareness_end_points", {}, 20}}};
}

TEST(SquarenessDocument, IsJudgedByItsMagnitude) {
    RunFileContents contents = test::square_contents();
    contents.run.tolerances = limits_in("um/m", 17); // 10.49 + 5.65 <= 17
    const Json document = squareness_to_json(result_of(contents));
    const Json& rows = document.at("verdicts");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("verdict"), "pass");
    EXPECT_EQ(rows[0].at("unit"), "um/m");
    EXPECT_EQ(rows[1].at("verdict"), "not_evaluated"); // it has no U
    contents.run.tolerances = limits_in("um/m", 12);   // 10.49 + 5.65 > 12
    EXPECT_EQ(squareness_to_json(result_of(contents)).at("verdicts")[0].at("verdict"),
              "not_provable");
}

TEST(SquarenessDocument, TakesLimitsInSecondsOfArcAndRefusesLengths) {
    RunFileContents contents = test::square_contents();
    contents.run.tolerances = limits_in("arcsec", 3.4); // 2.16 + 1.17 <= 3.4
    const Json row = squareness_to_json(result_of(contents)).at("verdicts")[0];
    EXPECT_EQ(row.at("verdict"), "pass");
    EXPECT_NEAR(row.at("limit").get<double>(), 3.4 * std::numbers::pi / 0.648, 1e-9);
    contents.run.tolerances = limits_in("um", 17);
    const auto refused = squareness_result_of("s", std::move(contents));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().detail,
              "s has limits of a squareness in um: they must be in um/m or arcsec");
}

TEST(SquarenessDocument, OfAnOpenRunIsPartialAndBearsNoNumber) {
    RunFileContents contents = test::square_contents();
    contents.closed = contents.run.complete = false;
    contents.run.statements.certificate_number = "CAL-{year}";
    contents.run.tolerances = limits_in("um/m", 17);
    contents.run.points.pop_back();
    const SquarenessResult result = result_of(std::move(contents));
    EXPECT_TRUE(result.completeness.partial());
    EXPECT_EQ(result.run.statements.certificate_number, "");
    EXPECT_FALSE(result.conformity);
    EXPECT_EQ(squareness_to_json(result).at("completeness").at("used"), 19);
}

TEST(SquarenessDocument, CsvHoldsEveryDeviationAndBothLines) {
    const std::string csv = squareness_csv(result_of(test::square_contents()));
    const auto holds = [&](const char* words) { return csv.find(words) != std::string::npos; };
    EXPECT_EQ(std::ranges::count(csv, '\n') - std::ranges::count(csv, '#'), 1 + 20);
    EXPECT_TRUE(holds("\r\nforward,100,2,3.")) << csv;
    EXPECT_TRUE(holds("\r\n# parameter,squareness_least_squares,-10.4")) << csv;
    EXPECT_TRUE(holds("\r\n# line,X,Y,normal,station-20251231T010000Z-X,slope 15.3")) << csv;
}

TEST(SquarenessDocument, ARunFileGivesTheSameAndVerifies) {
    const ScratchFolder scratch;
    const std::string path = scratch.file("square.axiscal");
    SquarenessSetup setup = test::square_setup();
    setup.other = test::turned_square();
    test::write_bow(path, test::square_contents(setup));
    const auto first = test::stored_first(path);
    ASSERT_TRUE(first) << describe(first.error());
    const auto again = test::evaluated<SquarenessResult>(path);
    ASSERT_TRUE(again) << describe(again.error());
    EXPECT_EQ(digest_of(*first), again->result_digest);
    const auto report = verify_run(path);
    ASSERT_TRUE(report) << describe(report.error());
    EXPECT_TRUE(report->intact());
    EXPECT_EQ(report->result_digest, again->result_digest);
}

TEST(SquarenessDocument, RefusesLinesOfOtherAxes) {
    SquarenessSetup setup = test::square_setup();
    setup.first.axis = "Z";
    const auto refused = squareness_result_of("s", test::square_contents(setup));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().detail,
              "s holds a line that is not of axis X across Y or the other way round");
    setup = test::square_setup();
    setup.other = test::turned_square();
    std::swap(setup.other->first, setup.other->second);
    EXPECT_FALSE(squareness_result_of("s", test::square_contents(setup)));
}

TEST(SquarenessDocument, RefusesARunWithoutItsSetUpAndARotaryAxis) {
    RunFileContents bare = test::square_contents();
    bare.attachments.setup = TestSetup{};
    EXPECT_EQ(squareness_result_of("r", std::move(bare)).error().detail, "r has no row squareness");
    RunFileContents rotary = test::square_contents();
    rotary.run.plan.axis_kind = AxisKind::rotary;
    EXPECT_EQ(squareness_result_of("r", std::move(rotary)).error().fault, Fault::bad_run_file);
}

} // namespace
} // namespace axiscal::squareness_document_test

// The certificate of a straightness test. The truth is the bow of straightness_run.hpp.
#include "acquisition/documents/straightness/straightness_report.hpp"

#include "acquisition/documents/straightness/straightness_wording.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/documents/straightness_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace axiscal::straightness_report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::ScratchFolder;

StraightnessResult bow_result(const StraightnessSetup& setup = test::bow_setup()) {
    RunFileContents contents = test::bow_contents(setup);
    contents.run.statements = test::synthetic_statements();
    contents.run.statements.axis = "X";
    auto result = straightness_result_of("bow.axiscal", std::move(contents)).value();
    result.run_file_sha256 = std::string(64, 'a');
    return result;
}

/// Paragraphs break where the page ends; a break is a blank here.
std::string words_of(const StraightnessResult& result) {
    const ScratchFolder folder;
    const auto pdf = render_straightness_pdf(result);
    EXPECT_TRUE(pdf) << (pdf ? "" : describe(pdf.error()));
    const std::string text = test::text_of(test::write_pdf(folder, pdf.value_or("")));
    return std::regex_replace(text, std::regex{"\\s+"}, " ");
}

TEST(StraightnessReport, AnswersInOneSentence) {
    EXPECT_EQ(straightness_sentence(bow_result()),
              "Straightness error of the motion of axis X in direction Y, ISO 230-1:2012, "
              "reference: least squares line: 3.97 µm ± 0.25 µm (k = 2). By the line through the "
              "end points 3.95 µm ± 0.25 µm, by the minimum zone 3.95 µm ± 0.25 µm.");
}

TEST(StraightnessReport, PrintsWhatWasMeasuredAndWhatItIsNot) {
    const std::string text = words_of(bow_result());
    for (const char* words :
         {"Certificate of straightness", "E_YX = 3.97 µm ± 0.25 µm",
          "Positions by the control of the machine.",
          "The mirror's form is part of the result; its limit stands in the budget.",
          "no property of the axis", "Wollaston prism", "36, U = 0.5 %, k = 2",
          "prism on the table", "No reading is compensated for the expansion of the axis"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, Not(HasSubstr("PRELIMINARY")));
}

TEST(StraightnessReport, NamesWhatTheBudgetLacks) {
    StraightnessSetup setup = test::bow_setup();
    setup.uncertainty.eve.reset();
    const std::string text = words_of(bow_result(setup));
    EXPECT_THAT(text, HasSubstr("PRELIMINARY, not stated: environment"));
    EXPECT_THAT(text, HasSubstr("3.97 µm, U not evaluated"));
    EXPECT_THAT(text, HasSubstr("E_VE of a drift test with these optics"));
}

TEST(StraightnessReport, NamesAFigureAsPaperDoes) {
    EXPECT_EQ(straightness_name_on_paper("straightness_least_squares"), "least squares");
    EXPECT_EQ(straightness_name_on_paper("straightness_end_points_forward"), "end points ↑");
    EXPECT_EQ(straightness_name_on_paper("straightness_minimum_zone_backward"), "minimum zone ↓");
    EXPECT_EQ(straightness_name_on_paper("straightness_R"), "R");
}

} // namespace
} // namespace axiscal::straightness_report_test

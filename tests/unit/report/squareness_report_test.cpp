// The certificate of a squareness test. The truth is that of squareness_run.hpp.
#include "acquisition/documents/squareness/squareness_report.hpp"

#include "acquisition/documents/squareness/squareness_wording.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/documents/squareness_run.hpp"
#include "upper_third.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace axiscal::squareness_report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ScratchFolder;

RunFileContents paper_contents(const SquarenessSetup& setup = test::square_setup()) {
    RunFileContents contents = test::square_contents(setup);
    contents.run.statements = test::synthetic_statements();
    contents.run.statements.axis = "Y";
    contents.run.instruments = test::synthetic_instruments();
    return contents;
}

SquarenessResult square_result(RunFileContents contents = paper_contents()) {
    auto result = squareness_result_of("square.axiscal", std::move(contents)).value();
    result.run_file_sha256 = std::string(64, 'a');
    return result;
}

SquarenessResult reversed_result() {
    SquarenessSetup setup = test::square_setup();
    setup.other = test::turned_square();
    return square_result(paper_contents(setup));
}

class SquarenessReport : public ::testing::Test {
protected:
    std::string render(const SquarenessResult& result) {
        const auto pdf = render_squareness_pdf(result);
        EXPECT_TRUE(pdf) << (pdf ? "" : describe(pdf.error()));
        return test::write_pdf(folder_, pdf.value_or(""));
    }
    /// Paragraphs break where the page ends; a break is a blank here.
    std::string words(const SquarenessResult& result) {
        return std::regex_replace(test::text_of(render(result)), std::regex{"\\s+"}, " ");
    }
    ScratchFolder folder_;
};

TEST_F(SquarenessReport, AnswersInOneParagraph) {
    EXPECT_EQ(squareness_sentence(square_result()),
              "Squareness of axis Y to axis X, ISO 230-1:2012, reference: least squares line: "
              "−10.49 µm/m ± 5.65 µm/m (k = 2), as an angle −2.16″ ± 1.17″. By other lines, "
              "without U: by the line through the end points −10.61 µm/m, by the minimum zone "
              "−10.61 µm/m; the three lie within 0.12 µm/m.");
}

TEST_F(SquarenessReport, AnswersInTheUpperThirdOfPageOne) {
    RunFileContents contents = paper_contents();
    contents.run.tolerances = ToleranceRecord{"agreed", "order 17",
                                              "um/m",   DecisionRule::guard_U,
                                              false,    {{"squareness_least_squares", {}, 3}}};
    EXPECT_THAT(test::missing_above(render(square_result(std::move(contents))), folder_,
                                    {"Axis Y to axis X", "squareness", "Machining centre MC-800",
                                     "2026-01-01", "FAIL", "10.49", "5.65"}),
                IsEmpty());
}

TEST_F(SquarenessReport, PrintsWhatWasMeasuredAndWhatItIsNot) {
    const std::string text = words(square_result());
    for (const char* expected :
         {"Certificate of squareness", "−10.49 µm/m ± 5.65 µm/m", "as stated 9.70 µm/m (2.00″)",
          "2″, U = 1″, k = 2", "± 0.5″", "Positions by the control of the machine.",
          "The mirror's form is part of both slopes; its limit stands in the budget.",
          "no property of the axis", "Wollaston prism", "36, U = 0.5 %, k = 2",
          "station-20251231T010000Z-X", "15.33", "4.85"})
        EXPECT_THAT(text, HasSubstr(expected));
    EXPECT_THAT(text, Not(HasSubstr("PRELIMINARY")));
}

TEST_F(SquarenessReport, TellsTheErrorOfTheSquareByReversal) {
    const std::string text = words(reversed_result());
    for (const char* expected : {"−10.02 µm/m ± 2.05 µm/m", "by reversal 10.16 µm/m (2.10″)",
                                 "turned", "by reversal, with run station-20251231T030000Z-Y"})
        EXPECT_THAT(text, HasSubstr(expected));
}

TEST_F(SquarenessReport, NamesWhatTheBudgetLacks) {
    SquarenessSetup setup = test::square_setup();
    setup.stated.mount_limit.reset();
    const std::string text = words(square_result(paper_contents(setup)));
    EXPECT_THAT(text, HasSubstr("PRELIMINARY, not stated: mount"));
    EXPECT_THAT(text, HasSubstr("−10.49 µm/m, U not evaluated"));
    EXPECT_THAT(text, HasSubstr("how far mirror and square may have turned"));
}

TEST_F(SquarenessReport, OfAPartialRunBearsNoVerdict) {
    RunFileContents contents = paper_contents();
    contents.closed = contents.run.complete = false;
    contents.run.points.pop_back();
    const std::string text = words(square_result(std::move(contents)));
    EXPECT_THAT(text, HasSubstr("PARTIAL RESULT, no certificate"));
    EXPECT_THAT(text, HasSubstr("PARTIAL: no verdict"));
    EXPECT_THAT(text, Not(HasSubstr("SYNTHETIC-0001")));
}

TEST_F(SquarenessReport, PrintsLimitsInMicrometresForEachMetre) {
    RunFileContents contents = paper_contents();
    contents.run.tolerances = ToleranceRecord{"agreed", "order 17",
                                              "um/m",   DecisionRule::guard_U,
                                              false,    {{"squareness_least_squares", {}, 17}}};
    const SquarenessResult result = square_result(std::move(contents));
    EXPECT_THAT(test::text_of(render(result)),
                ::testing::ContainsRegex("least squares +−10.49 +± 5.65 +17.00"));
    EXPECT_THAT(words(result), HasSubstr("PASS"));
}

TEST_F(SquarenessReport, HasNoWordOverAnotherAndFreeMarginsHoweverMuchIsStated) {
    constexpr int least_margin = 28; // points
    SquarenessResult crowded = reversed_result();
    const std::string tale = "a long text that somebody typed into the station file because it "
                             "could be done, with every detail of the name and the address";
    Statements& said = crowded.run.statements;
    said.machine = said.customer = said.laboratory = said.state = said.operator_name = tale;
    for (const SquarenessResult& result : {square_result(), crowded}) {
        const std::string pdf = render(result);
        EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
        for (int page = 1; page <= test::pages_of(pdf); ++page) {
            const test::PageImage image = test::image_of(pdf, page);
            EXPECT_GT(image.ink(), 300) << "page " << page;
            EXPECT_EQ(image.ink_outside(least_margin), 0) << "page " << page;
        }
    }
}

TEST_F(SquarenessReport, GivesTheSameBytesAgain) {
    const SquarenessResult result = square_result();
    EXPECT_TRUE(render_squareness_pdf(result).value() == render_squareness_pdf(result).value());
}

TEST_F(SquarenessReport, NamesAFigureAsPaperDoes) {
    EXPECT_EQ(squareness_name_on_paper("squareness_least_squares"), "least squares");
    EXPECT_EQ(squareness_name_on_paper("squareness_minimum_zone"), "minimum zone");
}

} // namespace
} // namespace axiscal::squareness_report_test

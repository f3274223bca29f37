// The report of a probing test. The truth is a block whose delays are known (probed_block.hpp).
#include "acquisition/documents/probing/probing_pages.hpp"
#include "acquisition/documents/probing/probing_plot.hpp"
#include "acquisition/documents/probing/probing_report.hpp"
#include "analysis/probing/probing_case.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/documents/probed_block.hpp"
#include "upper_third.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <regex>
#include <sstream>

namespace axiscal::probing_report_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ScratchFolder;

constexpr int least_margin = 28; // points; the narrowest a copier and a hole punch leave
const char* const page_of_panels = "Latched points against the approach distance";

ProbingResult document_of(ProbingRecord record) {
    ProbingResult document;
    auto results = evaluate_probing_delay(case_of(record));
    EXPECT_TRUE(results) << (results ? "" : describe(results.error()));
    document.results = std::move(results).value_or(std::vector<ProbingDelay>{});
    document.record = std::move(record);
    document.run = test::probing_header();
    document.run.statements = test::synthetic_statements();
    document.run.config_hash = std::string(64, 'c');
    document.run_file_sha256 = std::string(64, 'a');
    document.result_digest = std::string(64, 'd');
    return document;
}

std::vector<std::string> split(const std::string& line) {
    std::istringstream in{line};
    return {std::istream_iterator<std::string>{in}, {}};
}

/// The words of the first line that begins with these two.
std::vector<std::string>
row_of(const std::string& text, const std::string& first, const std::string& second) {
    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) {
        auto words = split(line);
        if (words.size() > 2 && words[0] == first && words[1] == second) return words;
    }
    return {};
}

int occurrences(const std::string& text, const std::string& words) {
    int found = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
        ++found;
    return found;
}

/// Paragraphs break where the page ends; a break is a blank here.
std::string in_one_line(const std::string& text) {
    return std::regex_replace(text, std::regex{"\\s+"}, " ");
}

/// Eighteen oblique directions, no references.
ProbingRecord many_directions() {
    ProbingRecord record;
    record.feed_mm_per_min = 1234.5;
    for (int direction = 1; direction <= 18; ++direction)
        for (int i = 0; i < 9; ++i)
            record.touches.push_back({{-1.0 * direction, 1, 1},
                                      false,
                                      mm(2 + 0.0031 * i),
                                      {mm(-0.0123 * (i * i % 7)), mm(0), mm(0)}});
    return record;
}

class ProbingReport : public ::testing::Test {
protected:
    std::string render(const ProbingResult& document) {
        const auto pdf = render_probing_pdf(document);
        EXPECT_TRUE(pdf.has_value()) << (pdf ? "" : describe(pdf.error()));
        return test::write_pdf(folder_, pdf.value_or(""));
    }
    std::string text_of(const ProbingResult& document) { return test::text_of(render(document)); }
    ScratchFolder folder_;
};

TEST_F(ProbingReport, PrintsEachFigureOfTheDelaysThatArePutIn) {
    const std::string text = text_of(document_of(test::probed_block()));
    // s: 0.8 um sqrt(80 / 10), 40 / sqrt(11), sqrt((125 - 625 / 11) / 10)
    EXPECT_THAT(row_of(text, "E_TD,X", "\u2212X"),
                ElementsAre("E_TD,X", "\u2212X", "11", "6.40", "0.800", "U", "not", "evaluated",
                            "2.263", "0.00", "6.40", "1.000"));
    EXPECT_THAT(row_of(text, "E_TD,Y", "\u2212Y"),
                ElementsAre("E_TD,Y", "\u2212Y", "11", "40.00", "5.000", "U", "not", "evaluated",
                            "12.060", "0.00", "40.00", "–"));
    EXPECT_THAT(row_of(text, "E_TD,Z", "\u2212Z"),
                ElementsAre("E_TD,Z", "\u2212Z", "11", "5.00", "0.625", "U", "not", "evaluated",
                            "2.611", "3.00", "4.00", "–"));
    for (const char* symbol : {"E_TD,X", "E_TD,Y", "E_TD,Z"}) // table, saw-tooth, plot
        EXPECT_EQ(occurrences(text, symbol), symbol == std::string{"E_TD,Y"} ? 4 : 3)
            << symbol << "; the largest also below the title";
}

TEST_F(ProbingReport, AnswersInTheUpperThirdOfPageOne) {
    ProbingResult document = document_of(test::probed_block());
    const ToleranceRecord agreed{"acceptance",         "order 17", "um",
                                 DecisionRule::simple, false,      {{"E_TD,X", {}, 1000}}};
    const auto x = std::ranges::find(document.results, "E_TD,X", &ProbingDelay::symbol);
    ASSERT_NE(x, document.results.end());
    document.conformity = conformity_of(agreed, {{"E_TD,X", x->variation_mm, {}, 2}}, "mm");
    EXPECT_THAT(test::missing_above(
                    render(document), folder_,
                    {"Probe", "Machining centre MC-800", "2026-01-01", "PASS", "E_TD,Y = 40.00"}),
                IsEmpty());
}

TEST_F(ProbingReport, TellsTheServoTickAndTheSawToothThatItMakes) {
    const std::string text = in_one_line(text_of(document_of(test::probed_block())));
    EXPECT_THAT(text, HasSubstr("at 480 mm/min the tip moves 8.00 µm in 1 ms"));
    EXPECT_THAT(text, HasSubstr("Saw-tooth found: E_TD,X 1.000 ms (standard uncertainty"));
    EXPECT_THAT(text,
                HasSubstr("E_TD,Y, E_TD,Z: no period is stated: the readings lie on 2 levels"));
}

TEST_F(ProbingReport, TellsWhoProbedWhatAndMarksEachPagePreliminary) {
    const std::string pdf = render(document_of(test::probed_block())), text = test::text_of(pdf);
    for (const char* words : {"Probing test",
                              "ISO 230-10, 6.9",
                              "State: as found",
                              "Example Calibration Laboratory",
                              "SYNTHETIC-0001",
                              "Example customer",
                              "Hall 3, bay 12",
                              "MC-800",
                              "0815-4711",
                              "QP-17",
                              "A. Operator",
                              "B. Approver",
                              "log read 2026-01-01 01:00:00 UTC",
                              "touch-trigger probe, stylus 6 mm",
                              "skip input",
                              "2.0000 to 2.0160 mm",
                              "30 min of full strokes",
                              "station 7",
                              "no instrument took part",
                              "version 0.1.0",
                              "20260101T010000Z-probing"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, HasSubstr(std::string(64, 'a')));
    EXPECT_THAT(text, HasSubstr(std::string(64, 'd')));
    EXPECT_EQ(occurrences(text, "PRELIMINARY: no uncertainty budget"), test::pages_of(pdf));
    EXPECT_THAT(text, Not(HasSubstr(page_of_panels))) << "three directions have room on page 1";
    EXPECT_THAT(text, Not(HasSubstr("not stated")));
    EXPECT_THAT(text, HasSubstr("by ISO 230-10, 6.9¹"));
    EXPECT_THAT(in_one_line(text), HasSubstr("They were not compared with the printed clause."));
    EXPECT_THAT(text, Not(HasSubstr("reconstructed")));
}

TEST_F(ProbingReport, ListsEveryTouchAndMarksTheTwoThatMakeTheVariation) {
    const std::string text = text_of(document_of(test::probed_block()));
    EXPECT_THAT(row_of(text, "22", "\u2212Y"),
                ElementsAre("22", "\u2212Y", "touch", "2.0000", "\u221210.000000", "\u22120.016000",
                            "\u221210.000000", "0.000", "0.000", "smallest"));
    EXPECT_THAT(row_of(text, "28", "\u2212Y"),
                ElementsAre("28", "\u2212Y", "touch", "2.0096", "\u221210.000000", "\u22120.056000",
                            "\u221210.000000", "40.000", "5.000", "largest"));
    EXPECT_THAT(row_of(text, "36", "\u2212Z"), // of the references
                ElementsAre("36", "\u2212Z", "reference", "2.0000", "\u221210.000000",
                            "\u221210.000000", "\u22120.019000", "3.000", "0.375", "largest"));
    EXPECT_FALSE(row_of(text, "48", "\u2212Z").empty());
    EXPECT_TRUE(row_of(text, "49", "\u2212Z").empty());
}

TEST_F(ProbingReport, SaysNotStatedWhereNobodyStatedAnything) {
    ProbingRecord record = test::probed_block();
    record.probe.clear();
    record.signal_path = " ";
    std::erase_if(record.touches, [](const ProbingTouch& touch) { return touch.reference; });
    ProbingResult bare = document_of(record);
    bare.run.statements = {};
    const std::string text = in_one_line(text_of(bare));
    for (const char* words : {"Laboratory not stated", "Probe not stated", "Signal path not stated",
                              "Serial number not stated", "State: not stated"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, HasSubstr("2.263 – – 1.000")) << "no E_0, hence no net variation";
}

TEST_F(ProbingReport, DrawsDirectionsThatHaveNoRoomOnPageOneBehindIt) {
    const std::string pdf = render(document_of(many_directions())), text = test::text_of(pdf);
    EXPECT_EQ(occurrences(text, page_of_panels), 1);
    EXPECT_EQ(occurrences(text, "offset of the latched point"), 18);
    EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
}

TEST_F(ProbingReport, GivesTheSameBytesAgain) {
    const ProbingResult document = document_of(test::probed_block());
    EXPECT_TRUE(render_probing_pdf(document).value() == render_probing_pdf(document).value());
}

TEST_F(ProbingReport, HasNoWordOverAnotherAndFreeMarginsHoweverMuchIsStated) {
    ProbingResult crowded = document_of(test::probed_block());
    const std::string tale = "a long text that somebody typed into the station file because it "
                             "could be done, with every detail of the name and the address";
    Statements& said = crowded.run.statements;
    said.machine = said.customer = said.laboratory = said.state = said.operator_name = tale;
    crowded.record.probe = crowded.record.signal_path = tale;
    ProbingRecord two_touches;
    two_touches.feed_mm_per_min = 1;
    for (int i = 0; i < 2; ++i)
        two_touches.touches.push_back(test::true_touch(2, false, 0));
    ProbingResult bare = document_of(two_touches);
    bare.run.statements = {};
    for (const ProbingResult& document : {document_of(test::probed_block()), crowded, bare}) {
        const std::string pdf = render(document);
        EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
        for (int page = 1; page <= test::pages_of(pdf); ++page) {
            EXPECT_EQ(test::image_of(pdf, page).ink_outside(least_margin), 0) << page;
            EXPECT_GT(test::image_of(pdf, page).ink(), 0) << page;
        }
    }
}

TEST_F(ProbingReport, PrintsInFullBehindWhatPageOneCutShort) {
    ProbingResult document = document_of(test::probed_block());
    std::string probe = "probe";
    for (int i = 0; i < 30; ++i)
        probe += " with extension " + std::to_string(i);
    document.record.probe = probe;
    EXPECT_THAT(in_one_line(text_of(document)), HasSubstr("Probe in full: " + probe));
}

TEST(ProbingPlot, CountsOffsetsFromTheSmallestTouchOfTheDirection) {
    const ProbingResult document = document_of(test::probed_block());
    const auto traces = probing_traces_of(document);
    ASSERT_EQ(traces.size(), 6U); // references and touches of each face
    std::vector<double> tick_um;  // 0.5, 0.3, 0.1, 0.9, 0.7 of a tick, the least of them 0
    for (const int tenths : {5, 3, 1, 9, 7, 5, 3, 1, 9, 7, 5})
        tick_um.push_back(0.8 * (tenths - 1));
    EXPECT_THAT(traces[1].offset_um, ::testing::Pointwise(::testing::DoubleNear(1e-9), tick_um));
    EXPECT_THAT(traces[0].offset_um, ::testing::Each(::testing::DoubleNear(0.8 * 4, 1e-9)));
    EXPECT_NEAR(traces[4].offset_um[1], 3, 1e-9);
    EXPECT_EQ(traces[4].first_touch, 32U);
}

TEST(ProbingPlot, PutsTheReferencesOfADirectionBesideItsTouches) {
    const ProbingResult document = document_of(test::probed_block());
    const auto traces = probing_traces_of(document);
    const auto panels = probing_panels_of(traces);
    ASSERT_EQ(panels.size(), 3U);
    EXPECT_EQ(panels[2].touches, &traces[5]);
    EXPECT_THAT(panels[2].references, ElementsAre(&traces[4]));
}

TEST(ProbingWords, NameADirectionByItsAxisOrItsParts) {
    EXPECT_EQ(direction_text({-1, 0, 0}), "\u2212X");
    EXPECT_EQ(direction_text({0, 1, 0}), "+Y");
    EXPECT_EQ(direction_text({0.6, 0, -0.8}), "(0.600, 0.000, \u22120.800)");
}

TEST(ProbingWords, TellWhyNoSawToothWasFoundOnceForEachReason) {
    std::vector<ProbingDelay> results(4);
    results[0].symbol = "E_0,X", results[0].reference = true, results[0].no_period = "constant";
    results[1].symbol = "E_TD,X", results[1].no_period = "fewer than 5 readings";
    results[2].symbol = "E_TD,Y", results[2].period_ms = 4;
    results[2].period_standard_uncertainty_ms = 0.0121;
    results[3].symbol = "E_TD,Z", results[3].no_period = "fewer than 5 readings";
    EXPECT_THAT(saw_tooth_words(results),
                ElementsAre("Saw-tooth found: E_TD,Y 4.000 ms (standard uncertainty 0.013 ms). "
                            "The control latches at ticks of its own, that far apart.",
                            "E_TD,X, E_TD,Z: no period is stated: fewer than 5 readings."));
}

} // namespace
} // namespace axiscal::probing_report_test

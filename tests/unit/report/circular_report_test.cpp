// The certificate of a circular test as its reader holds it.

#include "acquisition/documents/circular/circular_report.hpp"
#include "acquisition/documents/circular/circular_wording.hpp"
#include "pdf_tools.hpp"
#include "synthetic_circular.hpp"
#include "upper_third.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace axiscal::circular_report_test {
namespace {

using test::bare_measurement;
using test::certificate_of;
using test::circular_certificate;
using test::circular_run;
using test::circular_test;
using test::circular_truth;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ScratchFolder;

int occurrences(const std::string& text, const std::string& words) {
    int found = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
        ++found;
    return found;
}

CircularCertificate unstated() {
    return certificate_of(bare_measurement(circular_test(circular_truth(), 1)));
}

CircularCertificate feedback() {
    CircularMeasurement measured = bare_measurement(circular_test(circular_truth(), 1));
    measured.test.source = SignalSource::feedback;
    return certificate_of(std::move(measured));
}

CircularCertificate arc() {
    return certificate_of(bare_measurement(circular_test(circular_truth(), 1, -20, 220)));
}

CircularCertificate overflowing() {
    CircularRun run = circular_run();
    const std::string tale = "a long text that somebody typed into the station file because it "
                             "could be done, with every detail of the name and the address";
    Statements& said = run.statements;
    said.machine = said.customer = said.laboratory = said.state = said.operator_name =
        said.control_compensation = said.idle_axes = said.place = said.procedure = tale;
    run.plan.tool_offset = run.plan.work_offset = run.bar_temperature.channel = tale;
    said.certificate_number = std::string(90, '7');
    for (int i = 0; i < 6; ++i) {
        run.instruments.push_back(run.instruments.front());
        run.instruments.back().model = tale;
    }
    for (int i = 0; i < 60; ++i)
        run.events.push_back({EventKind::note, {}, run.opened.utc_ns, tale, Fault::none, 0});
    return circular_certificate(std::move(run));
}

class CircularReport : public ::testing::Test {
protected:
    std::string render(const CircularCertificate& certificate) {
        const auto pdf = render_circular_pdf(certificate);
        EXPECT_TRUE(pdf.has_value()) << (pdf ? "" : describe(pdf.error()));
        return test::write_pdf(folder_, pdf.value_or(""));
    }
    std::string text(const CircularCertificate& certificate) {
        return test::text_of(render(certificate));
    }
    ScratchFolder folder_;
};

TEST_F(CircularReport, HoldsEveryFigureWithItsU) {
    const CircularCertificate certificate = circular_certificate();
    const std::string page = text(certificate);
    const auto lines = figure_lines(certificate);
    ASSERT_EQ(lines.size(), 8u);
    for (const CircularFigureLine& line : lines) {
        EXPECT_THAT(page, HasSubstr(micrometres(line.value_mm, 1))) << line.key;
        EXPECT_THAT(page, HasSubstr(line.words));
        EXPECT_THAT(page, HasSubstr(uncertainty_text(certificate, line.key))) << line.key;
    }
    EXPECT_THAT(page, HasSubstr("± U (k = 2)"));
    EXPECT_EQ(occurrences(page, "not evaluated"), 0);
    EXPECT_EQ(occurrences(page, "PRELIMINARY"), 0);
    EXPECT_THAT(page, HasSubstr(std::string(64, 'a')));
    EXPECT_THAT(page, HasSubstr("Calibration certificate"));
}

TEST_F(CircularReport, AnswersInTheUpperThirdOfPageOne) {
    CircularRun run = circular_run();
    run.tolerances = ToleranceRecord{"acceptance",          "order 17", "um",
                                     DecisionRule::guard_U, false,      {{"G_b", {}, 0.1}}};
    const CircularCertificate certificate = circular_certificate(std::move(run));
    const auto lines = figure_lines(certificate);
    const auto line = std::ranges::find(lines, "G_b", &CircularFigureLine::key);
    ASSERT_NE(line, lines.end());
    const std::string value = micrometres(line->value_mm, deviation_decimals(certificate));
    EXPECT_THAT(test::missing_above(render(certificate), folder_,
                                    {"Plane XY", certificate.measured.run.statements.machine,
                                     "2026-01-01", "FAIL", value}),
                IsEmpty());
}

TEST_F(CircularReport, StatesTheMagnificationOfEveryPlot) {
    const std::string page = text(circular_certificate());
    const std::string before = "1 division = ", between = " µm, magnification ";
    int plots = 0;
    for (auto at = page.find(before); at != std::string::npos; at = page.find(before, at + 1)) {
        ++plots;
        const double division_um = std::stod(page.substr(at + before.size()));
        const auto told = page.find(between, at) + between.size();
        EXPECT_DOUBLE_EQ(division_um * std::stod(page.substr(told)), 10'000) << "10 mm of paper";
        EXPECT_EQ(page.substr(page.find(':', told), 2), ":1");
    }
    EXPECT_EQ(plots, 3) << "both senses together and each by itself";
    EXPECT_EQ(occurrences(page, "Control points of"), 3);
}

TEST_F(CircularReport, HoldsWhatTheStandardWantsTold) {
    const std::string page = text(circular_certificate());
    for (const char* words : {"300 mm",
                              "1000 mm/min",
                              "CCW turns +X to +Y",
                              "X 400, Y 250.5, Z −120 mm",
                              "120 mm from the spindle",
                              "80 mm above the table",
                              "into quadrant 1",
                              "out of quadrant 4",
                              "into quadrant 4",
                              "901",
                              "1000 Hz",
                              "not stated", // a filter
                              "pitch and backlash on",
                              "Z 300 mm",
                              "22.40 °C (22.30 to 22.50; bar)",
                              "23.10 °C (23.00 to 23.20; table)",
                              "21.70 °C",
                              "2026-01-01",
                              "MC-800",
                              "B-0042",
                              "2 of each sense",
                              "1 of each sense",
                              "180°",
                              "radial, 1.5 mm from",
                              "150.0123 mm",
                              "11.5 µm/(m·K)"})
        EXPECT_THAT(page, HasSubstr(words));
}

TEST_F(CircularReport, SaysWhatAveragingAndFilterDoToG) {
    CircularRun run = circular_run();
    run.capture.averaged = 4;
    run.capture.low_pass_hz = 40;
    const std::string page = text(circular_certificate(std::move(run)));
    EXPECT_THAT(page, HasSubstr("What averaging and filter do to G"));
    EXPECT_THAT(page, HasSubstr("Amplitude left"));
    EXPECT_THAT(page, HasSubstr("97.63")) << "of 500 undulations: 8.84 Hz";
    EXPECT_THAT(page, Not(HasSubstr("states neither averaging")));
}

/// What nobody stated may have been done all the same; and of two circles the mean is evaluated.
TEST_F(CircularReport, SaysOfWhichReadingsGIsWhereNeitherAveragingNorFilterIsStated) {
    const auto words_of = [this](int repeats) {
        CircularRun run = circular_run();
        run.plan.repeats = repeats;
        return std::regex_replace(text(circular_certificate(std::move(run))), std::regex{"\\s+"},
                                  " ");
    };
    const std::string of_two = words_of(2), of_one = words_of(1);
    for (const std::string& words : {of_two, of_one}) {
        EXPECT_THAT(words, HasSubstr("The station file states neither averaging nor a filter of "
                                     "the bar's electronics."));
        EXPECT_THAT(words, Not(HasSubstr("othing was averaged")));
        const auto filter = words.find("Filter, averaging ");
        ASSERT_NE(filter, std::string::npos);
        EXPECT_THAT(words.substr(filter, 70), HasSubstr("not stated"));
    }
    EXPECT_THAT(of_two, HasSubstr("G is that of the mean circle of 2 of each sense"));
    EXPECT_THAT(of_one, HasSubstr("G is that of the readings."));
    EXPECT_THAT(of_one, Not(HasSubstr("that of the mean circle")));
}

TEST_F(CircularReport, SaysNotStatedForEveryEmptyField) {
    const std::string page = text(unstated());
    for (const char* key : {"Laboratory",
                            "Customer",
                            "Place",
                            "Machine",
                            "Maker",
                            "Serial number",
                            "Procedure",
                            "Certificate number",
                            "Measured",
                            "Issued on",
                            "Control compensation",
                            "Centre X, Y, Z",
                            "Offset to the tool reference",
                            "Positions of idle axes",
                            "Offset to the workpiece reference",
                            "Filter, averaging",
                            "Sampling rate",
                            "Angle of a reading",
                            "Warm-up",
                            "Air",
                            "Instrument (bar)",
                            "Operator",
                            "Approver"}) {
        const auto at = page.find(std::string{key} + " ");
        ASSERT_NE(at, std::string::npos) << key;
        EXPECT_THAT(page.substr(at, 70), HasSubstr("not stated")) << key;
    }
    EXPECT_THAT(page, HasSubstr("Instruments: not stated"));
    EXPECT_THAT(page, HasSubstr("Report of a circular test")) << "no run file stands behind it";
    EXPECT_THAT(page, HasSubstr("not taken by this station"));
}

TEST_F(CircularReport, WithoutABudgetIsPreliminaryOnEachPage) {
    const std::string pdf = render(unstated()), page = test::text_of(pdf);
    const int pages = test::pages_of(pdf);
    EXPECT_GE(pages, 4);
    EXPECT_EQ(occurrences(page, "PRELIMINARY: no uncertainty budget"), pages);
    EXPECT_EQ(occurrences(page, "U not evaluated"), 9) << "each figure, and G(b) below the title";
    EXPECT_THAT(page, Not(HasSubstr("Derived by these rules")));
    for (int number = 1; number <= pages; ++number)
        EXPECT_EQ(
            occurrences(page, "page " + std::to_string(number) + " of " + std::to_string(pages)),
            1);
}

TEST_F(CircularReport, ExplainsTheFootnoteWhereATermHasItsSign) {
    const auto explains = [this](CircularRun run) {
        const std::string page = text(circular_certificate(std::move(run)));
        return std::regex_search(page, std::regex{R"(Derived\s+by\s+these\s+rules)"});
    };
    CircularRun run = circular_run();
    EXPECT_TRUE(explains(run));
    run.uncertainty = {}; // what the repeats tell stands in the source
    EXPECT_FALSE(explains(std::move(run)));
}

TEST_F(CircularReport, LeavesUOfThoseFiguresOutWhoseTermsAreMissing) {
    CircularRun run = circular_run();
    run.machine_temperature = {};
    const CircularCertificate certificate = circular_certificate(run);
    const std::string page = text(certificate);
    EXPECT_EQ(occurrences(page, "U not evaluated"), 5) << "F and D; G needs no temperature";
    EXPECT_THAT(page, HasSubstr("PRELIMINARY, not stated: machine temperature"));
    EXPECT_THAT(page, HasSubstr("F and D stand as measured"));
    EXPECT_NE(certificate.uncertainty_of("G_ccw"), nullptr);
    EXPECT_EQ(certificate.uncertainty_of("D"), nullptr);
}

TEST_F(CircularReport, TellsEachCauseWithItsSignInWordsAndWhatToDo) {
    std::string page = text(circular_certificate());
    page.erase(std::remove(page.begin(), page.end(), '\n'), page.end());
    for (const char* words :
         {"Squareness of X and Y", "Backlash X", "Backlash Y", "Servo mismatch",
          "Scale mismatch of X and Y", "What a technician does first", "preload of nut",
          "backlash compensation", "lost motion; below 0 gained", "X lags Y",
          "enclose more than 90°", "Rank"})
        EXPECT_THAT(page, HasSubstr(words));
    EXPECT_THAT(page, Not(HasSubstr(" um "))) << "paper writes µm";
    EXPECT_THAT(text(certificate_of(test::one_sense(1, Sense::ccw))), HasSubstr("not told apart"));
}

TEST_F(CircularReport, PrintsALagInTheUnitThatLeavesANumber) {
    const test::CircleTruth small{{"servo", 2.184e-8}};
    const std::string page =
        text(certificate_of(bare_measurement(circular_test(small, 1, 0, 360, 0))));
    EXPECT_TRUE(std::regex_search(page, std::regex{R"(Lag difference\s+21\.8\d\s+\d+\.\d\d\s+ns)"}))
        << page;
    EXPECT_FALSE(std::regex_search(page, std::regex{R"(\d us\b)"})) << page;
}

TEST_F(CircularReport, OfOneSenseGivesReasonsForTheRest) {
    const std::string page = text(certificate_of(test::one_sense(1, Sense::cw)));
    EXPECT_THAT(page, HasSubstr("Not evaluated: G XY, G(b), F max XY, F min XY, D"));
    EXPECT_EQ(occurrences(page, "magnification"), 2) << "page 1 and the sense itself";
}

TEST_F(CircularReport, NamesFeedbackSignals) {
    const std::string page = text(feedback());
    EXPECT_THAT(page, HasSubstr("Gf"));
    EXPECT_THAT(page, HasSubstr("feedback signals"));
    EXPECT_THAT(page, Not(HasSubstr("F max XY =")));
}

TEST_F(CircularReport, GivesEqualBytesForEqualRunsAndForCasesWithoutADate) {
    const auto first = render_circular_pdf(circular_certificate());
    const auto again = render_circular_pdf(circular_certificate());
    const auto other = render_circular_pdf(circular_certificate(circular_run(9)));
    ASSERT_TRUE(first && again && other);
    EXPECT_TRUE(*first == *again);
    EXPECT_FALSE(*first == *other) << "the test must be able to fail";
    EXPECT_EQ(test::made_on(test::write_pdf(folder_, *first)), "20260101010000Z")
        << "the end of the run, not the clock";
    const auto undated = render_circular_pdf(unstated());
    ASSERT_TRUE(undated);
    EXPECT_EQ(test::made_on(test::write_pdf(folder_, *undated)), "");
}

TEST_F(CircularReport, EmbedsDejaVuSansAndNothingElse) {
    std::istringstream fonts{test::output_of("pdffonts '" + render(overflowing()) + "'")};
    std::string line;
    std::getline(fonts, line); // head
    std::getline(fonts, line); // rule
    int found = 0;
    while (std::getline(fonts, line)) {
        ++found;
        EXPECT_THAT(line, HasSubstr("+DejaVuSans"));
        EXPECT_THAT(line, HasSubstr(" yes yes yes "));
    }
    EXPECT_GE(found, 2);
}

TEST_F(CircularReport, KeepsInkInsideTheMarginsAndWordsApart) {
    constexpr int least_margin = 28; // points; the narrowest a copier and a hole punch leave
    for (const CircularCertificate& certificate :
         {circular_certificate(), unstated(), feedback(), arc(), overflowing(),
          certificate_of(test::one_sense(2, Sense::cw))}) {
        const std::string pdf = render(certificate);
        const auto words = test::words_of(pdf);
        EXPECT_GT(words.size(), 300u);
        EXPECT_THAT(test::collisions_in(words), IsEmpty());
        for (int page = 1; page <= test::pages_of(pdf); ++page) {
            const test::PageImage image = test::image_of(pdf, page);
            EXPECT_GT(image.ink(), 300) << "page " << page;
            EXPECT_EQ(image.ink_outside(least_margin), 0) << "page " << page;
        }
    }
}

TEST_F(CircularReport, ShowsTheRepeatsAndEveryCircleDriven) {
    const std::string page = text(circular_certificate());
    EXPECT_THAT(page, HasSubstr("Circle 2"));
    EXPECT_EQ(occurrences(page, "warm-up"), 2) << "one of each sense";
    EXPECT_THAT(page, HasSubstr("feed-in step"));
}

TEST_F(CircularReport, SaysWhichDriftTestItsEveIsOf) {
    CircularRun run = test::circular_run();
    run.uncertainty.eve_um = 0.4;
    EXPECT_EQ(occurrences(text(circular_certificate(run)), "drift test"), 0);
    run.eve_source = "bay3-20261121T100000Z-XY-ballbar-drift";
    const std::string pdf = render(circular_certificate(std::move(run)));
    EXPECT_THAT(test::text_of(pdf), HasSubstr("E_VE is the range of the drift test "
                                              "bay3-20261121T100000Z-XY-ballbar-drift."));
    EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
}

TEST_F(CircularReport, PrintsTheCertificatesOfChannels) {
    CircularRun run = test::circular_run();
    run.channels.push_back({5, "table", "t", "", ChannelKind::temperature, Medium::material});
    ChannelCalibration table;
    table.channel = 5, table.certificate_number = "T-551", table.due_on = "2025-12-31";
    table.expanded_uncertainty = 0.08;
    EXPECT_EQ(occurrences(text(circular_certificate(run)), "Certificates of channels"), 0);
    run.calibrations = {table};
    const std::string page = text(circular_certificate(std::move(run)));
    for (const char* words : {"Certificates of channels", "T-551", "2025-12-31 (expired)", "0.08"})
        EXPECT_THAT(page, HasSubstr(words));
}

TEST(CircularWording, WritesSentencesInTheSignsOfPaper) {
    EXPECT_EQ(sentence_on_paper("enclose 22 urad (4.5 arcsec) more than 90 deg: at 135/315 deg,"),
              "enclose 22 µrad (4.5″) more than 90°: at 135/315°,");
    EXPECT_EQ(sentence_on_paper("loses 3.2 um when; 20 um/m; 0.5 per degree; toward -X"),
              "loses 3.2 µm when; 20 µm/m; 0.5 per degree; toward −X");
    EXPECT_EQ(sentence_on_paper("X lags Y by 25 us: an"), "X lags Y by 25 µs: an");
    EXPECT_EQ(sentence_on_paper("at 180 deg in sense cw the trace"), "at 180° clockwise the trace");
}

TEST(CircularWording, NamesTheQuadrantThatATraceGoesIntoAndComesOutOf) {
    const double degree_rad = test::one_degree;
    const CircularTrace ccw{Sense::ccw, {0, 1, 359.5 * degree_rad}, {0, 0, 0}};
    EXPECT_EQ(start_text(ccw), "0.00°, into quadrant 1");
    const CircularTrace turned{Sense::cw, {(360 - 1e-9) * degree_rad, 1, 0}, {0, 0, 0}};
    EXPECT_EQ(start_text(turned), "0.00°, into quadrant 4");
    EXPECT_EQ(end_text(ccw), "359.50°, out of quadrant 4");
    const CircularTrace cw{Sense::cw, {0, -1, -270 * degree_rad}, {0, 0, 0}};
    EXPECT_EQ(start_text(cw), "0.00°, into quadrant 4");
    EXPECT_EQ(end_text(cw), "90.00°, out of quadrant 2");
}

} // namespace
} // namespace axiscal::circular_report_test

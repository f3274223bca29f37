#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/positioning/report.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/analysis/linear_scale_run.hpp"
#include "tests/unit/analysis/rotary_truth.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"
#include "upper_third.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace axiscal::report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ScratchFolder;

constexpr int least_margin = 28; // points; the narrowest a copier and a hole punch leave

int count(const std::string& text, const std::string& words) {
    int found = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
        ++found;
    return found;
}

/// Fields are set wide apart; a blank between their words is one here.
std::string close_set(const std::string& text) {
    return std::regex_replace(text, std::regex{" +"}, " ");
}

/// The row of a parameter in a text that is close set: symbol, words and value in one line.
std::string row_of(const ParameterLine& line, double units_a_mm_or_degree) {
    return std::string{line.symbol} + " " + std::string{line.words} + " " +
           fixed(*line.value * units_a_mm_or_degree, 1) + " ";
}

RunRecord run_without_words() {
    RunRecord run = test::synthetic_run();
    run.statements = {};
    run.material.feedback.clear();
    for (ChannelRecord& channel : run.channels)
        channel.place.clear();
    for (InstrumentRecord& instrument : run.instruments)
        instrument = {instrument.name, "", "", "", "", "", "", "", ""};
    return run;
}

/// 101 targets, 8 instruments, 8 material sensors and texts as long as people write them.
RunRecord run_that_overflows() {
    RunRecord run = test::synthetic_run();
    const std::string tale = "a long text that somebody typed into the station file because it "
                             "could be done, with every detail of the name and the address";
    run.statements.machine = run.statements.customer = run.statements.laboratory =
        run.statements.offsets = run.statements.state = run.statements.operator_name = tale;
    run.statements.certificate_number = std::string(90, '7');
    for (int i = 0; i < 5; ++i) {
        run.instruments.push_back(run.instruments[1]);
        run.instruments.back().model = tale;
        run.instruments.back().serial = std::string(40, '8');
    }
    run.plan.targets.clear();
    run.plan.points.clear();
    run.points.clear();
    for (int i = 0; i < 101; ++i)
        run.plan.targets.push_back(mm(i * 10 + 0.137 * (i % 7)));
    for (const Direction direction : {Direction::positive, Direction::negative})
        for (int approach = 0; approach < 5; ++approach)
            for (int i = 0; i < 101; ++i)
                run.plan.points.push_back(
                    {static_cast<int>(run.plan.points.size()), i, direction, approach});
    run.environment.clear();
    for (int i = 6; i < 12; ++i)
        run.channels.push_back(
            {i, "column " + tale, "mat", tale, ChannelKind::temperature, Medium::material, 0.02});
    const test::Truth truth = test::synthetic_truth(3);
    for (double s = 0; s < 21000; s += 60)
        for (const ChannelRecord& channel : run.channels)
            run.environment.push_back({channel.id, test::at_seconds(s),
                                       channel.kind == ChannelKind::pressure ? truth.pressure_Pa(s)
                                       : channel.kind == ChannelKind::humidity
                                           ? truth.humidity_percent(s)
                                           : truth.material_C(s)});
    test::add_points(run, truth);
    for (int i = 0; i < 60; ++i)
        run.events.push_back(
            {EventKind::refused, test::at_seconds(100 + i * 30), 0, tale, Fault::not_still, 0});
    return run;
}

/// As many approaches as wanted, one direction or both.
RunRecord run_of(int approaches, bool bidirectional) {
    RunRecord run = test::synthetic_run();
    run.plan.approaches = approaches;
    run.plan.bidirectional = bidirectional;
    run.plan.points.clear();
    for (int approach = 0; approach < approaches; ++approach)
        for (const Direction direction : {Direction::positive, Direction::negative})
            for (int i = 0; i < static_cast<int>(run.plan.targets.size()); ++i)
                if (bidirectional || direction == Direction::positive)
                    run.plan.points.push_back(
                        {static_cast<int>(run.plan.points.size()), i, direction, approach});
    for (double s = 2330; s < 9000; s += 30) // the longer plans outlast the readings
        for (const ChannelRecord& channel : run.channels) {
            const auto last = std::ranges::find_if(run.environment, [&](const auto& reading) {
                return reading.channel == channel.id;
            });
            run.environment.push_back({channel.id, test::at_seconds(s), last->value});
        }
    run.points.clear();
    test::add_points(run, test::synthetic_truth(1));
    return run;
}

/// Everything stated; U(R) = 2.06 um misses its target, U(B) = 0.62 um keeps it.
RunRecord stated_run() {
    RunRecord run = test::synthetic_run();
    run.uncertainty = test::stated_uncertainty();
    run.uncertainty->targets = {{"R", um(2)}, {"B", um(2)}};
    return run;
}

class Report : public ::testing::Test {
protected:
    /// Path of the rendered file.
    std::string render(RunRecord run, RunRevisions revisions = {}) {
        const auto pdf =
            render_certificate_pdf(test::certificate_of(std::move(run), std::move(revisions)));
        EXPECT_TRUE(pdf.has_value()) << (pdf ? "" : describe(pdf.error()));
        return test::write_pdf(folder_, pdf.value_or(""));
    }
    ScratchFolder folder_;
};

TEST_F(Report, OfImportedReadingsClaimsNoTraceability) {
    RunRecord run = test::synthetic_run();
    run.instruments.clear();
    run.imported = ImportedReadings{"x.rtl", "Laser10 text", std::string(64, 'a'), "", ""};
    const std::string text = close_set(test::text_of(render(run)));
    EXPECT_THAT(text, HasSubstr("Instruments: not stated"));
    EXPECT_THAT(text, HasSubstr("Traceability: not stated"));
    EXPECT_THAT(text, Not(HasSubstr("instruments named above")));
}

TEST_F(Report, OfALinearScaleNamesItAndSaysNothingOfAir) {
    RunRecord run = test::run_by_scale({});
    run.scale->standard_uncertainty = um_per_m_kelvin(0.5);
    run.scale->temperature_width = kelvin(0.5);
    run.uncertainty = test::stated_uncertainty();
    const std::string text = test::text_of(render(run));
    for (const char* words :
         {"Reference", "linear scale, 0.1000 µm a count", "Nothing is corrected for air",
          "Coefficient β of the scale", "8.50 µm/(m·K), standard uncertainty", "26.50 → 26.50 °C",
          "Temperature of the scale", "Misalignment of the scale"})
        EXPECT_THAT(text, HasSubstr(words));
    for (const char* words : {"Refractivity", "Vacuum wavelength", "Dead path", "Laser system"})
        EXPECT_THAT(text, Not(HasSubstr(words)));
}

TEST_F(Report, HoldsEverySymbolAndItsValue) {
    const Certificate certificate = test::certificate_of(test::synthetic_run());
    const std::string text = close_set(test::text_of(render(test::synthetic_run())));
    const PositioningParameters& p = certificate.result.parameters;
    std::set<std::string> values;
    for (const auto& lines : {parameters_of_both_directions(p), parameters_of_one_direction(p)})
        for (const ParameterLine& line : lines) {
            EXPECT_EQ(count(text, row_of(line, 1000) + "U not evaluated"), 1)
                << row_of(line, 1000) << "\n"
                << text;
            values.insert(fixed(*line.value * 1000, 1));
        }
    EXPECT_GE(values.size(), 8U) << "rows with one value could change places unseen";
    EXPECT_EQ(count(text, "U not evaluated"), 13) << "each row, and A below the title";
    for (const char* words :
         {"B\u0304 = mean forward minus mean backward", "actual − target", "ISO 230-2:2014",
          "20 °C", "Ciddor", "QP-17", "L-0042", "C-2025-118", "2026-09-30", "0815-4711",
          "30 min of full strokes", "Z 250 mm", "seed 4711", "2027-01-01", "State: as found"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, HasSubstr(certificate.run_file_sha256));
    EXPECT_THAT(text, HasSubstr("version 0.1.0"));
}

TEST_F(Report, NumbersPagesAndMarksEachPreliminary) {
    const std::string pdf = render(test::synthetic_run());
    const int pages = test::pages_of(pdf);
    EXPECT_EQ(pages, 4);
    const std::string text = test::text_of(pdf);
    for (int page = 1; page <= pages; ++page)
        EXPECT_EQ(count(text, "page " + std::to_string(page) + " of " + std::to_string(pages)), 1);
    EXPECT_EQ(count(text, "PRELIMINARY"), pages);
}

TEST_F(Report, OfACompleteBudgetIsFinalAndPrintsUOfEachParameter) {
    const std::string text = test::text_of(render(stated_run()));
    EXPECT_EQ(count(text, "not evaluated"), 0);
    EXPECT_EQ(count(text, "PRELIMINARY"), 0);
    EXPECT_EQ(count(text, "Preliminary"), 0);
    EXPECT_THAT(text, HasSubstr("± U (k = 2)"));
    const Certificate certificate = test::certificate_of(stated_run());
    const PositioningParameters& p = certificate.result.parameters;
    for (const auto& lines : {parameters_of_both_directions(p), parameters_of_one_direction(p)})
        for (const ParameterLine& line : lines) {
            const auto* figure = certificate.uncertainty.budget->find(line.key);
            ASSERT_TRUE(figure) << line.key;
            EXPECT_THAT(close_set(text),
                        HasSubstr(row_of(line, 1000) + "± " + fixed_up(figure->expanded, 1)));
        }
    EXPECT_GE(count(text, "± 2.1"), 1) << "U(R) = 1.7 sqrt(4.4 / 3) = 2.0588 um, rounded up";
    for (const char* words : {"Measurement uncertainty", "L = 953.000 mm", "U_cal = 0.7 µm/m",
                              "e = 1 mm", "R(θ) = 0.7 K", "E_VE = 1.7 µm", "ΔT = 3.2", "2.059"})
        EXPECT_THAT(text, HasSubstr(words));
}

TEST_F(Report, PrintsTheSimulatedUBesideTheFormula) {
    const std::string text = test::text_of(render(stated_run()));
    for (const char* words :
         {"u by formula", "u simulated", "100000 sessions", "seed 4711", "above the simulated one"})
        EXPECT_THAT(text, HasSubstr(words));
    const Certificate certificate = test::certificate_of(stated_run());
    for (const MonteCarloFigure& figure : certificate.uncertainty.simulation->figures)
        EXPECT_THAT(text, HasSubstr(fixed(figure.u * 1000, 3))) << figure.key;
    EXPECT_THAT(test::text_of(render(test::synthetic_run())), Not(HasSubstr("simulated")));
}

TEST_F(Report, PrintsWhereTheTrueFiguresLie) {
    const auto without_blanks = [](const std::string& words) { // lines end where they are full
        return std::regex_replace(words, std::regex{"\\s+"}, "");
    };
    const std::string text = without_blanks(test::text_of(render(stated_run())));
    const Certificate certificate = test::certificate_of(stated_run());
    for (const TrueFigure& figure : certificate.uncertainty.true_figures->figures) {
        const std::string ends = "from" + fixed(figure.interval.low * 1000, 3) + "to" +
                                 fixed(figure.interval.high * 1000, 3);
        EXPECT_THAT(text, HasSubstr(ends)) << figure.key;
    }
    EXPECT_THAT(text, HasSubstr(without_blanks("A beam off the axis can only read short.")));
    EXPECT_THAT(test::text_of(render(test::synthetic_run())), Not(HasSubstr("true figures")));
}

TEST_F(Report, StatesTheLargestSynchronisationErrorInWords) {
    Certificate certificate = test::certificate_of(test::synthetic_run());
    EXPECT_THAT(synchronisation_text(certificate), HasSubstr("not stated"));
    auto& records = certificate.attachments.synchronisation;
    records = {{3, "serial/0/1", Synchronisation{std::chrono::microseconds{7}, 0.01234}},
               {4, "serial/0/1", Synchronisation{std::chrono::microseconds{90}, 0.002}},
               {5, "serial/0/1", std::nullopt}};
    const std::string text =
        test::text_of(test::write_pdf(folder_, *render_certificate_pdf(certificate)));
    EXPECT_THAT(text, HasSubstr("at most 0.0124 µm (at point 4)")); // rounded up
    EXPECT_THAT(synchronisation_text(certificate), HasSubstr("Not stated for 109 of 111"));
    records = {{-1, "serial/0/1", Synchronisation{std::chrono::microseconds{7}, 1e-6}}};
    EXPECT_THAT(synchronisation_text(certificate), HasSubstr("less than 0.0001 µm (at the datum)"));
}

/// One millimetre of an autocollimator's reading stands for a degree: a micrometre for 3.6".
TEST_F(Report, StatesTheLargestSynchronisationErrorOfAnAutocollimatorInSecondsOfArc) {
    Certificate certificate = test::certificate_of(test::polygon_run());
    auto& records = certificate.attachments.synchronisation;
    records = {{3, "serial/0/1", Synchronisation{std::chrono::milliseconds{30}, 0.01}}};
    const std::string text =
        test::text_of(test::write_pdf(folder_, *render_certificate_pdf(certificate)));
    EXPECT_THAT(text, HasSubstr("at most 0.0360″ of the autocollimator's reading"));
    records.front().stated->error_um = 5e-5; // 0.00018": four decimals can show that
    EXPECT_THAT(synchronisation_text(certificate), HasSubstr("at most 0.0002″"));
    records.front().stated->error_um = 2e-5; // 0.000072"
    EXPECT_THAT(synchronisation_text(certificate), HasSubstr("less than 0.0001″"));
    certificate.run.rotary->method = AngleMethod::indexing_table;
    EXPECT_THAT(synchronisation_text(certificate),
                HasSubstr("less than 0.0001 µm of the interferometer's reading"));
}

TEST_F(Report, SaysHowTheBeamWasAligned) {
    Certificate certificate = test::certificate_of(test::synthetic_run());
    const auto text = [&] {
        return test::text_of(test::write_pdf(folder_, *render_certificate_pdf(certificate)));
    };
    EXPECT_THAT(text(), HasSubstr("not recorded"));
    AlignmentRecord& alignment = certificate.attachments.alignment.emplace();
    alignment.travel = mm(1000), alignment.reached = mm(998.4);
    alignment.far = FarRest{mm(998.4), um(41.3), um(40.05), um(0.06), 90, true};
    alignment.places = {{mm(0), mm(40), 9, 88, 90, 91}, {mm(960), mm(1000), 9, 63, 71, 72}};
    alignment.spot_offset = mm(2);
    for (const char* words : {"Travel seen", "998.4 mm of 1000.0 mm", "90 % near, 71 % far",
                              "weakest 63 % at 960 to 1000 mm", "1.25 µm below the highest",
                              "1.25 µm over 998 mm, at most 1.31 µm", "return spot (2.00 mm)"})
        EXPECT_THAT(text(), HasSubstr(words));
    EXPECT_EQ(count(text(), "not recorded"), 0);
    alignment.far->passed_maximum = false;
    alignment.places.clear();
    EXPECT_THAT(text(), HasSubstr("or more: the maximum was not passed"));
    EXPECT_THAT(text(), HasSubstr("not reported by the instrument"));
}

TEST_F(Report, PrintsTheCertificatesOfChannels) {
    RunRecord run = test::synthetic_run();
    EXPECT_EQ(count(test::text_of(render(run)), "Certificates of channels"), 0);
    ChannelCalibration air;
    air.channel = 2, air.certificate_number = "K-88123-P", air.due_on = "2020-03-02";
    air.expanded_uncertainty = 15, air.corrections = {{90'000, -20}, {101'300, 12.5}};
    run.calibrations = {air};
    const std::string text = test::text_of(render(run));
    for (const char* words : {"Certificates of channels", "K-88123-P", "(expired)", "0.15 hPa",
                              "900 hPa", "\u22120.2", "1013 hPa", "+0.125", "by table"})
        EXPECT_THAT(text, HasSubstr(words));
}

TEST_F(Report, HoldsUAgainstItsStatedTarget) {
    const std::string text = test::text_of(render(stated_run()));
    EXPECT_THAT(text, HasSubstr("U is above its stated target U_T for R."));
    EXPECT_THAT(text, HasSubstr("U ≤ U_T"));
    EXPECT_EQ(count(text, " NO "), 1);
    EXPECT_EQ(count(text, " yes "), 1);
    EXPECT_THAT(test::text_of(render(test::synthetic_run())), Not(HasSubstr("U_T")));
}

TEST_F(Report, ListsDrawsAndCountsReadingsThatNoFigureUses) {
    RunRecord run = test::synthetic_run();
    RunRevisions revisions;
    revisions.exclusions.push_back(
        {run.points[13].step, test::at_seconds(900), 0, "somebody leaned on the table"});
    revisions.superseded.push_back(run.points[20]);
    run.points[20].step = 110;
    revisions.retakes.push_back(
        {1, test::at_seconds(2290), 0, "coolant on the mirror", {{110, 20}}});
    revisions.preflight = {{"soak", false, false, "The air sensor warms up.", "no time"},
                           {"certificates", true, true, "air has no due_on.", ""}};
    const std::string text = test::text_of(render(std::move(run), std::move(revisions)));
    for (const char* words :
         {"Readings that no figure uses", "somebody leaned on the table", "coolant on the mirror",
          "excluded", "replaced", "boxed ×: excluded (1)", "×: replaced (1)", "The air sensor",
          "no time", "air has no due_on", "asks for five"})
        EXPECT_THAT(text, HasSubstr(words));
}

TEST_F(Report, SaysOnEachPageWhatIsMissing) {
    RunRecord run = stated_run();
    run.uncertainty->device_U = {};
    run.uncertainty->temperature_width.reset();
    const std::string pdf = render(run), text = test::text_of(pdf);
    EXPECT_EQ(count(text, "PRELIMINARY, not stated: device, temperature"), test::pages_of(pdf));
    EXPECT_THAT(text, HasSubstr("lacks the expanded uncertainty of the laser system;"));
    EXPECT_EQ(count(text, "U not evaluated"), 8)
        << "A, E, M and the one-way A and E; A below the title";
    run.uncertainty = UncertaintySetup{};
    run.material.standard_uncertainty.reset();
    EXPECT_THAT(test::text_of(render(run)),
                HasSubstr("device, alignment, temperature, expansion, drift"));
}

RunRecord rotary_run() {
    RunRecord run = test::truth_with_a_bad_table().run();
    run.statements = test::synthetic_statements();
    run.statements.axis = "C";
    run.instruments = test::synthetic_instruments();
    run.instruments.push_back({"indexing table", "none", "", "1440", "T-7", "", "W-12", "", ""});
    return run;
}

TEST_F(Report, OfARotaryAxisAnswersInTheUpperThirdOfPageOne) {
    RunRecord run = rotary_run();
    run.tolerances = ToleranceRecord{"acceptance",         "order 17", "arcsec",
                                     DecisionRule::simple, false,      {{"A", {}, 0.01}}};
    const Certificate certificate = test::certificate_of(run);
    const std::string value =
        paper_units_of(certificate).of_deviation(certificate.result.parameters.A);
    EXPECT_THAT(test::missing_above(render(run), folder_,
                                    {"Axis C", "Machining centre MC-800", certificate.issued_on,
                                     "FAIL: A", "A = " + value}),
                IsEmpty());
}

TEST_F(Report, OfARotaryAxisIsInDegreesAndSecondsOfArc) {
    RunRecord run = rotary_run();
    run.rotary->run_out = "8 µm at a radius of 100 mm";
    run.uncertainty = UncertaintySetup{};
    const Certificate certificate = test::certificate_of(run);
    const std::string text = close_set(test::text_of(render(run)));
    EXPECT_THAT(text, HasSubstr("Rotary positioning"));
    for (const ParameterLine& line : parameters_of_both_directions(certificate.result.parameters))
        EXPECT_THAT(text, HasSubstr(row_of(line, 3600)));
    for (const char* words : {"Value, ″", "0.000 to 318.800 °", "Measurement of the angle",
                              "72 positions of 5.0000°", "Distance of the reflectors S 32.6100 mm",
                              "8 µm at a radius of 100 mm", "T-7", "W-12", "counted with the axis"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_EQ(count(text, "Run-out of the set-up 8 µm"), 2); // on page 1 and beside the artefact
    for (const char* words : {"Compensation to 20 °C", "Expansion coefficient", "Dead path"})
        EXPECT_THAT(text, Not(HasSubstr(words)));
    EXPECT_EQ(count(text, "PRELIMINARY, not stated: device, drift"), test::pages_of(render(run)));
}

TEST_F(Report, OfAPolygonPrintsTheCertificateOfTheAutocollimatorsChannel) {
    RunRecord run = test::polygon_run();
    run.channels.push_back({9, "autocollimator", "collimator", "", ChannelKind::angle});
    ChannelCalibration stated;
    stated.channel = 9, stated.certificate_number = "AC-7", stated.due_on = "2027-03-02";
    stated.expanded_uncertainty = 0.2;
    run.calibrations = {stated};
    const std::string text = close_set(test::text_of(render(run)));
    for (const char* words : {"Certificates of channels", "AC-7", "2027-03-02", "0.2 ″"})
        EXPECT_THAT(text, HasSubstr(words));
}

TEST_F(Report, OfARotaryAxisSaysWhatIsNotStatedOfItsSetUp) {
    RunRecord run = rotary_run();
    run.rotary->deviations_arcsec.clear();
    const std::string text = close_set(test::text_of(render(run)));
    EXPECT_EQ(count(text, "Run-out of the set-up not stated"), 2);
    EXPECT_THAT(text, HasSubstr("not stated, taken as 0"));
    EXPECT_THAT(text, HasSubstr("deviations of the indexing table are not stated"));
}

TEST_F(Report, OfARotaryAxisPrintsTheBudgetOfAnnexB) {
    RunRecord run = rotary_run();
    UncertaintySetup& stated = run.uncertainty.emplace();
    stated.device_U.fixed = mm(1.2 / 3600);
    stated.eve = mm(0.6 / 3600);
    stated.targets = {{"E", mm(0.5 / 3600)}};
    const std::string text = test::text_of(render(run));
    EXPECT_EQ(count(text, "PRELIMINARY"), 0);
    for (const char* words :
         {"device and environment, after ISO 230-2, annex A", "U_cal = 1.2″, k = 2", "E_VE = 0.6″",
          "U is above its stated target U_T for E", "The true figures lie"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, Not(HasSubstr("A beam off the axis")));
}

TEST_F(Report, PrintsNotStatedForEveryEmptyField) {
    const std::string text = test::text_of(render(run_without_words()));
    for (const char* key :
         {"Customer", "Place", "Machine", "Maker", "Serial number", "Axis", "Certificate number",
          "Procedure", "Control compensation", "Operator", "Approver", "Feed", "Dwell", "Warm-up",
          "Offsets of the measuring line", "Positions of idle axes", "Note on the sensors",
          "Feedback of the axis"}) {
        const auto at = text.find(std::string{key} + " ");
        ASSERT_NE(at, std::string::npos) << key;
        EXPECT_THAT(text.substr(at, 60), HasSubstr("not stated")) << key;
    }
    EXPECT_THAT(text, HasSubstr("State: not stated"));
    EXPECT_THAT(text, HasSubstr("Laboratory not stated"));
    const auto instruments = text.substr(text.find("Calibrated"), 400);
    EXPECT_GE(count(instruments, "not stated"), 10) << "serial, certificate and due date of each";
    EXPECT_GE(count(text.substr(text.find("Place of the sensor")), "not stated"), 5);
}

TEST_F(Report, EmbedsDejaVuSansAndNothingElse) {
    std::istringstream fonts{test::output_of("pdffonts '" + render(run_that_overflows()) + "'")};
    std::string line;
    std::getline(fonts, line); // head
    std::getline(fonts, line); // rule
    int found = 0;
    while (std::getline(fonts, line)) {
        ++found;
        EXPECT_THAT(line, HasSubstr("+DejaVuSans")) << "subset";
        EXPECT_THAT(line, Not(HasSubstr("Type 3")));
        EXPECT_THAT(line, HasSubstr(" yes yes yes ")) << "embedded, subset, text can be copied";
    }
    EXPECT_GE(found, 2);
}

TEST_F(Report, GivesEqualBytesForEqualRuns) {
    const auto once = render_certificate_pdf(test::certificate_of(test::synthetic_run()));
    const auto again = render_certificate_pdf(test::certificate_of(test::synthetic_run()));
    const auto other = render_certificate_pdf(test::certificate_of(test::synthetic_run(2)));
    const auto stated = render_certificate_pdf(test::certificate_of(stated_run()));
    ASSERT_TRUE(once && again && other && stated);
    EXPECT_TRUE(*stated == *render_certificate_pdf(test::certificate_of(stated_run())));
    EXPECT_TRUE(*once == *again);
    EXPECT_FALSE(*once == *other) << "the test must be able to fail";
    EXPECT_EQ(test::made_on(test::write_pdf(folder_, *once)), "20260101010000Z")
        << "the end of the run, not the clock";
}

TEST_F(Report, KeepsInkInsideTheMargins) {
    for (const RunRecord& run : {test::synthetic_run(), stated_run(), run_without_words(),
                                 run_that_overflows(), run_of(1, false), run_of(1, true)}) {
        const std::string pdf = render(run);
        for (int page = 1; page <= test::pages_of(pdf); ++page) {
            const test::PageImage image = test::image_of(pdf, page);
            EXPECT_GT(image.ink(), 500) << "page " << page;
            EXPECT_EQ(image.ink_outside(least_margin), 0) << "page " << page;
        }
    }
}

TEST_F(Report, NeverPrintsOneWordOverAnother) {
    for (const RunRecord& run : {test::synthetic_run(), stated_run(), run_without_words(),
                                 run_that_overflows(), run_of(1, false), run_of(9, true)}) {
        const auto words = test::words_of(render(run));
        EXPECT_GT(words.size(), 300u);
        EXPECT_THAT(test::collisions_in(words), IsEmpty());
    }
}

TEST_F(Report, CollisionSearchSeesPlantedOverlap) {
    EXPECT_THAT(test::collisions_in({{1, 10, 10, 40, 20, "a"}, {1, 30, 12, 60, 22, "b"}}),
                Not(IsEmpty()));
    EXPECT_THAT(test::collisions_in({{1, 10, 10, 40, 20, "a"}, {2, 30, 12, 60, 22, "b"}}),
                IsEmpty());
}

TEST_F(Report, PrintsLongTextsInFullAndEveryTarget) {
    const std::string text = test::text_of(render(run_that_overflows()));
    EXPECT_THAT(text, HasSubstr("Machine in full"));
    EXPECT_THAT(text, HasSubstr("3 more instruments"));
    EXPECT_THAT(text, HasSubstr("1000.274"));
    EXPECT_THAT(text, HasSubstr("20 more events"));
}

TEST_F(Report, NamesWhatAnInstrumentSaidOnceAndWithoutItsPath) {
    RunRecord run = test::synthetic_run();
    EventRecord silent{EventKind::instrument, run.opened.before, 0, "", Fault::link_timeout, 0};
    const std::string sentence{fault_sentence(silent.fault)};
    silent.text = "air: " + sentence + " no reading from serial /dev/ttyUSB0 9600 8N1";
    EventRecord foreign{EventKind::instrument, run.opened.before, 0, "", Fault::bad_frame, 0};
    foreign.text = "laser: " + describe({foreign.fault, "data but no record of it", {}, {}});
    run.events = {silent, silent, foreign};
    const std::string page =
        std::regex_replace(test::text_of(render(std::move(run))), std::regex{"\\s+"}, " ");
    EXPECT_EQ(count(page, "The instrument does not answer"), 1) << page;
    EXPECT_EQ(count(page, "that is not its protocol"), 1) << page;
    EXPECT_THAT(page, HasSubstr("its line"));
    EXPECT_THAT(page, Not(HasSubstr("/dev/")));
}

TEST_F(Report, ReducesTheListOfASingleApproach) {
    const std::string text = test::text_of(render(run_of(1, true)));
    EXPECT_EQ(count(text, "U not evaluated"), 7) << "E, M, B, B̄, E↑, E↓; E below the title";
    EXPECT_THAT(text, HasSubstr("Not evaluated: A, R, A↑, A↓, R↑, R↓: one approach"));
    EXPECT_THAT(text, Not(HasSubstr("±2s"))) << "no band without a spread";
}

TEST_F(Report, ReducesTheListOfOneDirection) {
    const std::string text = test::text_of(render(run_of(5, false)));
    EXPECT_EQ(count(text, "U not evaluated"), 4) << "A↑, E↑, R↑; A↑ below the title";
    EXPECT_THAT(text, HasSubstr("Not evaluated: A, E, M, R, B, B\u0304"));
    EXPECT_THAT(text, HasSubstr("5 approaches in the forward direction"));
    EXPECT_THAT(text, Not(HasSubstr("backward ↓: mean")));
}

// Until 2026-11-24 such a text refused the certificate of a run that was measured.
TEST_F(Report, PrintsALetterThatTheFontLacksAsItsCodePoint) {
    RunRecord run = test::synthetic_run();
    run.statements.customer = "\u4e0a\u6d77 customer";
    run.statements.machine = "<b>&amp; \u0915\u094d\u0937 \U0001F527 %n (x)";
    const std::string text = test::text_of(render(run));
    EXPECT_THAT(text, HasSubstr("[U+4E0A][U+6D77] customer"));
    EXPECT_THAT(text, HasSubstr("<b>&amp; [U+0915][U+094D][U+0937] [U+1F527] %n (x)"));
}

TEST_F(Report, SurvivesControlCharactersAndBrokenUtf8) {
    RunRecord run = test::synthetic_run();
    run.statements.customer = "line\nbreak\x01 and \xff broken";
    run.statements.machine = "Мехмаш ЧПУ №5, Größe ±½";
    const std::string text = test::text_of(render(run));
    EXPECT_THAT(text, HasSubstr("line break"));
    EXPECT_THAT(text, HasSubstr("Мехмаш ЧПУ №5, Größe ±½"));
}

} // namespace
} // namespace axiscal::report_test

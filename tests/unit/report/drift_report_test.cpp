// The report of a drift test. The truth is a creep put in by hand: 6 um in two hours, 3 um in one.
#include "acquisition/documents/drift/drift_pages.hpp"
#include "acquisition/documents/drift/drift_plot.hpp"
#include "acquisition/documents/drift/drift_report.hpp"
#include "analysis/air/air_refraction.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "upper_third.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <functional>

namespace axiscal::drift_report_test {
namespace {

using namespace std::chrono_literals;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ScratchFolder;

constexpr int least_margin = 28; // points; the narrowest a copier and a hole punch leave
constexpr double two_hours_s = 7200, interval_s = 10;

double index_of_refraction(const RunRecord& run) {
    AirState air;
    air.temperature = Temperature::celsius(20);
    air.pressure = pascal(101325);
    air.relative_humidity = percent(50);
    air.vacuum_wavelength = run.laser.vacuum_wavelength;
    air.co2_ppm = run.air.co2_ppm;
    return 1 + refractivity_of(run.air.formula, air)->n_minus_1;
}

/// Air and material stand still at 20 degC; only the axis creeps.
RunRecord creeping(const std::function<double(double)>& creep_um, double duration_s = two_hours_s) {
    RunRecord run = test::synthetic_run();
    run.run_id = "20260101T000000Z-X-drift";
    run.kind = TestKind::drift;
    run.plan.targets.clear();
    run.plan.points.clear();
    run.points.clear();
    run.environment.clear();
    run.laser.instrument = "laser";
    run.laser.beam_walk = run.laser.beam_walk_travel = Length{};
    run.channels.insert(run.channels.begin(),
                        ChannelRecord{7, "axis 1", run.laser.instrument, "",
                                      ChannelKind::displacement, Medium::none, 0});
    run.channels.push_back(
        {8, "spindle", "mat", "nose", ChannelKind::temperature, Medium::none, 0.3});
    run.channels.push_back(
        {9, "tool gauge", "gauge", "", ChannelKind::displacement, Medium::none, 0});
    const double n = index_of_refraction(run);
    const double origin_s = seconds_of(run.opened.before.time_since_epoch());
    for (int i = 1; i * interval_s <= duration_s; ++i)
        for (const ChannelRecord& channel : run.channels) {
            const double s = i * interval_s;
            double value = 20;
            if (channel.kind == ChannelKind::pressure) value = 101325;
            if (channel.kind == ChannelKind::humidity) value = 50;
            if (channel.id == 7) value = run.laser.sign * n * (0.9 + creep_um(s) * 1e-6);
            if (channel.id == 8) value = 20 + s / duration_s; // 1 K warmer at the end
            if (channel.id == 9) value = 2.5e-6 * s / duration_s;
            run.environment.push_back(
                {channel.id, monotonic_from_ns(std::llround((origin_s + s) * 1e9)), value});
        }
    return run;
}

DriftResult document_of(RunRecord run, Duration duration = 2h) {
    DriftResult document;
    document.attachments.setup =
        DriftSetup{duration, 10s, mm(900), run.laser.instrument == "gauge"};
    auto drift = evaluate_drift(run, std::get<DriftSetup>(document.attachments.setup));
    EXPECT_TRUE(drift) << (drift ? "" : describe(drift.error()));
    document.drift = drift.value_or(RunDrift{});
    document.run = std::move(run);
    document.run_file_sha256 = std::string(64, 'a');
    document.result_digest = std::string(64, 'd');
    return document;
}

/// From the first reading, after one interval, to the last.
double steady_creep_um(double s) {
    return 6 * (s - interval_s) / (two_hours_s - interval_s);
}

/// Text of a page with its breaks of lines as spaces.
std::string in_one_line(std::string text) {
    std::string line;
    for (const char letter : text)
        if (!std::isspace(static_cast<unsigned char>(letter)))
            line += letter;
        else if (!line.ends_with(' '))
            line += ' ';
    return line;
}

class DriftReport : public ::testing::Test {
protected:
    std::string render(const DriftResult& document) {
        const auto pdf = render_drift_pdf(document);
        EXPECT_TRUE(pdf.has_value()) << (pdf ? "" : describe(pdf.error()));
        return test::write_pdf(folder_, pdf.value_or(""));
    }
    ScratchFolder folder_;
};

TEST_F(DriftReport, PrintsTheCreepThatWasPutInAndWhoMeasuredWhat) {
    const std::string text = test::text_of(render(document_of(creeping(steady_creep_um))));
    // E_VE 6 um, of which an hour sees 3; 6 / (2 sqrt 3) = 1.732, rounded up
    for (const char* row : {"E_VE +Environmental variation: range over the whole test +6\\.00 ",
                            "u\\(E_VE\\) +Standard uncertainty from it[^\n]* 1\\.74\n",
                            "ETVE +Largest range within any 60 min +3\\.00 "})
        EXPECT_THAT(text, ContainsRegex(row));
    EXPECT_THAT(text, HasSubstr("120.00"));
    for (const char* words : {"Drift test",
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
                              "L-0042",
                              "C-2025-118",
                              "2026-09-30",
                              "at rest at 900.000 mm",
                              "2 h",
                              "10 s",
                              "720 of 720",
                              "30 min of full strokes",
                              "Ciddor",
                              "version 0.1.0",
                              "20260101T000000Z-X-drift",
                              "not recorded"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, HasSubstr(std::string(64, 'a')));
    EXPECT_THAT(text, HasSubstr(std::string(64, 'd')));
    EXPECT_THAT(text, Not(HasSubstr("PRELIMINARY")));
}

TEST_F(DriftReport, AnswersInTheUpperThirdOfPageOne) {
    DriftResult document = document_of(creeping(steady_creep_um));
    const ToleranceRecord agreed{"acceptance",         "order 17", "um",
                                 DecisionRule::simple, false,      {{"E_VE", {}, 5}}};
    document.conformity = conformity_of(agreed, {{"E_VE", document.drift.eve.range, {}, 2}}, "um");
    EXPECT_THAT(test::missing_above(render(document), folder_,
                                    {"axis X", "Machining centre MC-800", "2026-01-01",
                                     "FAIL: E_VE", "E_VE = 6.00"}),
                IsEmpty());
}

TEST_F(DriftReport, ShowsEveryChannelWithItsRangeInTheUnitOfPaper) {
    const std::string text = test::text_of(render(document_of(creeping(steady_creep_um))));
    for (const char* words :
         {"air temperature", "air pressure", "air humidity", "scale left", "scale right", "spindle",
          "nose", "tool gauge", "Further temperature, °C", "Further length, change, µm", "1013.25",
          "21.00", "2.50", "Time since the beginning of the test, min"})
        EXPECT_THAT(text, HasSubstr(words));
}

TEST_F(DriftReport, TellsTheSlopeOfEachChannelAndWhatTheBudgetTakes) {
    // x of the time between first and last reading gives 9 um x^2: the least-squares line rises by
    // 9 um in these 7190 s, 4.506 um in an hour, 4.507 as counted in vacuum. Of the last hour is
    // 9 um (1 - (3590 / 7190)^2) = 6.756 um. The spindle has 1 K, the gauge 2.5 um in two hours.
    const auto creep_um = [](double s) {
        return 9 * std::pow((s - interval_s) / (two_hours_s - interval_s), 2);
    };
    const std::string text = test::text_of(render(document_of(creeping(creep_um))));
    for (const char* row :
         {"ETVE +Largest range within any 60 min +6\\.76 ",
          "Slope of the straight line through all readings, in an hour +4\\.51\n",
          "laser/axis 1 [^\n]* 4\\.507 ", "mat/spindle +nose [^\n]* 0\\.500 ",
          "gauge/tool gauge [^\n]* 1\\.250 ", "at 20 °C +as read"}) // of the traces, side by side
        EXPECT_THAT(text, ContainsRegex(row));
    EXPECT_THAT(text, HasSubstr("Axis at rest, change, µm"));
    EXPECT_THAT(in_one_line(text),
                HasSubstr("The budget of later runs takes E_VE (ISO 230-2, annex A); every other "
                          "figure and channel of this test is informative."));
}

TEST_F(DriftReport, ShowsAChannelThatStayedSilent) {
    RunRecord run = creeping(steady_creep_um);
    run.channels.push_back(
        {15, "hygrometer", "hall", "door", ChannelKind::humidity, Medium::none, 0});
    const std::string text = test::text_of(render(document_of(std::move(run))));
    EXPECT_THAT(text,
                ContainsRegex("hall/hygrometer +door +Relative humidity, % +(– +){5}0\\.0 +0\n"));
}

/// Two sensors of one kind: what their driver calls the channel is the same.
TEST_F(DriftReport, TellsChannelsOfOneNameApartByTheirInstruments) {
    RunRecord run = creeping(steady_creep_um);
    for (ChannelRecord& channel : run.channels)
        if (channel.id == 8) channel.name = "probe";
    run.channels.push_back(
        {15, "probe", "hall", "door", ChannelKind::temperature, Medium::none, 0});
    const auto begin = run.environment.front().at;
    run.environment.push_back({15, begin, 18});
    run.environment.push_back({15, begin + 1h, 18.5});
    const auto document = document_of(std::move(run));
    std::vector<std::string> names;
    for (const EnvironmentTrace& drawn : drift_traces_of(document.drift))
        names.push_back(drawn.channel);
    EXPECT_THAT(names, ::testing::IsSupersetOf({"mat/probe", "hall/probe"}));
    const std::string text = test::text_of(render(document));
    EXPECT_THAT(text, ContainsRegex("mat/probe +nose +Further temperature"));
    EXPECT_THAT(text, ContainsRegex("hall/probe +door +Further temperature"));
}

/// At its datum, where the reflectors are square; 3.6 seconds of arc in two hours.
RunRecord turning() {
    RunRecord run = creeping([](double) { return 0; });
    run.plan.axis_kind = AxisKind::rotary;
    run.plan.datum = mm(900);
    run.laser.sign = 1;
    RotarySetup& rotary = run.rotary.emplace();
    rotary.step_deg = 5;
    rotary.arm = mm(32.61);
    const double origin_s = seconds_of(run.opened.before.time_since_epoch());
    for (EnvironmentReading& reading : run.environment)
        if (reading.channel == 7) {
            const double s = seconds_of(reading.at.time_since_epoch()) - origin_s;
            const double creep_rad =
                3.6 * (s - interval_s) / (two_hours_s - interval_s) / 206264.806;
            reading.value = index_of_refraction(run) * 32.61e-3 * std::sin(creep_rad);
        }
    return run;
}

TEST_F(DriftReport, OfARotaryAxisIsInSecondsOfArc) {
    const std::string pdf = render(document_of(turning()));
    const std::string text = test::text_of(pdf);
    for (const char* words : {"3.60", "Value, ″", "rotary", "at rest at 900.000°",
                              "an angle does not expand", "32.6100 mm", "5.0000°"})
        EXPECT_THAT(text, HasSubstr(words));
    EXPECT_THAT(text, Not(HasSubstr("coordinate at 20 °C")));
    EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
}

/// The gauge becomes a bar that rises steadily by 2.5 um in two hours; the laser is silent.
RunRecord of_the_bar() {
    RunRecord run = creeping([](double) { return 0; });
    run.laser = {};
    run.laser.instrument = "gauge";
    run.statements.axis = "ZX";
    std::erase_if(run.channels, [](const ChannelRecord& channel) { return channel.id == 7; });
    std::erase_if(run.environment, [](const EnvironmentReading& one) { return one.channel == 7; });
    return run;
}

TEST_F(DriftReport, OfABallbarNamesItWithItsPlaneWhereAnAxisWouldStand) {
    const std::string pdf = render(document_of(of_the_bar()));
    const std::string text = test::text_of(pdf), line = in_one_line(text);
    // 2.5 um from the begin; 719 of 720 intervals lie between the first reading and the last
    for (const char* row : {"E_VE +Environmental variation: range over the whole test +2\\.50 ",
                            "ETVE +Largest range within any 60 min +1\\.25 "})
        EXPECT_THAT(text, ContainsRegex(row));
    for (const char* words :
         {"of a ballbar at rest", "gauge/tool gauge, at rest; plane ZX", "none: taken as read",
          "Ballbar at rest, change of its reading, µm", "Ballbar at rest, change, µm",
          "The first line is the ballbar.", "none: as read", "ballbar, plane ZX, drift test",
          "The budget of later circular tests takes E_VE (ISO/TR 230-9)",
          "Each reading of the ballbar is a mean over the capture window and is taken as it is"})
        EXPECT_THAT(line, HasSubstr(words));
    for (const char* words : {"20 °C", "Dead path", "Axis datum", "Place of rest", "Range as read"})
        EXPECT_THAT(line, Not(HasSubstr(words)));
    EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
    for (int page = 1; page <= test::pages_of(pdf); ++page)
        EXPECT_EQ(test::image_of(pdf, page).ink_outside(least_margin), 0) << page;
}

TEST_F(DriftReport, OfAShortTestSaysThatItSawNoHour) {
    const auto creep = [](double s) { return s / 600; };
    const std::string text = test::text_of(render(document_of(creeping(creep, 600), 10min)));
    EXPECT_THAT(text, HasSubstr("shorter than 60 min"));
    EXPECT_THAT(text, HasSubstr("10 min"));
    EXPECT_THAT(test::text_of(render(document_of(creeping(steady_creep_um)))),
                Not(HasSubstr("shorter than")));
}

TEST_F(DriftReport, TellsTheIntervalsThatAreMissing) {
    RunRecord run = creeping(steady_creep_um);
    int left_out = 0;
    std::erase_if(run.environment, [&](const EnvironmentReading& reading) {
        return reading.channel == 7 && ++left_out > 300 && left_out <= 312;
    });
    EXPECT_THAT(test::text_of(render(document_of(std::move(run)))),
                HasSubstr("12 of 720 intervals have no good reading"));
}

TEST_F(DriftReport, TellsReadingsThatCouldNotBeEvaluatedAndThatNoBudgetTakesThem) {
    RunRecord run = turning();
    run.rotary->range_deg = 0.0005; // 1.8 of its 3.6 seconds of arc: the later half is beyond
    const std::string text = in_one_line(test::text_of(render(document_of(std::move(run)))));
    EXPECT_THAT(text, HasSubstr("cannot be evaluated and are left out"));
    EXPECT_THAT(text, HasSubstr("beyond its range of 0.0005 deg"));
    EXPECT_THAT(text, HasSubstr("no budget takes E_VE of this test"));
    EXPECT_THAT(text, Not(HasSubstr("The budget of later runs takes")));
    EXPECT_THAT(text, Not(HasSubstr("without fresh")));
}

TEST_F(DriftReport, ByAScaleSaysThatItsTemperatureWasMissing) {
    RunRecord run = creeping(steady_creep_um);
    run.scale.emplace().channels = {8}; // what the spindle was
    const MonotonicTime begin = run.environment.front().at;
    std::erase_if(run.environment, [&](const EnvironmentReading& reading) {
        return reading.channel == 8 && reading.at - begin > 1h;
    });
    const std::string text = in_one_line(test::text_of(render(document_of(std::move(run)))));
    EXPECT_THAT(text, HasSubstr("readings without fresh temperature of scale and material"));
    EXPECT_THAT(text, Not(HasSubstr("fresh air")));
}

TEST_F(DriftReport, TellsOneReadingInTheSingular) {
    DriftResult document = document_of(creeping(steady_creep_um));
    document.drift.without_air = 1;
    document.drift.refused = {{Fault::refused, "It lies beyond the range.", 1, 3, 3}};
    const std::string text = in_one_line(test::text_of(render(document)));
    EXPECT_THAT(text, HasSubstr("1 reading without fresh air or material beside it is left out."));
    EXPECT_THAT(text, HasSubstr("1 reading at 3.00 min cannot be evaluated and is left out. The "
                                "reason: It lies beyond the range."));
}

TEST_F(DriftReport, GivesTheSameBytesAgain) {
    const DriftResult document = document_of(creeping(steady_creep_um));
    EXPECT_TRUE(render_drift_pdf(document).value() == render_drift_pdf(document).value());
}

TEST_F(DriftReport, HasNoWordOverAnotherAndFreeMarginsHoweverMuchIsStated) {
    RunRecord crowded = creeping([](double s) { return 40 * std::sin(s / 300); });
    const std::string tale = "a long text that somebody typed into the station file because it "
                             "could be done, with every detail of the name and the address";
    crowded.statements.machine = crowded.statements.customer = crowded.statements.laboratory =
        crowded.statements.offsets = crowded.statements.operator_name = tale;
    for (int i = 20; i < 30; ++i)
        crowded.channels.push_back({i, "column " + std::to_string(i) + " " + tale, "mat", tale,
                                    ChannelKind::temperature, Medium::none, 0.02});
    RunRecord bare = creeping([](double) { return 0; });
    bare.statements = {};
    bare.channels.resize(6); // the laser and what brings it to 20 degC
    for (const RunRecord& run : {creeping(steady_creep_um), crowded, bare}) {
        const std::string pdf = render(document_of(run));
        EXPECT_THAT(test::collisions_in(test::words_of(pdf)), IsEmpty());
        for (int page = 1; page <= test::pages_of(pdf); ++page) {
            EXPECT_EQ(test::image_of(pdf, page).ink_outside(least_margin), 0) << page;
            EXPECT_GT(test::image_of(pdf, page).ink(), 0) << page;
        }
    }
}

TEST(DriftPlot, DrawsTheExtremesOfALongRecord) {
    DriftSeries series;
    for (int i = 0; i < 100'000; ++i) {
        series.times.push_back(i);
        series.readings.push_back(i == 71'234 ? 9 : i == 3 ? -7 : std::sin(i));
    }
    const DriftSeries drawn = as_drawn(series);
    EXPECT_LE(drawn.times.size(), 2000U);
    EXPECT_TRUE(std::ranges::is_sorted(drawn.times));
    EXPECT_EQ(std::ranges::max(drawn.readings), 9);
    EXPECT_EQ(std::ranges::min(drawn.readings), -7);
    series.times.resize(2000);
    series.readings.resize(2000);
    EXPECT_EQ(as_drawn(series).times, series.times);
}

TEST(DriftPlot, PutsEachKindOfChannelIntoItsOwnPanel) {
    const DriftResult document = document_of(creeping(steady_creep_um));
    const auto traces = drift_traces_of(document.drift);
    std::vector<std::string> names;
    for (const EnvironmentPanel& panel : drift_panels_of(traces))
        names.push_back(panel.paper.quantity);
    EXPECT_THAT(names, ::testing::ElementsAre("Further length, change", "Material temperature",
                                              "Air temperature", "Further temperature",
                                              "Air pressure", "Relative humidity"));
}

TEST(DriftPlot, PutsTheAxisAboveTheChannelsOnTheSameTime) {
    const DriftResult document = document_of(creeping(steady_creep_um));
    const auto traces = drift_axis_traces_of(document.drift);
    const EnvironmentPanel panel = drift_axis_panel_of(document.drift, traces);
    ASSERT_EQ(panel.traces.size(), 2U);
    EXPECT_EQ(panel.paper.unit, "µm");
    for (const EnvironmentTrace* drawn : panel.traces) {
        EXPECT_NEAR(drawn->seconds.front(), interval_s, 1e-9) << drawn->channel;
        EXPECT_NEAR(drawn->seconds.back(), two_hours_s, 1e-9) << drawn->channel;
        EXPECT_NEAR(drawn->values.back(), 6, 0.01) << drawn->channel;
    }
}

TEST(DriftWords, TellADurationInItsLargestWholeUnit) {
    EXPECT_EQ(duration_text(30min), "30 min");
    EXPECT_EQ(duration_text(12h), "12 h");
    EXPECT_EQ(duration_text(90s), "90 s");
    EXPECT_EQ(duration_text(500ms), "0.500 s");
}

} // namespace
} // namespace axiscal::drift_report_test

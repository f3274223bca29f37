#include "acquisition/documents/positioning/certificate_csv.hpp"
#include "acquisition/documents/positioning/certificate_json.hpp"
#include "acquisition/documents/positioning/result_json.hpp"
#include "acquisition/documents/result_digest.hpp"
#include "acquisition/documents/test_result.hpp"
#include "tests/unit/analysis/linear_scale_run.hpp"
#include "tests/unit/analysis/rotary_truth.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"
#include "tests/unit/report/synthetic_certificate.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

namespace axiscal::certificate_json_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(CertificateJson, IsTheResultDocumentWithRunEnvironmentAndCompensation) {
    const Certificate certificate = test::certificate_of(test::synthetic_run());
    const Json document = certificate_to_json(certificate);
    const Json result = result_to_json(certificate.result);
    for (const char* key : {"format", "standard", "unit", "parameters", "positions"})
        EXPECT_EQ(document.at(key), result.at(key)) << key;
    EXPECT_EQ(document.at("compensation").at("state"), "compensated_to_20C");
    EXPECT_EQ(document.at("compensation").at("after").size(), 110u);
    EXPECT_EQ(document.at("environment").at("channels").size(), 5u);
    EXPECT_EQ(document.at("run").at("id"), "20260101T000000Z-X");
    EXPECT_EQ(document.at("run").at("run_file_sha256"), certificate.run_file_sha256);
    EXPECT_EQ(document.at("run").at("plan").at("seed"), 4711);
    EXPECT_EQ(document.at("run").at("instruments").at(0).at("serial"), "L-0042");
}

TEST(CertificateJson, OfALinearScaleTellsOfTheScaleAndNothingOfAir) {
    const Certificate certificate = test::certificate_of(test::run_by_scale({}));
    const Json document = certificate_to_json(certificate);
    const Json& done = document.at("compensation");
    EXPECT_EQ(done.at("state"), "compensated_to_20C");
    EXPECT_EQ(done.at("reference"), "linear scale");
    EXPECT_DOUBLE_EQ(done.at("scale_expansion_per_K"), 8.5e-6);
    EXPECT_DOUBLE_EQ(done.at("scale_first_degC"), 26.5);
    EXPECT_NEAR(done.at("scale_resolution_um"), 0.1, 1e-12);
    EXPECT_TRUE(done.at("scale_expansion_standard_uncertainty_per_K").is_null());
    for (const char* key : {"air_formula", "vacuum_wavelength_nm", "refractive_index_minus_1_first",
                            "refractive_index_minus_1_last", "dead_path_mm", "cosine_factor",
                            "largest_air_correction"})
        EXPECT_FALSE(done.contains(key)) << key;
    const Json& run = document.at("run");
    EXPECT_FALSE(run.contains("laser") || run.contains("air"));
    EXPECT_EQ(run.at("scale").at("instrument"), "scale");
    EXPECT_EQ(run.at("scale").at("temperatures"), Json::array({"glass"}));
    EXPECT_NE(certificate_csv(certificate).find("# reference,linear scale"), std::string::npos);
    EXPECT_FALSE(certificate_to_json(test::certificate_of(test::synthetic_run()))
                     .at("compensation")
                     .contains("reference"));
}

TEST(CertificateJson, NamesAWrongSetUpWhereTheReadingsShowOne) {
    RunRecord run = test::synthetic_run();
    EXPECT_FALSE(certificate_to_json(test::certificate_of(run)).contains("setup_findings"));
    for (std::size_t i = 60; i < run.points.size(); ++i)
        run.points[i].reading = run.points[i].reading + um(12);
    const Json document = certificate_to_json(test::certificate_of(run));
    ASSERT_EQ(document.at("setup_findings").size(), 1U);
    const Json& found = document.at("setup_findings").at(0);
    EXPECT_EQ(found.at("error"), "moved_optic");
    EXPECT_EQ(found.at("unit"), "um");
    EXPECT_NEAR(found.at("value").get<double>(), 12,
                3 * found.at("standard_uncertainty").get<double>());
    EXPECT_TRUE(found.at("sensor").is_null());
    EXPECT_TRUE(found.at("answer").is_null());
    EXPECT_EQ(document.at("run").at("remarks").back(),
              "Set-up: " + found.at("seen").get<std::string>() + " " +
                  found.at("probably").get<std::string>() + " " +
                  found.at("look_at").get<std::string>());
}

TEST(CertificateJson, SaysWhatAPersonAnsweredToAFinding) {
    Certificate certificate = test::certificate_of(test::synthetic_run());
    SetupFinding& found = certificate.setup_findings.emplace_back();
    found.answer = "the bracket was tight";
    found.answered_by = "Jo Miller (token)";
    EXPECT_EQ(certificate_to_json(certificate).at("setup_findings").at(0).at("answer"),
              (Json{{"text", "the bracket was tight"}, {"by", "Jo Miller (token)"}}));
}

TEST(CertificateJson, ShowsHowTheBeamWasAligned) {
    Certificate certificate = test::certificate_of(test::synthetic_run());
    EXPECT_TRUE(certificate_to_json(certificate).at("run").at("alignment").is_null());
    AlignmentRecord& alignment = certificate.attachments.alignment.emplace();
    alignment.reached = metre(1);
    alignment.far = FarRest{metre(1), um(9), um(7.5), um(0.25), 40, true};
    alignment.places = {{mm(0), mm(40), 9, 61, 70, 72}};
    const Json shown = certificate_to_json(certificate).at("run").at("alignment");
    EXPECT_NEAR(shown.at("cosine_error").at("error_um"), 1.5, 1e-9);
    EXPECT_NEAR(shown.at("cosine_error").at("bound_um"), 1.75, 1e-9);
    EXPECT_NEAR(shown.at("cosine_error").at("angle_mrad"), std::sqrt(3.0), 1e-5); // sqrt(2 e / D)
    EXPECT_EQ(shown.at("strength").at(0).at("weakest_percent"), 61);
    EXPECT_TRUE(shown.at("cosine_error_by_spot").is_null());
}

/// Each point known by its step: 0.01 um for every step, and no time of the last one.
Certificate synchronised_certificate() {
    Certificate certificate = test::certificate_of(test::synthetic_run());
    auto& records = certificate.attachments.synchronisation;
    records.push_back(
        {-1, "serial/0/1", Synchronisation{std::chrono::microseconds{5}, 0.25}}); // the datum
    for (const PointRecord& point : certificate.run.points)
        records.push_back({point.step, point.datum_id,
                           Synchronisation{std::chrono::microseconds{7}, 0.01 * (point.step + 1)}});
    records.back().stated.reset();
    return certificate;
}

TEST(CertificateJson, StatesWhatTheUncertainTimeAddsToEachCapture) {
    EXPECT_TRUE(certificate_to_json(test::certificate_of(test::synthetic_run()))
                    .at("run")
                    .at("synchronisation")
                    .is_null());
    const Json shown =
        certificate_to_json(synchronised_certificate()).at("run").at("synchronisation");
    EXPECT_EQ(shown.at("captures"), 111);
    EXPECT_EQ(shown.at("stated"), 110);
    EXPECT_EQ(shown.at("largest_step"), 108);
    EXPECT_DOUBLE_EQ(shown.at("largest_um"), 1.09);
    ASSERT_EQ(shown.at("readings").size(), 111U);
    EXPECT_EQ(shown.at("readings").at(0).at("step"), -1);
    EXPECT_DOUBLE_EQ(shown.at("readings").at(0).at("u_t_us"), 5);
    EXPECT_DOUBLE_EQ(shown.at("readings").at(3).at("error_um"), 0.03);
    EXPECT_TRUE(shown.at("readings").at(110).at("u_t_us").is_null());
    EXPECT_TRUE(shown.at("readings").at(110).at("error_um").is_null()) << "not stated, never 0";
}

/// One millimetre of an autocollimator's reading stands for a degree: a micrometre for 3.6".
Certificate synchronised_polygon() {
    Certificate certificate = test::certificate_of(test::polygon_run());
    certificate.attachments.synchronisation = {
        {0, "serial/0/1", Synchronisation{std::chrono::milliseconds{30}, 0.01}}};
    return certificate;
}

TEST(CertificateJson, StatesWhatTheTimeAddsToAnAutocollimatorsReadingInSecondsOfArc) {
    const Json shown = certificate_to_json(synchronised_polygon()).at("run").at("synchronisation");
    EXPECT_NEAR(shown.at("largest_arcsec"), 0.036, 1e-12);
    EXPECT_NEAR(shown.at("readings").at(0).at("error_arcsec"), 0.036, 1e-12);
    EXPECT_FALSE(shown.contains("largest_um"));
    EXPECT_FALSE(shown.at("readings").at(0).contains("error_um"));
}

/// A reading that was taken again counts no more.
TEST(Synchronisation, OfAReadingThatWasReplacedIsNotTheLargest) {
    Certificate certificate = synchronised_certificate();
    certificate.attachments.synchronisation.push_back(
        {777, "serial/0/1", Synchronisation{std::chrono::microseconds{7}, 9}});
    const auto over =
        summarize_synchronisation(certificate.run, certificate.attachments.synchronisation);
    EXPECT_EQ(over.stated, 110);
    EXPECT_EQ(over.largest->step, 108);
}

TEST(CertificateJson, HoldsTheCertificatesOfChannels) {
    RunRecord run = test::synthetic_run();
    ChannelCalibration air;
    air.channel = 1, air.due_on = "2020-03-02", air.expanded_uncertainty = 0.1;
    air.corrections = {{15, 0.06}, {25, 0.04}};
    run.calibrations = {air};
    const Json document = certificate_to_json(test::certificate_of(std::move(run)));
    const Json shown = document.at("run").at("calibrations").at(0);
    EXPECT_EQ(shown.at("channel"), "air temperature");
    EXPECT_EQ(shown.at("expired"), true);
    EXPECT_EQ(shown.at("expanded_uncertainty"), 0.1);
    EXPECT_TRUE(shown.at("certificate_number").is_null());
    EXPECT_EQ(shown.at("corrections").at(1).at("correction"), 0.04);
    EXPECT_TRUE(document.at("environment").at("channels").at(0).at("correction").is_null());
    EXPECT_EQ(document.at("environment").at("channels").at(1).at("correction"), 0);
}

TEST(CertificateJson, SaysPreliminaryForEachParameter) {
    const Json document = certificate_to_json(test::certificate_of(test::synthetic_run()));
    EXPECT_EQ(document.at("preliminary"), true);
    ASSERT_EQ(document.at("parameters").size(), 12u);
    for (const auto& [key, parameter] : document.at("parameters").items())
        EXPECT_EQ(document.at("expanded_uncertainty").at(key), "not evaluated") << key;
}

RunRecord stated_run() {
    RunRecord run = test::synthetic_run();
    run.uncertainty = test::stated_uncertainty();
    run.uncertainty->targets = {{"R", um(2)}, {"B", um(2)}};
    return run;
}

TEST(CertificateJson, GivesEachParameterItsExpandedUncertaintyInTheUnitOfTheResult) {
    const Certificate certificate = test::certificate_of(stated_run());
    const Json document = certificate_to_json(certificate);
    EXPECT_EQ(document.at("preliminary"), false);
    EXPECT_FALSE(document.contains("expanded_uncertainty") || document.contains("missing"));
    ASSERT_EQ(document.at("parameters").size(), 12u);
    for (const auto& [key, parameter] : document.at("parameters").items()) {
        EXPECT_EQ(parameter.at("expanded_uncertainty").at("k"), 2) << key;
        EXPECT_GT(parameter.at("expanded_uncertainty").at("value"), 0) << key;
        EXPECT_TRUE(parameter.contains("budget")) << key;
    }
    const double eve_mm = 0.0017 / std::sqrt(12.0), root_44 = std::sqrt(4.4); // n = 5
    const auto U = [&](const char* key) {
        return document.at("parameters")
            .at(key)
            .at("expanded_uncertainty")
            .at("value")
            .get<double>();
    };
    EXPECT_NEAR(U("R"), 2 * eve_mm * root_44, 1e-15);
    EXPECT_NEAR(U("R_forward"), 4 * eve_mm, 1e-15);
    EXPECT_EQ(document.at("budget").at("terms").size(), 5u);
    EXPECT_EQ(document.at("budget").at("unit"), "mm");
    EXPECT_EQ(document.at("run").at("uncertainty").at("eve_um"), 1.7);
    EXPECT_EQ(document.at("run").at("uncertainty").at("device").at("um_per_m"), 0.7);
}

TEST(CertificateJson, HoldsUAgainstItsTarget) {
    const Json document = certificate_to_json(test::certificate_of(stated_run()));
    const Json& parameters = document.at("parameters");
    // U(R) = 2.06 um is above 2 um, U(B) = 0.62 um is not
    EXPECT_EQ(parameters.at("R").at("target_uncertainty").at("met"), false);
    EXPECT_EQ(parameters.at("B").at("target_uncertainty").at("met"), true);
    EXPECT_DOUBLE_EQ(parameters.at("B").at("target_uncertainty").at("value"), 0.002);
    EXPECT_FALSE(parameters.at("A").contains("target_uncertainty"));
}

TEST(CertificateJson, ShowsTheSimulationBesideTheFormulaWithItsSeed) {
    const Json document = certificate_to_json(test::certificate_of(stated_run()));
    for (const auto& [key, parameter] : document.at("parameters").items()) {
        const Json& drawn = parameter.at("monte_carlo");
        EXPECT_GT(drawn.at("u"), 0) << key;
        EXPECT_LT(drawn.at("interval_95").at(0), drawn.at("mean")) << key;
        EXPECT_GT(drawn.at("interval_95").at(1), drawn.at("mean")) << key;
    }
    EXPECT_EQ(document.at("monte_carlo").at("seed"), 4711);
    EXPECT_EQ(document.at("monte_carlo").at("trials"), 100000);
    const std::string remark = document.at("monte_carlo").at("remarks").at(1);
    EXPECT_NE(remark.find("% above the simulated one"), std::string::npos) << remark;
}

TEST(CertificateJson, SaysWhereEachTrueFigureLiesInTheUnitOfTheResult) {
    const Json document = certificate_to_json(test::certificate_of(stated_run()));
    for (const auto& [key, parameter] : document.at("parameters").items()) {
        const double low = parameter.at("true_value_95").at(0),
                     high = parameter.at("true_value_95").at(1),
                     U_mm = parameter.at("expanded_uncertainty").at("value");
        EXPECT_LT(low, high) << key;
        EXPECT_LT(high - low, 8 * U_mm) << key << ": of the size of 2 U, in mm";
        EXPECT_GT(high - low, U_mm / 4) << key;
    }
    EXPECT_EQ(document.at("true_values").at("seed"), 4711);
    EXPECT_EQ(document.at("true_values").at("trials"), 20000);
    const Json bare = certificate_to_json(test::certificate_of(test::synthetic_run()));
    EXPECT_FALSE(bare.contains("true_values"));
    EXPECT_FALSE(bare.at("parameters").at("A").contains("true_value_95"));
}

TEST(CertificateJson, SaysWhatIsMissingAndWhichParametersItLeavesWithoutU) {
    RunRecord run = stated_run();
    run.uncertainty->device_U = {};
    const Json document = certificate_to_json(test::certificate_of(run));
    EXPECT_EQ(document.at("preliminary"), true);
    EXPECT_EQ(document.at("missing"),
              Json::array({"the expanded uncertainty of the laser system"}));
    EXPECT_EQ(document.at("expanded_uncertainty").at("A"), "not evaluated");
    EXPECT_FALSE(document.at("parameters").at("A").contains("expanded_uncertainty"));
    EXPECT_FALSE(document.at("expanded_uncertainty").contains("R"));
    EXPECT_TRUE(document.at("parameters").at("R").contains("expanded_uncertainty"));
}

TEST(CertificateJson, LeavesValuesPositionsAndDigestAsTheyAreWithoutABudget) {
    const Certificate bare = test::certificate_of(test::synthetic_run()),
                      stated = test::certificate_of(stated_run());
    EXPECT_EQ(result_digest(bare.result), result_digest(stated.result));
    const Json a = certificate_to_json(bare), b = certificate_to_json(stated);
    EXPECT_EQ(a.at("positions"), b.at("positions"));
    for (const auto& [key, parameter] : a.at("parameters").items())
        EXPECT_EQ(parameter.at("value"), b.at("parameters").at(key).at("value")) << key;
}

TEST(CertificateJson, IsTheSameTextForTheSameRun) {
    EXPECT_EQ(json_text_of(test::certificate_of(stated_run())),
              json_text_of(test::certificate_of(stated_run())));
}

TEST(CertificateJson, BringsEveryDoubleBackExactly) {
    const Certificate certificate = test::certificate_of(test::synthetic_run());
    const Json read = Json::parse(json_text_of(certificate));
    EXPECT_EQ(read.at("parameters").at("A").at("value").get<double>(),
              *certificate.result.parameters.A);
    EXPECT_EQ(read.at("run").at("deviations").at("forward"), certificate.deviations.forward());
    EXPECT_EQ(read.at("run").at("deviations").at("backward"), certificate.deviations.backward());
    EXPECT_EQ(read.at("compensation").at("before"), certificate.compensation.before);
    EXPECT_EQ(read, certificate_to_json(certificate));
}

// 2026-11-21: the last of several channels with one name gave all of them its correction.
TEST(CertificateJson, EachChannelHasItsOwnCorrectionAlsoUnderTheSameName) {
    RunRecord run = test::synthetic_run();
    for (ChannelRecord& channel : run.channels)
        if (channel.medium == Medium::material) {
            channel.name = "contact 1"; // of two instruments
            channel.correction = 0.01 * channel.id;
        }
    const Json document = certificate_to_json(test::certificate_of(run));
    std::vector<double> printed, stated;
    for (const Json& channel : document.at("environment").at("channels"))
        if (channel.at("channel") == "contact 1") printed.push_back(channel.at("correction"));
    for (const ChannelRecord& channel : run.channels)
        if (channel.medium == Medium::material) stated.push_back(channel.correction);
    ASSERT_GE(stated.size(), 2U);
    EXPECT_EQ(printed, stated);
}

TEST(CertificateJson, WritesNullForWhatNobodyStated) {
    RunRecord run = test::synthetic_run();
    run.statements = {};
    run.channels[0].place.clear();
    run.instruments[0].due_on.clear();
    const Json document = certificate_to_json(test::certificate_of(run));
    for (const auto& [key, value] : document.at("run").at("statements").items())
        EXPECT_TRUE(value.is_null()) << key;
    EXPECT_TRUE(document.at("environment").at("channels").at(0).at("place").is_null());
    EXPECT_TRUE(document.at("run").at("instruments").at(0).at("due_on").is_null());
    EXPECT_EQ(document.at("run").at("next_calibration_due"), "2027-01-01");
}

TEST(CertificateJson, SurvivesBrokenUtf8) {
    RunRecord run = test::synthetic_run();
    run.statements.customer = "broken \xff";
    EXPECT_TRUE(Json::accept(json_text_of(test::certificate_of(run))));
}

std::vector<std::string> fields_of(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> fields;
    std::istringstream in{line};
    for (std::string field; std::getline(in, field, ',');)
        fields.push_back(field);
    if (line.ends_with(',')) fields.emplace_back(); // getline leaves out an empty last one
    return fields;
}

TEST(CertificateCsv, HasTheDocumentedHeadAndARowForEachPoint) {
    const Certificate certificate = test::certificate_of(test::synthetic_run());
    std::istringstream csv{certificate_csv(certificate)};
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "# axiscal.certificate-csv/1\r");
    int parameters = 0;
    while (std::getline(csv, line) && line.starts_with("#"))
        parameters += line.starts_with("# parameter,");
    EXPECT_EQ(parameters, 12);
    EXPECT_EQ(line, "run,direction,target_mm,measured_mm,deviation_um,t_air_degC,p_Pa,rh_percent,"
                    "t_mat_degC,time,synchronisation_um\r");
    std::size_t rows = 0;
    for (; std::getline(csv, line); ++rows) {
        const auto fields = fields_of(line);
        ASSERT_EQ(fields.size(), 11u);
        EXPECT_EQ(fields[10], "") << "not stated";
        const PlannedPoint& planned = certificate.run.points[rows].planned;
        const bool forward = planned.direction == Direction::positive;
        const auto& table =
            forward ? certificate.deviations.forward() : certificate.deviations.backward();
        const double deviation = table[static_cast<std::size_t>(planned.target_index)]
                                      [static_cast<std::size_t>(planned.approach)];
        EXPECT_EQ(fields[0], std::to_string(planned.approach + 1));
        EXPECT_EQ(fields[1], forward ? "forward" : "backward");
        EXPECT_EQ(std::stod(fields[4]), deviation * 1000) << "every double survives";
        EXPECT_NEAR(std::stod(fields[3]) - std::stod(fields[2]), deviation, 1e-9);
        EXPECT_NEAR(std::stod(fields[8]), 22.7 + 0.3 * (100 + 20.0 * planned.step) / 2320, 0.01);
    }
    EXPECT_EQ(rows, 110u);
}

TEST(CertificateCsv, TellsTheSynchronisationErrorOfTheRunAndOfEachPoint) {
    EXPECT_NE(certificate_csv(test::certificate_of(test::synthetic_run()))
                  .find("# synchronisation,not stated\r\n"),
              std::string::npos);
    const std::string csv = certificate_csv(synchronised_certificate());
    EXPECT_NE(csv.find("# synchronisation,1.09,um,largest of 110 captures; 1 not stated\r\n"),
              std::string::npos);
    const auto table = csv.find("synchronisation_um\r\n");
    ASSERT_NE(table, std::string::npos);
    const std::string first = csv.substr(table + 20, csv.find('\n', table + 20) - table - 20);
    EXPECT_TRUE(first.ends_with(",0.01\r")) << first;
    EXPECT_TRUE(csv.ends_with(",\r\n")) << "the last point: not stated";
}

TEST(CertificateCsv, TellsTheSynchronisationErrorOfAnAutocollimatorInSecondsOfArc) {
    std::istringstream csv{certificate_csv(synchronised_polygon())};
    std::string line, head;
    while (std::getline(csv, line) && line.starts_with("#"))
        if (line.starts_with("# synchronisation,")) head = line;
    const auto fields = fields_of(head);
    ASSERT_EQ(fields.size(), 4U) << head;
    EXPECT_NEAR(std::stod(fields[1]), 0.036, 1e-12);
    EXPECT_EQ(fields[2], "arcsec");
    EXPECT_TRUE(line.ends_with(",synchronisation_arcsec\r")) << line;
    std::getline(csv, line); // of the first point
    EXPECT_NEAR(std::stod(fields_of(line)[10]), 0.036, 1e-12) << line;
}

TEST(CertificateCsv, TellsUItsTargetTheBudgetAndWhatIsMissing) {
    const std::string final_one = certificate_csv(test::certificate_of(stated_run()));
    EXPECT_NE(final_one.find(",mm,\u00B1 0.00"), std::string::npos);
    EXPECT_NE(final_one.find(",k = 2\r\n"), std::string::npos);
    EXPECT_NE(final_one.find("# target_uncertainty,R,0.002,mm,not met\r\n"), std::string::npos);
    EXPECT_NE(final_one.find("# budget,environment,"), std::string::npos);
    EXPECT_NE(final_one.find("# simulated,A,0.00"), std::string::npos);
    EXPECT_NE(final_one.find("# true_value,A,0.0"), std::string::npos);
    EXPECT_NE(final_one.find(",95 %\r\n"), std::string::npos);
    EXPECT_NE(final_one.find("# simulation,100000 sessions,seed 4711\r\n"), std::string::npos);
    EXPECT_EQ(final_one.find("not evaluated"), std::string::npos);
    EXPECT_EQ(final_one.find("preliminary"), std::string::npos);
    const std::string bare = certificate_csv(test::certificate_of(test::synthetic_run()));
    EXPECT_NE(bare.find(",mm,U not evaluated\r\n"), std::string::npos);
    EXPECT_NE(bare.find("# preliminary,not stated,E_VE of a drift test\r\n"), std::string::npos);
}

TEST(CertificateCsv, QuotesWhatWouldBreakALine) {
    RunRecord run = test::synthetic_run();
    run.statements.machine = "MC-800, \"blue\"\nsecond";
    const std::string csv = certificate_csv(test::certificate_of(run));
    EXPECT_NE(csv.find("# machine,\"MC-800, \"\"blue\"\" second\"\r\n"), std::string::npos);
}

} // namespace
} // namespace axiscal::certificate_json_test

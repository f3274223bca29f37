// certificate.json and certificate.csv of a circular test.

#include "acquisition/documents/circular/circular_certificate_csv.hpp"
#include "acquisition/documents/circular/circular_certificate_json.hpp"
#include "acquisition/documents/circular/circular_json.hpp"
#include "acquisition/documents/test_result.hpp"
#include "tests/unit/report/synthetic_circular.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace axiscal::circular_certificate_json_test {
namespace {

using nlohmann::json;

json document_of(const CircularCertificate& certificate) {
    return json::parse(json_text_of(certificate));
}

TEST(CircularCertificateJson, HoldsTheAnalysisUnchangedAndWhereItCameFrom) {
    const CircularCertificate certificate = test::circular_certificate();
    const json document = document_of(certificate);
    const json plain = json::parse(
        circular_to_json({certificate.measured.test, certificate.measured.axes,
                          certificate.parameters, certificate.diagnosis, certificate.budget})
            .dump());
    EXPECT_EQ(document.at("parameters"), plain.at("parameters"));
    EXPECT_EQ(document.at("diagnosis"), plain.at("diagnosis"));
    EXPECT_EQ(document.at("preliminary"), false);
    const json& run = document.at("run");
    EXPECT_EQ(run.at("id"), "20260101T000000Z-XY");
    EXPECT_EQ(run.at("run_file_sha256"), std::string(64, 'a'));
    EXPECT_EQ(run.at("finished"), "2026-01-01T01:00:00Z");
    EXPECT_EQ(run.at("next_calibration_due"), "2027-01-01");
    EXPECT_EQ(run.at("plan").at("nominal_diameter_mm"), 300);
    EXPECT_EQ(run.at("plan").at("centre_mm"), json({400, 250.5, -120}));
    EXPECT_EQ(run.at("capture").at("filter"), "none");
    EXPECT_EQ(run.at("capture").at("readings").at("ccw").at("count"), 901);
    EXPECT_EQ(run.at("circles").size(), 6u) << "warm-up included";
    EXPECT_EQ(document.at("environment").at("machine").at("mean_degC"), 23.1);
    EXPECT_EQ(document.at("compensation").at("bar_length_mm"), 150.0123);
    EXPECT_EQ(document.at("repeats").at("G_b").size(), 2u);
}

TEST(CircularCertificateJson, SaysWhatTheCaptureDoesToG) {
    const json none = document_of(test::circular_certificate());
    EXPECT_EQ(none.at("run").at("capture").at("effect_on_G"), json({{"state", "none_stated"}}));
    CircularRun run = test::circular_run();
    run.capture.low_pass_hz = 40;
    const json filtered = document_of(test::circular_certificate(std::move(run)));
    const json& effect = filtered.at("run").at("capture").at("effect_on_G");
    EXPECT_EQ(effect.at("state"), "averaged_or_filtered");
    EXPECT_EQ(effect.at("low_pass_hz"), 40);
    // 500 undulations at 1000 mm/min on 150 mm: 500 * 16.667 / 942.478 = 8.842 Hz; 40 Hz leaves
    // 1 / sqrt(1 + (8.842/40)^2) = 0.97642.
    EXPECT_NEAR(effect.at("undulations").back().at("frequency_hz").get<double>(), 8.842, 1e-3);
    EXPECT_NEAR(effect.at("undulations").back().at("gain").get<double>(), 0.97642, 1e-4);
    EXPECT_EQ(effect.at("change_when_done_again_mm").size(), 3U);
    const json of_case = document_of(test::certificate_of(
        test::bare_measurement(test::circular_test(test::circular_truth(), 1))));
    EXPECT_TRUE(of_case.at("run").at("capture").at("effect_on_G").is_null());
}

TEST(CircularCertificateJson, HoldsTheCertificatesOfChannels) {
    CircularRun run = test::circular_run();
    run.channels.push_back({5, "table", "t", "", ChannelKind::temperature, Medium::material});
    ChannelCalibration table;
    table.channel = 5, table.certificate_number = "T-551", table.due_on = "2025-12-31";
    table.corrections = {{15, 0.06}, {25, 0.04}};
    run.calibrations = {table};
    const json document = document_of(test::circular_certificate(std::move(run)));
    const json shown = document.at("run").at("calibrations").at(0);
    EXPECT_EQ(shown.at("channel"), "table");
    EXPECT_EQ(shown.at("certificate_number"), "T-551");
    EXPECT_EQ(shown.at("expired"), true) << "the run was on 2026-01-01";
    EXPECT_EQ(shown.at("corrections").at(1).at("correction"), 0.04);
}

TEST(CircularCertificateJson, NamesTheRingAndWhatHoldsIt) {
    const CircularCertificate certificate = test::circular_certificate();
    const json zone = document_of(certificate).at("zones").at("G_b");
    EXPECT_DOUBLE_EQ(zone.at("outer_mm").get<double>() - zone.at("inner_mm").get<double>(),
                     certificate.parameters.G_b->ring.outer_mm -
                         certificate.parameters.G_b->ring.inner_mm);
    ASSERT_EQ(zone.at("control_points").size(), 4u);
    for (const json& point : zone.at("control_points")) {
        const CircularTrace& trace =
            *certificate.measured.test.find(point.at("sense") == "ccw" ? Sense::ccw : Sense::cw);
        const double angle = trace.angle_rad.at(point.at("reading").get<std::size_t>());
        EXPECT_NEAR(
            std::remainder(angle / test::one_degree - point.at("angle_deg").get<double>(), 360.0),
            0, 1e-9);
    }
}

TEST(CircularCertificateJson, OfACaseSaysNullForWhatNobodyStated) {
    const json document = document_of(test::certificate_of(
        test::bare_measurement(test::circular_test(test::circular_truth(), 1))));
    EXPECT_EQ(document.at("preliminary"), true);
    EXPECT_EQ(document.at("missing").size(), 8u);
    EXPECT_EQ(document.at("expanded_uncertainty").at("G_ccw"), "not evaluated");
    EXPECT_FALSE(document.at("parameters").at("G_ccw").contains("expanded_uncertainty"));
    const json& run = document.at("run");
    EXPECT_TRUE(run.at("capture").at("taken_elsewhere").get<bool>());
    for (const char* key : {"id", "started", "software_version", "config_sha256"})
        EXPECT_TRUE(run.at(key).is_null()) << key;
    for (const char* key : {"centre_mm", "tool_offset", "repeats", "overshoot_deg", "feed_in"})
        EXPECT_TRUE(run.at("plan").at(key).is_null()) << key;
    EXPECT_TRUE(run.contains("case_sha256"));
    EXPECT_FALSE(run.contains("run_file_sha256"));
    EXPECT_FALSE(run.contains("circles"));
}

TEST(CircularCertificateJson, DropsUWhereATermIsMissing) {
    CircularRun run = test::circular_run();
    run.uncertainty.calibration_U_um.reset();
    run.uncertainty.calibration_k.reset();
    const json document = document_of(test::circular_certificate(run));
    EXPECT_TRUE(document.at("parameters").at("G_cw").contains("expanded_uncertainty"));
    EXPECT_FALSE(document.at("parameters").at("D").contains("expanded_uncertainty"));
    EXPECT_EQ(document.at("expanded_uncertainty").at("D"), "not evaluated");
}

TEST(CircularCertificateCsv, HoldsEveryReadingAboutTheSetUpAndAboutTheZone) {
    const CircularCertificate certificate = test::circular_certificate();
    std::istringstream lines{circular_certificate_csv(certificate)};
    double low = 1e9, high = -1e9;
    int readings = 0, controls = 0, figures = 0;
    for (std::string line; std::getline(lines, line);) {
        EXPECT_EQ(line.back(), '\r');
        figures += line.rfind("# parameter", 0) == 0;
        if (line.rfind("ccw,", 0) != 0 && line.rfind("cw,", 0) != 0) continue;
        ++readings;
        std::vector<std::string> fields;
        std::istringstream cells{line.substr(0, line.size() - 1)};
        for (std::string cell; std::getline(cells, cell, ',');)
            fields.push_back(cell);
        controls += fields.size() > 5;
        if (fields[0] != "ccw") continue;
        low = std::min(low, std::stod(fields[4]));
        high = std::max(high, std::stod(fields[4]));
    }
    EXPECT_EQ(figures, 8);
    EXPECT_EQ(readings, 2 * 901);
    EXPECT_EQ(controls, 8) << "four of each sense's own zone";
    EXPECT_NEAR(high - low, certificate.parameters.ccw->G.minimum_zone_mm * 1e3, 1e-6);
}

} // namespace
} // namespace axiscal::circular_certificate_json_test

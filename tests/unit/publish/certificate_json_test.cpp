#include "acquisition/publish/certificate_csv.hpp"
#include "acquisition/publish/certificate_json.hpp"
#include "acquisition/publish/result_json.hpp"
#include "tests/unit/report/synthetic_certificate.hpp"

#include <gtest/gtest.h>
#include <sstream>

namespace axiscal {
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

TEST(CertificateJson, SaysPreliminaryForEachParameter) {
    const Json document = certificate_to_json(test::certificate_of(test::synthetic_run()));
    EXPECT_EQ(document.at("preliminary"), true);
    ASSERT_EQ(document.at("parameters").size(), 12u);
    for (const auto& [key, parameter] : document.at("parameters").items())
        EXPECT_EQ(document.at("expanded_uncertainty").at(key), "not evaluated") << key;
}

TEST(CertificateJson, BringsEveryDoubleBackExactly) {
    const Certificate certificate = test::certificate_of(test::synthetic_run());
    const Json read = Json::parse(certificate_json_text(certificate));
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
    EXPECT_NO_THROW(Json::parse(certificate_json_text(test::certificate_of(run))));
}

std::vector<std::string> fields_of(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> fields;
    std::istringstream in{line};
    for (std::string field; std::getline(in, field, ',');)
        fields.push_back(field);
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
                    "t_mat_degC,time\r");
    std::size_t rows = 0;
    for (; std::getline(csv, line); ++rows) {
        const auto fields = fields_of(line);
        ASSERT_EQ(fields.size(), 10u);
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

TEST(CertificateCsv, QuotesWhatWouldBreakALine) {
    RunRecord run = test::synthetic_run();
    run.statements.machine = "MC-800, \"blue\"\nsecond";
    const std::string csv = certificate_csv(test::certificate_of(run));
    EXPECT_NE(csv.find("# machine,\"MC-800, \"\"blue\"\" second\"\r\n"), std::string::npos);
}

} // namespace
} // namespace axiscal

#include "tools/axiscal/imports/judged_report.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace axiscal::judged_report_test {
namespace {

using Json = nlohmann::json;

/// Means 2 and 6 um forward, 0 and 1 um backward; every s is sqrt(2) um. By hand: E 6, E forward 4,
/// E backward 1, B 5, mean B 3.5, M 2.5, R forward and backward 4 sqrt(2) = 5.657, R 10.657 um.
const Json readings = Json::parse(
    R"({"analysis":"positioning","standard":"ISO 230-2:2014","axis":{"name":"X","kind":"linear"},"unit":"mm",
        "readings":"deviations","targets":[0,100],"forward":[[0.001,0.003],[0.005,0.007]],
        "backward":[[-0.001,0.001],[0.000,0.002]]})");

Json judged(const Json& report) {
    const auto answer = judge_report(readings, report);
    EXPECT_TRUE(answer) << (answer ? "" : describe(answer.error()));
    return answer.value_or(Json{});
}

std::map<std::string, std::string> codes(const Json& report) {
    std::map<std::string, std::string> out;
    const Json answer = judged(report);
    for (const Json& finding : answer.at("findings"))
        out[finding.at("parameter")] = finding.at("code");
    EXPECT_EQ(answer.at("verdict"), out.empty() ? "agrees" : "differs");
    return out;
}

using Codes = std::map<std::string, std::string>;

TEST(JudgedReport, AgreesWithinTheLastPlaceThatItPrints) {
    EXPECT_EQ(
        codes({{"parameters",
                {{"E", 0.006}, {"B", 0.005}, {"B_mean", 0.0035}, {"M", 0.0025}, {"R", 0.01066}}}}),
        Codes{});
    EXPECT_EQ(codes({{"unit", "um"}, {"parameters", {{"E", 6}, {"R", 10.66}, {"R_fwd", 5.66}}}}),
              Codes{});
}

TEST(JudgedReport, NamesTheMistakeThatGivesThePublishedFigure) {
    EXPECT_EQ(codes({{"parameters", {{"E", 0.004}, {"R", 0.005657}, {"M", 0.00251}}}}),
              (Codes{{"E", "E_ONE_SIDE"}, {"R", "R_WITHOUT_B"}, {"M", "UNEXPLAINED"}}));
    // The maximum of all and the larger of both minima: 6 - 2.
    EXPECT_EQ(codes({{"unit", "um"}, {"parameters", {{"E", 4.0}, {"B", 5.01}}}}).at("E"),
              "E_ONE_SIDE");
}

TEST(JudgedReport, SaysWhatWasPublishedAndWhatItShouldBe) {
    const Json found = judged({{"unit", "um"}, {"parameters", {{"E", 4.01}}}}).at("findings").at(0);
    EXPECT_EQ(found.at("published"), 4.01);
    EXPECT_NEAR(found.at("recomputed").get<double>(), 6, 1e-12);
    EXPECT_FALSE(found.at("sentence").get<std::string>().empty());
}

TEST(JudgedReport, SeesDirectionsThatAreExchangedInFiguresAndReadings) {
    EXPECT_EQ(codes({{"parameters", {{"B_avg", -0.0035}, {"E_forward", 0.001}, {"E_bwd", 0.004}}}}),
              (Codes{{"B_avg", "DIRECTIONS_SWAPPED"},
                     {"E_forward", "DIRECTIONS_SWAPPED"},
                     {"E_bwd", "DIRECTIONS_SWAPPED"}}));
    const Json swapped{{"forward", readings.at("backward")},
                       {"backward", readings.at("forward")},
                       {"parameters", {{"E", 0.006}}}};
    EXPECT_EQ(codes(swapped), (Codes{{"readings", "DIRECTIONS_SWAPPED"}}));
}

// Means of the other readings: 3 and 7 um forward, 1 and 2 um backward; E is 6 there, too, mean
// B 3.5.
TEST(JudgedReport, SeesFiguresOfOtherReadingsThanThoseOfTheCase) {
    Json other{{"forward", Json::parse("[[0.003,0.003],[0.007,0.007]]")},
               {"backward", Json::parse("[[0.001,0.001],[0.002,0.002]]")},
               {"parameters", {{"E", 0.006}, {"M", 0.0025}, {"R", 0.005}}}};
    EXPECT_EQ(codes(other), (Codes{{"readings", "LAST_SAMPLE"}, {"R", "LAST_SAMPLE"}}));
}

TEST(JudgedReport, ThatIsNoneIsRefusedByName) {
    const auto refused = [](const Json& report) {
        const auto answer = judge_report(readings, report);
        EXPECT_FALSE(answer) << report;
        return answer ? std::string{} : answer.error().field;
    };
    EXPECT_EQ(refused(Json::object()), "report.parameters");
    EXPECT_EQ(refused({{"parameters", Json::object()}}), "report.parameters");
    EXPECT_EQ(refused({{"parameters", {{"E", "6"}}}}), "report.parameters.E");
    EXPECT_EQ(refused({{"parameters", {{"Q", 6}}}}), "report.parameters.Q");
    EXPECT_EQ(refused({{"parameters", {{"E", 6}}}, {"unit", "inch"}}), "report.unit");
    EXPECT_EQ(refused({{"parameters", Json::object()}, {"figures", 1}}), "report.figures");
    EXPECT_EQ(refused({{"parameters", Json::object()},
                       {"forward", Json::parse("[[1,2]]")},
                       {"backward", Json::parse("[[1,2]]")}}),
              "report.forward");
    EXPECT_EQ(
        judge_report({{"analysis", "positioning"}}, {{"parameters", {{"E", 6}}}}).error().field,
        "case");
}

} // namespace
} // namespace axiscal::judged_report_test

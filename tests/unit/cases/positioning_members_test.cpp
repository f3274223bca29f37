// Members of a positioning case beside readings, and the analyses of the same data.

#include "tools/axiscal/analyze_case.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace axiscal::positioning_members_test {
namespace {

using nlohmann::json;

json rotary_case() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"C","kind":"rotary"},"unit":"arcsec","target_unit":"deg",
        "readings":"deviations","targets":[0,90,180,270],
        "forward":[[0,0],[1.5,1.5],[-2,-2],[0.5,0.5]],
        "polygon":{"face_deviation_arcsec":[0,1.5,-2,0.5],"face_of_target":[1,2,3,4],
                   "certificate_sense":"with_axis"}})");
}

json linear_case() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"um","target_unit":"mm",
        "readings":"deviations","targets":[25,75,225,275,425],
        "forward":[[0,0,0,0,0],[1,1,1,1,1],[2,2,2,2,2],[3,3,3,3,3],[4,4,4,4,4]]})");
}

json answer_to(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    return json::parse(answer.output);
}

std::string refused_field(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 3) << request.dump();
    const std::string line = answer.error_line.substr(std::string{"refused: "}.size());
    return line.substr(0, line.find(':'));
}

std::string refused_with(json request, const std::string& pointer, const json& value) {
    request[json::json_pointer{pointer}] = value;
    return refused_field(request);
}

TEST(PolygonMember, IsTakenOutAndToldInTheAnswer) {
    const json answer = answer_to(rotary_case());
    EXPECT_EQ(answer.at("parameters").at("A_forward").at("value"), 0);
    EXPECT_EQ(answer.at("artefact").at("kind"), "polygon");
    EXPECT_EQ(answer.at("artefact").at("reading_sense"), "with_axis");
    json bare = rotary_case();
    bare.erase("polygon");
    EXPECT_EQ(answer_to(bare).at("parameters").at("E_forward").at("value"), 3.5);
    EXPECT_FALSE(answer_to(bare).contains("artefact"));
}

TEST(PolygonMember, IndexingTableIsTheSameUnderItsOwnWords) {
    json request = rotary_case();
    request["indexing_table"] = {{"index_deviation_arcsec", {0, 1.5, -2, 0.5}},
                                 {"index_of_target", {1, 2, 3, 4}},
                                 {"certificate_sense", "with_axis"}};
    EXPECT_EQ(refused_field(request), "indexing_table");
    request.erase("polygon");
    EXPECT_EQ(answer_to(request).at("parameters").at("A_forward").at("value"), 0);
    EXPECT_EQ(answer_to(request).at("artefact").at("kind"), "indexing_table");
}

TEST(PolygonMember, RefusesByField) {
    const json good = rotary_case();
    EXPECT_EQ(refused_with(good, "/polygon/face_of_target/2", 1), "polygon.face_of_target[2]");
    EXPECT_EQ(refused_with(good, "/polygon/face_of_target/2", 1.5), "polygon.face_of_target[2]");
    EXPECT_EQ(refused_with(good, "/polygon/face_deviation_arcsec/1", "x"),
              "polygon.face_deviation_arcsec[1]");
    EXPECT_EQ(refused_with(good, "/polygon/certificate_sense", "left"),
              "polygon.certificate_sense");
    EXPECT_EQ(refused_with(good, "/polygon/faces", 4), "polygon.faces");
    json without_sense = good;
    without_sense["polygon"].erase("certificate_sense");
    EXPECT_EQ(refused_field(without_sense), "polygon.certificate_sense");
    json positions = good;
    positions["readings"] = "positions";
    positions["unit"] = "deg";
    EXPECT_EQ(refused_field(positions), "polygon");
    json linear = linear_case();
    linear["polygon"] = good.at("polygon");
    EXPECT_EQ(refused_field(linear), "polygon");
    json huge = good;
    huge["polygon"]["face_deviation_arcsec"][1] = 1e300;
    EXPECT_EQ(refused_field(huge), "forward[1][0]");
}

TEST(TargetRuleMember, StandsInEveryIsoResultAndInNoOther) {
    json request = linear_case();
    const json rule = answer_to(request).at("target_rule");
    EXPECT_EQ(rule.at("kept"), true);
    EXPECT_EQ(rule.at("travel"), 400);
    EXPECT_EQ(rule.at("travel_from"), "targets");
    EXPECT_NEAR(rule.at("random_share").get<double>(), 0.25, 1e-9);
    request["standard"] = "raw ranges";
    EXPECT_FALSE(answer_to(request).contains("target_rule"));
}

TEST(TargetRuleMember, StatedTravelAndIntervalAreTaken) {
    json request = linear_case();
    request["travel"] = 1400;
    request["interval"] = 100;
    const json rule = answer_to(request).at("target_rule");
    EXPECT_EQ(rule.at("travel_from"), "stated");
    EXPECT_EQ(rule.at("interval"), 100);
    EXPECT_EQ(rule.at("random_share"), 0.25);
    EXPECT_EQ(rule.at("kept"), false);
    EXPECT_EQ(rule.at("least_targets"), 7);
    EXPECT_EQ(refused_with(linear_case(), "/travel", 399), "travel");
    EXPECT_EQ(refused_with(linear_case(), "/travel", -1), "travel");
    EXPECT_EQ(refused_with(linear_case(), "/interval", 0), "interval");
    request["standard"] = "VDI/DGQ 3441";
    request["travel"] = 1;
    EXPECT_EQ(refused_field(request), "travel");
}

TEST(TargetRuleCase, AnswersLikeTheMember) {
    const json request = json::parse(R"({"analysis":"target_rule","axis":{"name":"X",
        "kind":"linear"},"unit":"mm","targets":[25,75,225,275,425]})");
    const json answer = answer_to(request);
    EXPECT_EQ(answer.at("target_rule"), answer_to(linear_case()).at("target_rule"));
    EXPECT_EQ(refused_with(request, "/approaches", 0), "approaches");
    EXPECT_EQ(refused_with(request, "/approaches", 1.5), "approaches");
    EXPECT_EQ(refused_with(request, "/targets/1", 25), "targets[1]");
    EXPECT_EQ(refused_with(request, "/targets", json::array()), "targets");
    EXPECT_EQ(refused_with(request, "/forward", {{1}}), "forward");
}

json periodic_case() {
    return json::parse(R"({"analysis":"periodic_error","unit":"um","position_unit":"mm",
        "pitch":4,"harmonics":1,"positions":[0,1,2,3,4,5,6,7,8,9,10,11],
        "deviations":[5,3,1,3,5,3,1,3,5,3,1,3]})");
}

TEST(PeriodicErrorCase, GivesTheWaveWithItsUnits) {
    const json answer = answer_to(periodic_case());
    EXPECT_EQ(answer.at("pitch"), 4);
    EXPECT_EQ(answer.at("pitch_from"), "stated");
    EXPECT_NEAR(answer.at("harmonics")[0].at("amplitude").get<double>(), 2, 1e-14);
    EXPECT_EQ(answer.at("unit"), "um");
    EXPECT_EQ(answer.at("position_unit"), "mm");
    EXPECT_EQ(answer.at("remarks").size(), 1u);
    EXPECT_FALSE(answer.contains("search"));
}

TEST(PeriodicErrorCase, TellsOfItsSearch) {
    json request = periodic_case();
    request.erase("pitch");
    const json answer = answer_to(request);
    EXPECT_NEAR(answer.at("pitch").get<double>(), 4, 1e-9);
    EXPECT_EQ(answer.at("pitch_from"), "found");
    EXPECT_NEAR(answer.at("search").at("explained_share").get<double>(), 1, 0.01);
    EXPECT_EQ(answer.at("search").at("pitch_range").size(), 2u);
}

TEST(PeriodicErrorCase, RefusesByField) {
    const json good = periodic_case();
    EXPECT_EQ(refused_with(good, "/pitch", 3), "pitch");
    EXPECT_EQ(refused_with(good, "/pitch", "4"), "pitch");
    EXPECT_EQ(refused_with(good, "/harmonics", 1.5), "harmonics");
    EXPECT_EQ(refused_with(good, "/harmonics", 51), "harmonics");
    EXPECT_EQ(refused_with(good, "/unit", "inch"), "unit");
    EXPECT_EQ(refused_with(good, "/position_unit", "inch"), "position_unit");
    EXPECT_EQ(refused_with(good, "/pitch_range", {1, 2, 3}), "pitch_range");
    EXPECT_EQ(refused_with(good, "/pitch_range", {1, 2}), "pitch_range");
    EXPECT_EQ(refused_with(good, "/deviations", {1, 2}), "deviations");
    EXPECT_EQ(refused_with(good, "/positions/3", nullptr), "positions[3]");
    EXPECT_EQ(refused_with(good, "/period", 4), "period");
}

} // namespace
} // namespace axiscal::positioning_members_test

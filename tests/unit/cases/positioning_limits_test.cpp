// `tolerances` of a positioning case, and the sets that are shipped.

#include "tests/support/source_dir.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace axiscal::positioning_limits_test {
namespace {

using nlohmann::json;

/// E 0.004, B 0.002 mm.
json limited_case() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"mm","readings":"deviations",
        "targets":[0,100,200],"forward":[[0.001,0.003],[0.002,0.004],[0.003,0.005]],
        "backward":[[-0.001,0.001],[0,0.002],[0.001,0.003]],
        "tolerances":{"name":"agreed","source":"order 17","unit":"um",
          "rule":"guard-U","limits":[
          {"parameter":"E","travel_up_to_mm":150,"limit":3},
          {"parameter":"E","travel_up_to_mm":500,"limit":5},
          {"parameter":"B","limit":1.5},{"parameter":"U_max","limit":1}]}})");
}

json answer_to(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    return json::parse(answer.output);
}

std::string refused_with(const std::string& pointer, const json& value) {
    json request = limited_case();
    request[json::json_pointer{pointer}] = value;
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 3) << request.dump();
    const std::string line = answer.error_line.substr(std::string{"refused: "}.size());
    return line.substr(0, line.find(':'));
}

TEST(Limits, AreConvertedAndTakenByTheTravelOfTheTargets) {
    const json answer = answer_to(limited_case());
    const json& verdicts = answer.at("verdicts");
    EXPECT_EQ(verdicts.at("E").at("limit"), 0.005);
    EXPECT_EQ(verdicts.at("E").at("travel_up_to_mm"), 500);
    EXPECT_EQ(verdicts.at("E").at("comparison"), "within_limit");
    EXPECT_EQ(verdicts.at("B").at("comparison"), "beyond_limit");
    EXPECT_EQ(verdicts.at("B").at("reason"), "U not evaluated");
    EXPECT_EQ(verdicts.at("U_max").at("verdict"), "not_evaluated");
    EXPECT_EQ(answer.at("tolerances").at("source"), "order 17");
    EXPECT_EQ(answer.at("tolerances").at("to_be_checked"), false);
}

TEST(Limits, ChangeNoFigure) {
    json bare = limited_case();
    bare.erase("tolerances");
    json with = answer_to(limited_case());
    with.erase("tolerances");
    with.erase("verdicts");
    EXPECT_EQ(with, answer_to(bare));
}

TEST(Limits, StatedTravelPicksTheBand) {
    json request = limited_case();
    request["travel"] = 600;
    EXPECT_EQ(answer_to(request).at("verdicts").at("E").at("reason"),
              "the travel is longer than every band");
}

TEST(Limits, UncertaintyMakesTheVerdict) {
    json request = limited_case();
    // U(B) = 2 (6 um / (2 sqrt 3)) sqrt(2/2) = 3.46 um: neither side can prove 2 um against 1.5 um
    request["uncertainty"] = {{"eve_um", 6}};
    const json verdict = answer_to(request).at("verdicts").at("B");
    EXPECT_NEAR(verdict.at("expanded_uncertainty").get<double>(), 0.0034641016151377546, 1e-15);
    EXPECT_EQ(verdict.at("verdict"), "not_provable");
    request["uncertainty"] = {{"eve_um", 0.6}};
    EXPECT_EQ(answer_to(request).at("verdicts").at("B").at("verdict"), "fail");
    request["tolerances"]["limits"][2]["limit"] = 3;
    EXPECT_EQ(answer_to(request).at("verdicts").at("B").at("verdict"), "pass");
}

TEST(Limits, TargetsInAnotherUnitMakeTheSameUncertainty) {
    json request = limited_case();
    request["uncertainty"] = {{"expansion_per_K", 11.5e-6},
                              {"temperature_width_K", 1},
                              {"eve_um", 1},
                              {"monte_carlo", {{"trials", 2000}, {"seed", 7}}}};
    const json before = answer_to(request).at("parameters");
    request["target_unit"] = "m";
    request["targets"] = {0, 0.1, 0.2};
    const json after = answer_to(request).at("parameters");
    for (const char* key : {"E", "B"})
        EXPECT_NEAR(after.at(key).at("expanded_uncertainty").at("value").get<double>(),
                    before.at(key).at("expanded_uncertainty").at("value").get<double>(), 1e-16);
    EXPECT_NEAR(after.at("E").at("monte_carlo").at("u").get<double>(),
                before.at("E").at("monte_carlo").at("u").get<double>(), 1e-15);
}

TEST(Limits, RotaryBandsAreDegrees) {
    json request = limited_case();
    request["axis"] = {{"name", "C"}, {"kind", "rotary"}};
    request["unit"] = "deg";
    request["tolerances"] = json::parse(R"({"name":"n","source":"s","unit":"arcsec",
        "limits":[{"parameter":"E","travel_up_to_deg":360,"limit":36}]})");
    const json verdict = answer_to(request).at("verdicts").at("E");
    EXPECT_NEAR(verdict.at("limit").get<double>(), 0.01, 1e-17);
    EXPECT_EQ(verdict.at("travel_up_to_deg"), 360);
}

TEST(Limits, RefuseByField) {
    EXPECT_EQ(refused_with("/tolerances/unit", "deg"), "tolerances.unit");
    EXPECT_EQ(refused_with("/tolerances/source", 5), "tolerances.source");
    EXPECT_EQ(refused_with("/tolerances/grade", 5), "tolerances.grade");
    EXPECT_EQ(refused_with("/tolerances/to_be_checked", "yes"), "tolerances.to_be_checked");
    EXPECT_EQ(refused_with("/tolerances/limits", json::array()), "tolerances.limits");
    EXPECT_EQ(refused_with("/tolerances/limits/1/parameter", "EE"),
              "tolerances.limits[1].parameter");
    EXPECT_EQ(refused_with("/tolerances/limits/1/limit", 0), "tolerances.limits[1].limit");
    EXPECT_EQ(refused_with("/tolerances/limits/1/limit", "5"), "tolerances.limits[1].limit");
    EXPECT_EQ(refused_with("/tolerances/limits/1/travel_up_to_mm", -1),
              "tolerances.limits[1].travel_up_to_mm");
    EXPECT_EQ(refused_with("/tolerances/limits/1/travel_up_to_deg", 1),
              "tolerances.limits[1].travel_up_to_deg");
    EXPECT_EQ(refused_with("/tolerances/limits/1/travel_up_to_mm", 150), "tolerances.limits[1]");
    EXPECT_EQ(refused_with("/tolerances", 1), "tolerances");
}

TEST(ShippedTolerances, AreReadAndMarkedToBeChecked) {
    const std::filesystem::path folder =
        std::filesystem::path{test::source_dir()} / "config/tolerances";
    int sets = 0;
    for (const auto& entry : std::filesystem::directory_iterator{folder}) {
        if (entry.path().extension() != ".json") continue;
        std::ifstream file{entry.path()};
        json request = limited_case();
        request["tolerances"] = json::parse(file);
        const json answer = answer_to(request);
        EXPECT_EQ(answer.at("tolerances").at("to_be_checked"), true) << entry.path();
        for (const auto& [parameter, verdict] : answer.at("verdicts").items())
            EXPECT_TRUE(verdict.contains("comparison")) << entry.path() << parameter;
        ++sets;
    }
    EXPECT_GE(sets, 1);
}

} // namespace
} // namespace axiscal::positioning_limits_test

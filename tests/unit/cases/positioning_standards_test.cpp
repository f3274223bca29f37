// Every standard that a positioning case can name.

#include "analysis/positioning/standards.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace axiscal::positioning_standards_test {
namespace {

using nlohmann::json;

json hand_case(const std::string& standard) {
    json request = json::parse(R"({"analysis":"positioning",
        "axis":{"name":"X","kind":"linear"},"unit":"um","target_unit":"mm","readings":"deviations",
        "targets":[0,100,200],"forward":[[-1,0,1,2,3],[2,3,3,3,4],[-2,-2,-2,-2,-2]],
        "backward":[[-3,-2,-1,0,1],[2,4,4,4,6],[-6,-6,-6,-6,-6]]})");
    request["standard"] = standard;
    return request;
}

json answer_to(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    return json::parse(answer.output);
}

std::string refusal_of(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 3);
    return answer.error_line;
}

TEST(PositioningStandards, EveryOneAnswersUnderItsOwnName) {
    for (const PositioningStandard& standard : positioning_standards()) {
        const json answer = answer_to(hand_case(std::string{standard.name}));
        EXPECT_EQ(answer.at("standard"), std::string{standard.name});
        EXPECT_EQ(answer.at("edition").at("confidence"), std::string{standard.confidence});
        EXPECT_FALSE(answer.at("parameters").empty());
        EXPECT_EQ(answer.contains("notes"),
                  !standard.note.empty() || standard.figures == PositioningFigures::jis_b_6330);
        if (standard.confidence != "certain") {
            EXPECT_FALSE(standard.note.empty()) << standard.name;
        }
    }
}

TEST(PositioningStandards, EqualEditionsHaveEqualFigures) {
    for (const PositioningStandard& standard : positioning_standards()) {
        if (!standard.is_iso()) continue;
        const json answer = answer_to(hand_case(std::string{standard.name}));
        const json original = answer_to(hand_case(std::string{standard.same_as}));
        EXPECT_EQ(answer.at("parameters"), original.at("parameters")) << standard.name;
        EXPECT_EQ(answer.at("positions"), original.at("positions")) << standard.name;
        // R_forward of the hand case is 2 k sqrt(2.5)
        EXPECT_NEAR(answer.at("parameters").at("R_forward").at("value").get<double>(),
                    2 * standard.cover_factor * std::sqrt(2.5), 1e-14);
    }
    const auto k_of = [](std::string_view name) {
        return find_positioning_standard(name)->cover_factor;
    };
    EXPECT_EQ(k_of("ISO 230-2:1988"), 3);
    EXPECT_EQ(k_of("GB 10931-89"), 3);
    for (const char* name : {"ISO 230-2:1997", "ISO 230-2:2006", "ISO 230-2:2014",
                             "GB/T 17421.2-2000", "GB/T 17421.2-2016", "GB/T 17421.2-2023",
                             "GOST ISO 230-2-2016", "ASME B5.54-2005", "JIS B 6190-2"})
        EXPECT_EQ(k_of(name), 2) << name;
}

TEST(PositioningStandards, UnknownOneIsRefusedWithTheList) {
    const std::string line = refusal_of(hand_case("ISO 230-2:2015"));
    EXPECT_TRUE(line.starts_with("refused: standard: must be one of ")) << line;
    for (const PositioningStandard& standard : positioning_standards())
        EXPECT_NE(line.find('"' + std::string{standard.name} + '"'), std::string::npos);
}

TEST(PositioningStandards, Vdi3441GivesItsOwnNames) {
    const json answer = answer_to(hand_case("VDI/DGQ 3441"));
    const json& parameters = answer.at("parameters");
    EXPECT_NEAR(parameters.at("P").at("value").get<double>(), 13.181980515339465, 1e-14);
    EXPECT_EQ(parameters.at("U_max").at("value"), 4);
    EXPECT_EQ(answer.at("positions")[1].at("U"), 1);
    EXPECT_FALSE(answer.contains("labels"));
}

TEST(PositioningStandards, LabelsFollowTheEdition) {
    const json newest = answer_to(hand_case("ISO 230-2:2014")).at("labels");
    EXPECT_EQ(newest.at("A_forward").at("symbol"), "A↑");
    EXPECT_EQ(newest.at("A_backward").at("axis_symbol"), "E_XX,A↓");
    EXPECT_EQ(newest.at("E").at("name"), "bidirectional systematic positioning error");
    const json older = answer_to(hand_case("ISO 230-2:2006")).at("labels");
    EXPECT_EQ(older.at("E").at("name"), "bidirectional systematic deviation of positioning");
    EXPECT_FALSE(older.at("E").contains("axis_symbol"));
    EXPECT_EQ(older.size(), 12u);
}

TEST(PositioningStandards, OneDirectionIsLabelledWithItsArrowAlone) {
    json request = hand_case("ISO 230-2:2014");
    request.erase("backward");
    const json labels = answer_to(request).at("labels");
    EXPECT_EQ(labels.size(), 3u);
    for (const char* key : {"A_forward", "E_forward", "R_forward"})
        EXPECT_TRUE(labels.at(key).at("symbol").get<std::string>().ends_with("↑")) << key;
}

TEST(PositioningStandards, SlopeIsInUnitsOfDeviationAUnitOfTarget) {
    const json slope = answer_to(hand_case("ISO 230-2:2014")).at("slope");
    EXPECT_EQ(slope.at("unit"), "um per mm");
    EXPECT_EQ(slope.at("of"), "mean");
    EXPECT_EQ(slope.at("end_points"), -0.02); // the means are 0, 3.5, -4
    EXPECT_NEAR(slope.at("least_squares").get<double>(), -0.02, 1e-17);
}

TEST(PositioningStandards, ArcsecondsMayStandOverDegrees) {
    json request = hand_case("ISO 230-2:2014");
    request["axis"] = {{"name", "C"}, {"kind", "rotary"}};
    request["unit"] = "arcsec";
    request["target_unit"] = "deg";
    const json answer = answer_to(request);
    EXPECT_EQ(answer.at("unit"), "arcsec");
    EXPECT_EQ(answer.at("target_unit"), "deg");
    EXPECT_EQ(answer.at("slope").at("unit"), "arcsec per deg");
    EXPECT_EQ(answer.at("labels").at("E").at("axis_symbol"), "E_CC,E");
    request["readings"] = "positions";
    EXPECT_TRUE(refusal_of(request).starts_with("refused: target_unit: "));
}

} // namespace
} // namespace axiscal::positioning_standards_test

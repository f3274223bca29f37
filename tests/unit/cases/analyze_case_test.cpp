#include "tests/support/source_dir.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

namespace axiscal::analyze_case_test {
namespace {

using nlohmann::json;

json good_case() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"mm","readings":"deviations",
        "targets":[0,100,200],"forward":[[-1,0,1,2,3],[2,3,3,3,4],[-2,-2,-2,-2,-2]],
        "backward":[[-3,-2,-1,0,1],[2,4,4,4,6],[-6,-6,-6,-6,-6]]})");
}

json answer_to(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    EXPECT_TRUE(answer.error_line.empty());
    return json::parse(answer.output);
}

json reference(const std::string& name) {
    std::ifstream file{test::source_dir() + "/tests/reference/" + name};
    return json::parse(file);
}

TEST(AnalyzeCase, GivesTheClosedFormOfEveryHandCase) {
    const std::map<std::string, std::string> contract_key{
        {"E_fwd", "E_forward"},  {"E_bwd", "E_backward"}, {"R_fwd", "R_forward"},
        {"R_bwd", "R_backward"}, {"A_fwd", "A_forward"},  {"A_bwd", "A_backward"}};
    const auto key_for = [&](const std::string& key) {
        const auto found = contract_key.find(key);
        return found == contract_key.end() ? key : found->second;
    };
    const json cases = reference("iso230_2_hand.json").at("cases");
    for (const auto& hand : cases) {
        SCOPED_TRACE(hand.at("id"));
        json request = good_case();
        request["targets"] = hand.at("request").at("targets");
        request["forward"] = hand.at("request").at("fwd");
        request["backward"] = hand.at("request").at("bwd");
        if (hand.at("request").value("cover", 2) == 3) request["standard"] = "ISO 230-2:1988";
        const json answer = answer_to(request);
        EXPECT_EQ(answer.at("standard"), request.at("standard"));
        const auto& exact = hand.at("exact");
        for (const auto& [key, value] : exact.at("axis").items())
            EXPECT_NEAR(answer.at("parameters").at(key_for(key)).at("value").get<double>(),
                        value.get<double>(), 1e-12)
                << key;
        for (const json& key : exact.value("absent", json::array())) {
            EXPECT_FALSE(answer.at("parameters").contains(key_for(key)));
            EXPECT_TRUE(answer.at("not_evaluated").contains(key_for(key)));
        }
    }
}

TEST(AnalyzeCase, PositionsAreTurnedIntoDeviationsOnce) {
    const json sets = reference("iso230_2_ess_reports.json").at("sets");
    for (const json& set : sets) {
        json request = good_case();
        request["readings"] = "positions";
        request["targets"] = set.at("targets");
        request["forward"] = set.at("positions_fwd");
        request["backward"] = set.at("positions_bwd");
        const json answer = answer_to(request);
        // the published figures that the file marks as right, within three of their last digit
        for (const auto& [theirs, ours] : std::map<std::string, std::string>{
                 {"A", "A"}, {"M", "M"}, {"B", "B"}, {"B_avg", "B_mean"}, {"E_fwd", "E_forward"}})
            EXPECT_NEAR(answer.at("parameters").at(ours).at("value").get<double>(),
                        set.at("published").at("axis").at(theirs).get<double>(), 3e-5);
        const auto& means = set.at("published").at("mean_fwd");
        for (std::size_t i = 0; i < means.size(); ++i)
            EXPECT_NEAR(answer.at("positions")[i].at("mean_forward").get<double>(),
                        means[i].get<double>(), 3e-5);
    }
}

TEST(AnalyzeCase, BackwardMayBeAbsent) {
    json request = good_case();
    request.erase("backward");
    const json answer = answer_to(request);
    EXPECT_TRUE(answer.at("parameters").contains("R_forward"));
    EXPECT_FALSE(answer.at("parameters").contains("R"));
    EXPECT_TRUE(answer.at("not_evaluated").contains("B_mean"));
}

TEST(AnalyzeCase, RotaryAxisIsInDegrees) {
    json request = good_case();
    request["axis"] = {{"name", "C"}, {"kind", "rotary"}};
    request["unit"] = "deg";
    EXPECT_EQ(answer_to(request).at("unit"), "deg");
}

TEST(AnalyzeCase, RemarksAndTheDefaultCompensationMayStandThere) {
    json request = good_case();
    request["comment"] = {"any", {{"thing", 1}}};
    request["id"] = 7;
    request["compensation"] = "already_at_20C";
    EXPECT_EQ(answer_to(request), answer_to(good_case()));
}

TEST(AnalyzeCase, ByteOrderMarkIsNoObstacle) {
    EXPECT_EQ(analyze_cases("\xef\xbb\xbf" + good_case().dump()).exit_code, 0);
}

TEST(AnalyzeCase, EveryDoubleComesBackExactly) {
    std::mt19937_64 random{11};
    std::uniform_real_distribution<double> mantissa{-1, 1};
    std::uniform_int_distribution<int> exponent{-300, 39};
    json request = good_case();
    request.erase("backward");
    request["targets"] = request["forward"] = json::array();
    std::vector<double> values;
    for (int i = 0; i < 5000; ++i) {
        values.push_back(std::ldexp(mantissa(random), exponent(random)));
        request["targets"].push_back(std::nextafter(i * 0.1, 1e9));
        request["forward"].push_back({values.back()}); // n = 1: the mean is the reading
    }
    const json answer = answer_to(request);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const json& row = answer.at("positions")[i];
        ASSERT_EQ(row.at("mean_forward").get<double>(), values[i]);
        ASSERT_EQ(row.at("target").get<double>(), request["targets"][i].get<double>());
    }
}

// ---- refusals -------------------------------------------------------------------------------

/// The line for stderr; checks what holds for every refusal of a single case.
std::string refusal_of(const std::string& text) {
    const CaseAnswer answer = analyze_cases(text);
    EXPECT_EQ(answer.exit_code, 3) << text.substr(0, 200);
    EXPECT_TRUE(answer.output.empty());
    EXPECT_EQ(answer.error_line.find('\n'), std::string::npos);
    return answer.error_line;
}

std::string refusal_with(const std::string& pointer, const json& value) {
    json request = good_case();
    request[json::json_pointer{pointer}] = value;
    return refusal_of(request.dump());
}

std::string refusal_without(const std::string& key) {
    json request = good_case();
    request.erase(key);
    return refusal_of(request.dump());
}

void expect_field(const std::string& line, const std::string& field) {
    EXPECT_TRUE(line.starts_with("refused: " + field + ": ")) << line;
}

TEST(AnalyzeCaseRefuses, EachMissingKey) {
    for (const char* key :
         {"analysis", "standard", "axis", "unit", "readings", "targets", "forward"})
        EXPECT_TRUE(
            refusal_without(key).starts_with(std::string{"refused: "} + key + ": is missing"))
            << refusal_without(key);
}

TEST(AnalyzeCaseRefuses, AMissingKeyWithTheWordsThatItTakes) {
    EXPECT_EQ(refusal_without("unit"),
              "refused: unit: is missing; it must be one of \"mm\", \"um\", \"m\"");
    EXPECT_EQ(refusal_without("readings"),
              "refused: readings: is missing; it must be one of \"positions\", \"deviations\"");
}

TEST(AnalyzeCaseRefuses, UnknownWords) {
    expect_field(refusal_with("/analysis", "spherical"), "analysis");
    expect_field(refusal_with("/standard", "ISO 230-2:2015"), "standard");
    expect_field(refusal_with("/unit", "inch"), "unit");
    expect_field(refusal_with("/unit", "deg"), "unit"); // of a linear axis
    expect_field(refusal_with("/readings", "raw"), "readings");
    expect_field(refusal_with("/axis/kind", "helical"), "axis.kind");
    expect_field(refusal_with("/axis/name", 5), "axis.name");
    expect_field(refusal_with("/axis", "X"), "axis");
    expect_field(refusal_with("/compensation", "none"), "compensation");
    expect_field(refusal_with("/unit", nullptr), "unit");
}

TEST(AnalyzeCaseRefuses, WrongShapes) {
    expect_field(refusal_with("/targets", json::array()), "targets");
    expect_field(refusal_with("/targets", 5), "targets");
    expect_field(refusal_with("/targets", {0, 100}), "forward");
    expect_field(refusal_with("/targets", {0, 100, 100}), "targets[2]");
    expect_field(refusal_with("/forward", json::array()), "forward");
    expect_field(refusal_with("/forward/1", json::array()), "forward[1]");
    expect_field(refusal_with("/forward/0", json::array()), "forward[0]");
    expect_field(refusal_with("/forward/1", 3), "forward[1]");
    expect_field(refusal_with("/forward/2", {1, 2, 3, 4}), "forward[2]");
    expect_field(refusal_with("/backward", json::array()), "backward");
    expect_field(refusal_with("/backward", nullptr), "backward");
    expect_field(refusal_with("/backward", {{1, 2, 3, 4, 5}}), "backward");
    expect_field(refusal_with("/backward/1", {1, 2, 3, 4, 5, 6}), "backward[1]");
}

TEST(AnalyzeCaseRefuses, NoTargetsByTheirNameWhateverTheRowsAre) {
    json request = good_case();
    request["targets"] = request["forward"] = request["backward"] = json::array();
    expect_field(refusal_of(request.dump()), "targets");
    request.erase("backward");
    expect_field(refusal_of(request.dump()), "targets");
    request["forward"] = json::array({json::array()});
    expect_field(refusal_of(request.dump()), "targets");
}

TEST(AnalyzeCaseRefuses, WhatIsNoFiniteNumber) {
    expect_field(refusal_with("/forward/2/1", "3.0"), "forward[2][1]");
    expect_field(refusal_with("/forward/2/1", true), "forward[2][1]");
    expect_field(refusal_with("/targets/1", nullptr), "targets[1]"); // of a reading: it is missing
    expect_field(refusal_with("/backward/0/4", {1}), "backward[0][4]");
    expect_field(refusal_with("/targets/1", "100"), "targets[1]");
    expect_field(refusal_with("/targets/1", 1e13), "targets[1]");
    expect_field(refusal_with("/forward/0/0", 18446744073709551615u), "forward[0][0]");
}

TEST(AnalyzeCaseRefuses, NaNAndInfinityTokensByTheirField) {
    const std::vector<std::string> tokens{"NaN",      "nan",       "-NaN",
                                          "Infinity", "-Infinity", "inf",
                                          "1e999",    "-1E+400",   std::string(400, '9')};
    for (const std::string& token : tokens) {
        json request = good_case();
        request["forward"][2][1] = "HERE";
        std::string text = request.dump();
        text.replace(text.find("\"HERE\""), 6, token);
        const std::string line = refusal_of(text);
        expect_field(line, "forward[2][1]");
        EXPECT_NE(line.find("not a finite number"), std::string::npos) << line;
    }
}

TEST(AnalyzeCaseRefuses, UnknownKeysWithTheNearestKnownOne) {
    json request = good_case();
    request["backwards"] = request["backward"];
    request.erase("backward");
    EXPECT_EQ(refusal_of(request.dump()),
              "refused: backwards: is not a key of a case; did you mean 'backward'?");
    expect_field(refusal_with("/Forward", 1), "Forward");
    expect_field(refusal_with("/cover_factor", 3), "cover_factor");
    expect_field(refusal_with("/axis/travel", 3), "axis.travel");
    expect_field(refusal_with("/line\nbreak", 3), "line?break");
    const std::string line = refusal_with("/spindle_speed", 3);
    for (const char* words : {"known here: \"analysis\", ", "\"targets\"", "'comment'"})
        EXPECT_NE(line.find(words), std::string::npos) << line;
}

TEST(AnalyzeCaseRefuses, RepeatedKeys) {
    std::string text = good_case().dump();
    text.insert(1, R"("unit":"um",)");
    expect_field(refusal_of(text), "unit");
}

TEST(AnalyzeCaseRefuses, WhatIsNoJson) {
    for (const std::string& text : std::vector<std::string>{"", " ", "{", "[1,", "SQLite format 3",
                                                            "{\"a\":tru}", "\"\xff\"", "{} {}"})
        expect_field(refusal_of(text), "json");
    expect_field(refusal_of(std::string(1000, '[')), "json");
    expect_field(refusal_of(std::string((std::size_t{64} << 20) + 1, ' ')), "json");
    expect_field(refusal_of("5"), "case");
    expect_field(refusal_of("null"), "case");
    const std::string line = refusal_of("{\n  \"unit\": oops\n}");
    EXPECT_NE(line.find("line 2"), std::string::npos) << line;
}

// ---- arrays ---------------------------------------------------------------------------------

TEST(AnalyzeCases, ArrayGivesAnArrayOfTheSameLength) {
    const json answer = answer_to(json::array({good_case(), good_case()}));
    ASSERT_EQ(answer.size(), 2u);
    EXPECT_EQ(answer[1], answer_to(good_case()));
    EXPECT_EQ(answer_to(json::array()), json::array());
}

TEST(AnalyzeCases, RefusedElementStandsInItsPlace) {
    json bad = good_case();
    bad["forward"][1][0] = "x";
    std::string text = json::array({good_case(), bad, 5, good_case()}).dump();
    text.replace(text.rfind("-6"), 2, "NaN"); // last reading of the last case
    const CaseAnswer answer = analyze_cases(text);
    EXPECT_EQ(answer.exit_code, 3);
    EXPECT_EQ(answer.error_line, "refused: case[1] forward[1][0]: must be a number, not string "
                                 "(3 of 4 cases refused)");
    const json output = json::parse(answer.output);
    ASSERT_EQ(output.size(), 4u);
    EXPECT_EQ(output[0], answer_to(good_case()));
    EXPECT_EQ(output[1].at("refused").at("field"), "forward[1][0]");
    EXPECT_FALSE(output[1].at("refused").at("reason").get<std::string>().empty());
    EXPECT_EQ(output[1].size(), 1u);
    EXPECT_EQ(output[2].at("refused").at("field"), "case");
    EXPECT_EQ(output[3].at("refused").at("field"), "backward[2][4]");
}

TEST(AnalyzeCases, RepeatedKeyRefusesOnlyItsOwnElement) {
    std::string twice = good_case().dump();
    twice.insert(1, R"("unit":"um",)");
    const CaseAnswer answer =
        analyze_cases("[" + good_case().dump() + "," + twice + "," + good_case().dump() + "]");
    const json output = json::parse(answer.output);
    EXPECT_FALSE(output[0].contains("refused"));
    EXPECT_EQ(output[1].at("refused").at("field"), "unit");
    EXPECT_FALSE(output[2].contains("refused"));
}

} // namespace
} // namespace axiscal::analyze_case_test

#include "tools/axiscal/analyze_case.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace axiscal::probing_and_fit_case_test {
namespace {

using nlohmann::json;

json answer_to(const json& request) {
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    return answer.exit_code == 0 ? json::parse(answer.output) : json{};
}

std::string refused_field(json request, const std::string& key, const json& value) {
    request[json::json_pointer{key}] = value;
    const CaseAnswer answer = analyze_cases(request.dump());
    EXPECT_EQ(answer.exit_code, 3) << key;
    const std::string line = answer.error_line.substr(std::string{"refused: "}.size());
    return line.substr(0, line.find(": "));
}

/// 480 mm/min, a tick of 8 ms: a tooth of 64 um, met in steps of 10 um.
json probing() {
    json series = {{"direction", {1, 1, 0}}};
    for (int i = 0; i < 20; ++i) {
        const double a = 5 + 0.010 * i;
        series["approach_mm"].push_back(a);
        series["trigger_mm"].push_back(12 + a - 0.064 * std::floor(a / 0.064));
    }
    return {
        {"analysis", "probing_delay"}, {"feed_mm_per_min", 480}, {"series", json::array({series})}};
}

TEST(ProbingDelayCase, GivesVariationPeriodAndUnits) {
    const json answer = answer_to(probing());
    EXPECT_EQ(answer.at("feed_mm_per_ms").get<double>(), 0.008);
    const json& series = answer.at("series")[0];
    EXPECT_EQ(series.at("symbol"), "E_TD,XY");
    EXPECT_NEAR(series.at("period_ms").get<double>(), 8, 1e-10);
    EXPECT_EQ(series.at("tooth_slope"), 1);
    EXPECT_NEAR(series.at("variation_ms").get<double>(),
                series.at("variation_mm").get<double>() / 0.008, 1e-12);
    EXPECT_TRUE(series.at("not_evaluated").contains("net_variation_mm"));
    EXPECT_EQ(series.at("not_evaluated").size(), 1u);
}

TEST(ProbingDelayCase, WholePointsAreProjectedOnTheDirection) {
    json request = probing();
    json& series = request["series"][0];
    series["trigger_points_mm"] = json::array();
    for (const json& trigger : series["trigger_mm"]) { // half of the way in x, half in y
        const double part = trigger.get<double>() / std::sqrt(2.0);
        series["trigger_points_mm"].push_back({part, part, 99});
    }
    series.erase("trigger_mm");
    series["symbol"] = "E_TD,45";
    const json answer = answer_to(request);
    EXPECT_EQ(answer.at("series")[0].at("symbol"), "E_TD,45");
    EXPECT_NEAR(answer.at("series")[0].at("variation_mm").get<double>(),
                answer_to(probing()).at("series")[0].at("variation_mm").get<double>(), 1e-13);
}

TEST(ProbingDelayCaseRefuses, EachWrongMember) {
    const json good = probing();
    EXPECT_EQ(refused_field(good, "/feed_mm_per_min", 0), "feed_mm_per_min");
    EXPECT_EQ(refused_field(good, "/feed", 480), "feed");
    EXPECT_EQ(refused_field(good, "/series", json::array()), "series");
    EXPECT_EQ(refused_field(good, "/series", 5), "series");
    EXPECT_EQ(refused_field(good, "/required_touches", 21), "series[0].trigger_mm");
    EXPECT_EQ(refused_field(good, "/required_touches", 0.5), "required_touches");
    EXPECT_EQ(refused_field(good, "/series/0/direction", {1, 0}), "series[0].direction");
    EXPECT_EQ(refused_field(good, "/series/0/direction", {0, 0, 0}), "series[0].direction");
    EXPECT_EQ(refused_field(good, "/series/0/trigger_mm/4", "1"), "series[0].trigger_mm[4]");
    EXPECT_EQ(refused_field(good, "/series/0/reference", 1), "series[0].reference");
    EXPECT_EQ(refused_field(good, "/series/0/reference", true), "series[0].approach_mm");
    EXPECT_EQ(refused_field(good, "/series/0/trigger_points_mm", {{1, 2, 3}}),
              "series[0].trigger_points_mm");
}

json parabola() { // y = 1 + 2 t + 3 (2 t^2 - 1), t = x / 2
    json request = {{"analysis", "chebyshev_fit"}, {"degree", 2}, {"range", {-2, 2}}};
    for (int i = 0; i <= 20; ++i) {
        const double t = -1 + 0.1 * i;
        request["x"].push_back(2 * t);
        request["y"].push_back(1 + 2 * t + 3 * (2 * t * t - 1));
    }
    return request;
}

TEST(ChebyshevFitCase, GivesBothKinds) {
    const json answer = answer_to(parabola());
    EXPECT_EQ(answer.at("method"), "moments");
    const std::vector<double> first{1, 2, 3}, second{-0.5, 1, 1.5};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(answer.at("first_kind")[k].get<double>(), first[k], 1e-14);
        EXPECT_NEAR(answer.at("second_kind")[k].get<double>(), second[k], 1e-14);
    }
    EXPECT_LT(answer.at("residual_rms").get<double>(), 1e-14);
    json request = parabola();
    request.erase("range"); // the smallest and the largest x: the same here
    EXPECT_EQ(answer_to(request), answer);
}

TEST(ChebyshevFitCaseRefuses, EachWrongMember) {
    const json good = parabola();
    EXPECT_EQ(refused_field(good, "/degree", 33), "degree");
    EXPECT_EQ(refused_field(good, "/degree", 1.5), "degree");
    EXPECT_EQ(refused_field(good, "/range", {2, -2}), "range");
    EXPECT_EQ(refused_field(good, "/range", {0, 1}), "x[0]");
    EXPECT_EQ(refused_field(good, "/x", json::array()), "x");
    EXPECT_EQ(refused_field(good, "/y", {1}), "y");
    EXPECT_EQ(refused_field(good, "/y/2", 1e13), "y[2]");
    EXPECT_EQ(refused_field(good, "/ranges", {0, 1}), "ranges");
}

} // namespace
} // namespace axiscal::probing_and_fit_case_test

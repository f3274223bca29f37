#include "tests/support/source_dir.hpp"
#include "tests/unit/cases/asked.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

namespace axiscal::circle_fit_case_test {
namespace {

using nlohmann::json;
using test::answer_to;
using test::refused_field;
using test::with;
using test::without;

json good_case() {
    return {{"analysis", "circle_fit"},
            {"points", {{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}}}};
}

json reference(const std::string& name) {
    std::ifstream file{test::source_dir() + "/tests/reference/" + name};
    return json::parse(file).at("sets");
}

TEST(CircleFitCase, AnswersEveryReferenceSetByTheContract) {
    for (const json& set : reference("nist_circle2d.json")) {
        SCOPED_TRACE(set.at("id"));
        const json answer = answer_to({{"analysis", "circle_fit"}, {"points", set.at("points")}});
        const json& published = set.at("published_nist_lsc");
        const json& mean = answer.at("least_squares");
        EXPECT_NEAR(mean.at("x").get<double>(), published.at("c1").get<double>(), 1e-10);
        EXPECT_NEAR(mean.at("y").get<double>(), published.at("c2").get<double>(), 1e-10);
        EXPECT_NEAR(2 * mean.at("radius").get<double>(), published.at("diameter").get<double>(),
                    1e-10);
        EXPECT_GE(mean.at("condition").get<double>(), 1);
        const json& zone = answer.at("minimum_zone");
        const double width = zone.at("width").get<double>();
        EXPECT_LE(width, set.at("alglib_3_19").at("mzc_width").get<double>() + 1e-13);
        EXPECT_NEAR(zone.at("outer_radius").get<double>() - zone.at("inner_radius").get<double>(),
                    width, 1e-12);
        EXPECT_NEAR(answer.at("arc_deg").get<double>(), set.at("arc_deg").get<double>(), 5e-4);
        EXPECT_NE(answer.contains("maximum_inscribed"), answer.contains("not_evaluated"));
    }
}

TEST(CircleFitCase, TellsTheControlPointsInTheirOrder) {
    const json zone = answer_to(good_case()).at("minimum_zone");
    const json expected = {{{"index", 0}, {"side", "outer"}},
                           {{"index", 1}, {"side", "inner"}},
                           {{"index", 2}, {"side", "outer"}},
                           {{"index", 4}, {"side", "inner"}}};
    EXPECT_EQ(zone.at("control_points"), expected);
    EXPECT_EQ(zone.at("certified"), "local optimum");
    EXPECT_EQ(zone.at("search"), "exhaustive");
    EXPECT_EQ(zone.at("wide"), true);
    EXPECT_TRUE(zone.contains("note"));
}

TEST(CircleFitCase, TellsTheUnitOnlyWhereOneIsGiven) {
    EXPECT_FALSE(answer_to(good_case()).contains("unit"));
    EXPECT_EQ(answer_to(with(good_case(), "/unit", "um")).at("unit"), "um");
    EXPECT_EQ(refused_field(with(good_case(), "/unit", "inch")), "unit");
}

TEST(CircleFitCase, EvaluatesArcsOfAnyLength) {
    for (const double degrees : {300.0, 100.0, 10.0, 1.0, 0.01}) {
        json points = json::array();
        for (int i = 0; i < 9; ++i) {
            const double angle = degrees * i / 8 * std::numbers::pi / 180;
            points.push_back({100 * std::cos(angle), 100 * std::sin(angle)});
        }
        const json answer = answer_to({{"analysis", "circle_fit"}, {"points", points}});
        EXPECT_NEAR(answer.at("arc_deg").get<double>(), degrees, 1e-3 * degrees);
        EXPECT_LE(answer.at("minimum_zone").at("width").get<double>(), 1e-13);
        EXPECT_EQ(answer.contains("maximum_inscribed"), degrees > 180);
    }
}

TEST(CircleFitCase, MeetsThreePoints) {
    const json answer = answer_to(with(good_case(), "/points", {{0, 0}, {4, 0}, {0, 3}}));
    EXPECT_EQ(answer.at("minimum_zone").at("width"), 0);
    EXPECT_EQ(answer.at("minimum_zone").at("gap"), 0);
    EXPECT_NEAR(answer.at("minimum_zone").at("outer_radius").get<double>(), 2.5, 1e-15);
}

TEST(CircleFitCaseRefuses, WhatIsNoListOfPoints) {
    EXPECT_EQ(refused_field(without(good_case(), "points")), "points");
    EXPECT_EQ(refused_field(with(good_case(), "/points", 5)), "points");
    EXPECT_EQ(refused_field(with(good_case(), "/points", json::array())), "points");
    EXPECT_EQ(refused_field(with(good_case(), "/points/2", {1, 2, 3})), "points[2]");
    EXPECT_EQ(refused_field(with(good_case(), "/points/2", 7)), "points[2]");
    EXPECT_EQ(refused_field(with(good_case(), "/points/2/1", "7")), "points[2][1]");
    EXPECT_EQ(refused_field(with(good_case(), "/points/2/0", 1e13)), "points[2]");
    EXPECT_EQ(refused_field(with(good_case(), "/points", {{1, 2}, {3, 4}, {1, 2}})), "points");
    EXPECT_EQ(refused_field(with(good_case(), "/points", {{1, 1}, {3, 3}, {5, 5}})), "points");
    EXPECT_EQ(refused_field(with(good_case(), "/radius", 3)), "radius");
    test::expect_numbers_in_numbers_out(good_case());
}

TEST(CircleFitCaseRefuses, NotFiniteTokensByTheirField) {
    std::string text = good_case().dump();
    text.replace(text.find("[5,8]"), 5, "[5,-Infinity]");
    EXPECT_TRUE(analyze_cases(text).error_line.starts_with(
        "refused: points[2][1]: -Infinity is not a finite number"));
}

} // namespace
} // namespace axiscal::circle_fit_case_test

#include "asked.hpp"

#include <cmath>

namespace axiscal::geometry_case_test {
namespace {

using nlohmann::json;
using test::answer_to;
using test::refused_field;
using test::with;
using test::without;

json line() {
    return json::parse(R"({"analysis":"straightness","unit":"um","target_unit":"mm",
        "targets":[0,100,200,300],"forward":[[0,2],[5,7],[5,7],[0,2]],
        "backward":[[-2,0],[3,5],[3,5],[-2,0]]})");
}

json angles() {
    return json::parse(R"({"analysis":"straightness","unit":"um","target_unit":"mm",
        "angle_unit":"um/m","base":100,"start":50,"angles":[50,0,-50]})");
}

TEST(StraightnessCase, MeanOfBothDirectionsCounts) {
    const json answer = answer_to(line());
    EXPECT_EQ(answer.at("line"), (json{0, 5, 5, 0}));
    EXPECT_EQ(answer.at("B"), 2);
    EXPECT_EQ(answer.at("from"), "readings");
    for (const char* reference : {"end_points", "least_squares", "minimum_zone"})
        EXPECT_NEAR(answer.at(reference).at("straightness").get<double>(), 5, 1e-14) << reference;
}

TEST(StraightnessCase, AnglesMakeTheSameLine) {
    const json answer = answer_to(angles());
    EXPECT_EQ(answer.at("from"), "angles");
    EXPECT_NEAR(answer.at("end_points").at("straightness").get<double>(), 5, 1e-14);
    EXPECT_EQ(answer.at("line").size(), 4u);
    json rows = without(angles(), "angles");
    rows["forward"] = {{50, 52}, {0, 2}, {-50, -48}};
    rows["backward"] = {{48, 50}, {-2, 0}, {-52, -50}};
    EXPECT_NEAR(answer_to(rows).at("end_points").at("straightness").get<double>(), 5, 1e-14);
}

TEST(StraightnessCase, UnitOfTheTargetsCountsForTheSlope) {
    const json tilted = json::parse(R"({"analysis":"straightness","unit":"um","target_unit":"mm",
        "targets":[0,500,1000],"deviations":[0,10,20]})");
    EXPECT_NEAR(answer_to(tilted).at("least_squares").at("slope").get<double>(), 20e-6, 1e-19);
    EXPECT_NEAR(
        answer_to(with(tilted, "/target_unit", "um")).at("least_squares").at("slope").get<double>(),
        20e-3, 1e-16);
}

TEST(StraightnessCaseRefuses, MixturesByTheKey) {
    EXPECT_EQ(refused_field(with(line(), "/deviations", {0, 1, 1, 0})), "forward");
    EXPECT_EQ(refused_field(with(line(), "/base", 100)), "base");
    EXPECT_EQ(refused_field(with(line(), "/forward/2", {1})), "forward[2]");
    EXPECT_EQ(refused_field(with(line(), "/targets", {0, 100, 50, 300})), "targets[2]");
    EXPECT_EQ(refused_field(without(line(), "unit")), "unit");
    EXPECT_EQ(refused_field(with(angles(), "/targets", {1, 2})), "targets");
    EXPECT_EQ(refused_field(without(angles(), "angle_unit")), "angle_unit");
    EXPECT_EQ(refused_field(with(angles(), "/angles", json::array())), "angles");
    EXPECT_EQ(refused_field(with(angles(), "/angles/1", "x")), "angles[1]");
}

json square() {
    return json::parse(R"({"analysis":"squareness","unit":"um","target_unit":"mm",
        "first":{"axis":"X","targets":[0,100,200],"deviations":[0,3,6]},
        "second":{"axis":"Y","angle_unit":"urad","base":100,"angles":[-70,-70]}})");
}

TEST(SquarenessCase, OpensByWhatTheAxesTurnAway) {
    EXPECT_NEAR(answer_to(square()).at("squareness_um_per_m").get<double>(), 40, 1e-6);
    EXPECT_NEAR(answer_to(with(square(), "/second/positive_towards_other", -1))
                    .at("squareness_um_per_m")
                    .get<double>(),
                -100, 1e-6);
    EXPECT_NEAR(answer_to(with(square(), "/optical_square_error_urad", 2.5))
                    .at("squareness_um_per_m")
                    .get<double>(),
                42.5, 1e-6);
    EXPECT_NE(answer_to(square()).at("sign").get<std::string>().find("exceeds 90"),
              std::string::npos);
}

TEST(SquarenessCaseRefuses, ByTheSideAndTheKey) {
    EXPECT_EQ(refused_field(without(square(), "second")), "second");
    EXPECT_EQ(refused_field(with(square(), "/first/targets", {0, 0, 1})), "first.targets[1]");
    EXPECT_EQ(refused_field(with(square(), "/second/base", 0)), "second.base");
    EXPECT_EQ(refused_field(with(square(), "/first/unit", "um")), "first.unit");
    EXPECT_EQ(refused_field(with(square(), "/first/positive_towards_other", 0)),
              "first.positive_towards_other");
    EXPECT_EQ(refused_field(with(square(), "/optical_square_error_urad", 1e7)),
              "optical_square_error_urad");
}

json pitch() {
    return json::parse(R"({"analysis":"angular","unit":"arcsec","target_unit":"mm","motion":"pitch",
        "targets":[0,100],"forward":[[0,0.5],[2,2.5]],"backward":[[0,0],[1,1]]})");
}

TEST(AngularCase, IsTheSchemeOfPositioningInTheUnitOfTheAngle) {
    const json answer = answer_to(pitch());
    EXPECT_EQ(answer.at("unit"), "arcsec");
    EXPECT_NEAR(answer.at("parameters").at("E").at("value").get<double>(), 2.25, 1e-15);
    // 2 s + 2 s + |B|: s = sqrt(0.125) forward, 0 backward
    EXPECT_NEAR(answer.at("parameters").at("R").at("value").get<double>(),
                std::max(2 * std::sqrt(0.125) + 1.25, 4 * std::sqrt(0.125)), 1e-14);
    EXPECT_NEAR(answer.at("rad_per_unit").get<double>(), std::acos(-1) / 648000, 1e-21);
    EXPECT_EQ(refused_field(with(pitch(), "/motion", "heave")), "motion");
    EXPECT_EQ(refused_field(with(pitch(), "/targets", {0, 0})), "targets[1]");
    EXPECT_EQ(refused_field(with(pitch(), "/unit", "mm")), "unit");
}

json cube() {
    json request = json::parse(R"({"analysis":"diagonals","unit":"mm",
        "box":{"x":1000,"y":1000,"z":1000},"diagonals":[]})");
    for (const auto& signs : {json{1, 1, 1}, json{1, 1, -1}, json{1, -1, 1}, json{1, -1, -1}})
        request["diagonals"].push_back({{"signs", signs},
                                        {"targets", {0, 850, 1700}},
                                        {"forward", {{0, 1}, {2, 1}, {3, 3}}},
                                        {"backward", {{0, 0}, {1, 1}, {2, 2}}}});
    return request;
}

TEST(DiagonalsCase, ZeroIsAtTheStartAndTheWorstCounts) {
    json request = cube();
    request["diagonals"][2]["forward"][2] = {5, 5};
    const json answer = answer_to(request);
    EXPECT_NEAR(answer.at("diagonals")[0].at("positions")[0].at("mean").get<double>(), 0, 1e-15);
    EXPECT_EQ(answer.at("body").at("E_d"), 5);
    EXPECT_EQ(answer.at("body").at("B_d"), 3);
    EXPECT_TRUE(answer.contains("from_body_diagonals"));
    EXPECT_TRUE(answer.at("not_evaluated").contains("axis_scales"));
    EXPECT_EQ(answer.at("remarks").size(), 2u); // two approaches, three targets on 1.7 m
}

TEST(DiagonalsCaseRefuses, ByTheField) {
    EXPECT_EQ(refused_field(without(cube(), "box")), "box");
    EXPECT_EQ(refused_field(with(cube(), "/box/z", 0)), "box.z");
    EXPECT_EQ(refused_field(with(cube(), "/diagonals/1/signs", {1, 1})), "diagonals[1].signs");
    EXPECT_EQ(refused_field(with(cube(), "/diagonals/1/signs", {1, 1, 0.5})), "diagonals[1].signs");
    EXPECT_EQ(refused_field(with(cube(), "/diagonals/1/signs", {1, 1, 1})), "diagonals[1].signs");
    EXPECT_EQ(refused_field(with(cube(), "/diagonals/3/targets/2", 2000)), "diagonals[3].targets");
    EXPECT_EQ(refused_field(with(cube(), "/diagonals/3/backward/1", {1})),
              "diagonals[3].backward[1]");
    EXPECT_EQ(refused_field(with(cube(), "/kind", "volumetric")), "kind");
}

json steps() {
    json request = json::parse(R"({"analysis":"diagonals","kind":"step","unit":"um",
        "box":{"x":1,"y":2,"z":3},"diagonals":[]})");
    for (const auto& signs : {json{1, 1, 1}, json{1, 1, -1}, json{1, -1, 1}, json{1, -1, -1}})
        request["diagonals"].push_back({{"signs", signs}, {"deviations", {0, 1, 1, 2, 2, 3}}});
    return request;
}

TEST(DiagonalsCase, StepEstimationCarriesItsAssumptions) {
    const json answer = answer_to(steps());
    EXPECT_EQ(answer.at("steps"), 2);
    EXPECT_GE(answer.at("assumptions").size(), 5u);
    EXPECT_EQ(answer.at("moving").at("y").at("positions"), (json{0, 1, 2}));
    EXPECT_EQ(answer.at("moving").at("z").at("x").size(), 3u);
    EXPECT_EQ(refused_field(with(steps(), "/order", "xxy")), "order");
    EXPECT_EQ(refused_field(with(steps(), "/diagonals/1/deviations", {0, 1})),
              "diagonals[1].deviations");
    EXPECT_EQ(refused_field(with(cube(), "/order", "xyz")), "order");
}

TEST(GeometryCaseLaws, NumbersInNumbersOut) {
    for (const json& request : {line(), angles(), square(), pitch(), cube(), steps()})
        test::expect_numbers_in_numbers_out(request);
}

} // namespace
} // namespace axiscal::geometry_case_test

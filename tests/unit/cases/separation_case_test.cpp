#include "tests/support/source_dir.hpp"
#include "tools/axiscal/analyze_case.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace axiscal::separation_case_test {
namespace {

using nlohmann::json;

json answer_to(const std::string& text) {
    const CaseAnswer answer = analyze_cases(text);
    EXPECT_EQ(answer.exit_code, 0) << answer.error_line;
    return answer.exit_code == 0 ? json::parse(answer.output) : json{};
}

std::string refusal_of(const std::string& text) {
    const CaseAnswer answer = analyze_cases(text);
    EXPECT_EQ(answer.exit_code, 3) << text.substr(0, 300);
    EXPECT_TRUE(answer.output.empty());
    EXPECT_EQ(answer.error_line.find('\n'), std::string::npos);
    return answer.error_line;
}

void expect_field(const std::string& line, const std::string& field) {
    EXPECT_TRUE(line.starts_with("refused: " + field + ": ")) << line;
}

json reference_sets() {
    std::ifstream file{test::source_dir() + "/tests/reference/chebyshev_separation.json"};
    return json::parse(file).at("cases");
}

/// The case as the contract writes it.
json request_for(const json& set, const std::string& constant = "reference") {
    return {{"analysis", "error_separation"},
            {"basis", "chebyshev2"},
            {"order", set.at("order")},
            {"constant", constant},
            {"signs", {{1, 1, -1}, {1, 1, -1}, {1, 1, -1}}},
            {"ranges_mm", set.at("ranges")},
            {"reference_mm", set.at("ref")},
            {"points_mm", set.at("points")},
            {"deviation_um", set.at("delta")}};
}

void expect_agreement(const json& answer, const json& theirs, bool paper) {
    for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_EQ(answer.at("rank")[row], theirs.at("rank")[row]);
        EXPECT_EQ(answer.at("columns")[row], theirs.at("ncol")[row]);
        EXPECT_NEAR(answer.at("condition")[row].get<double>(), theirs.at("cond")[row].get<double>(),
                    1e-8);
        EXPECT_LT(answer.at("residual_rms_um")[row].get<double>(), 1e-12);
    }
    for (const auto& [name, terms] : theirs.at("terms").items()) {
        const std::string curve = name.substr(1); // "dxy" is xy
        for (std::size_t k = 1; k <= 5; ++k)
            EXPECT_NEAR(answer.at("terms").at(curve)[k - 1].get<double>(),
                        terms.at(std::to_string(k)).get<double>(), 1e-11);
        if (paper) {
            EXPECT_NEAR(answer.at("constants").at(curve).get<double>(), terms.at("0").get<double>(),
                        1e-11);
        }
    }
}

TEST(SeparationCase, AgreesWithTheReferenceInBothBases) {
    for (const json& set : reference_sets()) {
        SCOPED_TRACE(set.at("id"));
        const json answer = answer_to(request_for(set).dump());
        expect_agreement(answer, set.at("recomputed_ref_basis"), false);
        EXPECT_FALSE(answer.contains("constants"));
        EXPECT_EQ(answer.at("not_separable").empty(), set.at("identifiable").get<bool>());
        expect_agreement(answer_to(request_for(set, "paper").dump()),
                         set.at("recomputed_paper_basis_minnorm"), true);
    }
}

TEST(SeparationCase, ShowsNoCurveThatThePointsLeaveOpen) {
    const json answer = answer_to(request_for(reference_sets()[1]).dump());
    EXPECT_EQ(answer.at("not_separable"), json({"xz", "yz", "zz"}));
    for (const char* open : {"xz", "yz", "zz"}) {
        EXPECT_FALSE(answer.at("curves").contains(open));
        EXPECT_TRUE(answer.at("terms").contains(open));
        EXPECT_TRUE(answer.at("not_evaluated").contains(std::string{"curves."} + open));
    }
    EXPECT_EQ(answer.at("curves").size(), 6u);
    EXPECT_EQ(answer.at("dropped_subspace").size(), 3u);
    // the other six hang on the reading at the reference, and that is told
    EXPECT_EQ(answer.at("rests_on_reference").size(), 6u);
}

TEST(SeparationCase, CurvesAreZeroAtTheReference) {
    const json answer = answer_to(request_for(reference_sets()[0]).dump());
    for (const auto& [name, curve] : answer.at("curves").items()) {
        EXPECT_EQ(curve.at("position_mm").size(), 21u);
        EXPECT_NEAR(curve.at("value_um")[10].get<double>(), 0, 1e-14) << name; // the middle
    }
}

TEST(SeparationCase, OrdersMayBeMixedOrChosen) {
    json request = request_for(reference_sets()[0]);
    request["order"] = {5, 4, 3};
    EXPECT_EQ(answer_to(request.dump()).at("terms").at("zz").size(), 3u);
    request["order"] = {{5, 3, 3}, {3, 5, 3}, {3, 3, 5}};
    EXPECT_EQ(answer_to(request.dump()).at("terms").at("yy").size(), 5u);
    EXPECT_EQ(answer_to(request.dump()).at("terms").at("yx").size(), 3u);
    request["order"] = "auto";
    const json answer = answer_to(request.dump());
    EXPECT_EQ(answer.at("order_criterion"), "AICc");
    for (const json& row : answer.at("order")) // the truth has five terms of every curve
        EXPECT_EQ(row, json({5, 5, 5}));
}

TEST(SeparationCase, ReadingAtTheReferenceIsTakenOut) {
    const json set = reference_sets()[0];
    json request = request_for(set);
    for (json& deviation : request["deviation_um"])
        for (std::size_t a = 0; a < 3; ++a)
            deviation[a] = deviation[a].get<double>() + 7.5;
    request["reference_deviation_um"] = {7.5, 7.5, 7.5};
    expect_agreement(answer_to(request.dump()), set.at("recomputed_ref_basis"), false);
}

// ---- workpiece 1 ------------------------------------------------------------------------------

json features() {
    return json::parse(R"({"analysis":"error_separation","workpiece":1,"features":[
        {"axis":"x","direction":"x","nominal_mm":[-40,-20,0,20,40],
         "on_machine_mm":[-39.999,-20,0.001,20,40.002],"cmm_mm":[-39.996,-19.998,0.001,19.998,39.998]}]})");
}

TEST(SeparationCase, WorkpieceOneGivesTheThreeDeviations) {
    const json feature = answer_to(features().dump()).at("features")[0];
    const std::vector<double> dynamic{1, 0, 1, 0, 2}, total{4, 2, 1, -2, -2};
    for (std::size_t i = 0; i < 5; ++i) { // 40 mm in double: 7e-15 mm a reading
        EXPECT_NEAR(feature.at("dynamic_um")[i].get<double>(), dynamic[i], 2e-11);
        EXPECT_NEAR(feature.at("total_um")[i].get<double>(), total[i], 2e-11);
        EXPECT_NEAR(feature.at("quasi_static_um")[i].get<double>(), total[i] - dynamic[i], 2e-11);
    }
    EXPECT_TRUE(answer_to(features().dump()).at("not_evaluated").contains("quasi_static"));
}

TEST(SeparationCase, QuasiStaticFitGoesIntoTheThreeAxisCaseAsItStands) {
    // workpiece 1: a quasi-static scale error of 0.1 um/mm in x, no dynamic error
    json first = features();
    json& feature = first["features"][0];
    feature["on_machine_mm"] = feature["nominal_mm"];
    feature["cmm_mm"] = {-40.004, -20.002, 0, 20.002, 40.004};
    first["order"] = 3;
    first["ranges_mm"] = {{"x", {-50, 50}}, {"y", {-50, 50}}, {"z", {0, 80}}};
    first["reference_mm"] = {0, 0, 40};
    const json known = answer_to(first.dump()).at("quasi_static");
    // x = 50 t and U_1 = 2 t: 0.1 um/mm is 2.5 U_1
    EXPECT_NEAR(known.at("terms").at("xx")[0].get<double>(), 2.5, 1e-11);

    const json set = reference_sets()[0];
    json request = request_for(set);
    for (std::size_t i = 0; i < set.at("points").size(); ++i)
        request["deviation_um"][i][0] =
            set.at("delta")[i][0].get<double>() + 0.1 * set.at("points")[i][0].get<double>();
    request["quasi_static"] = known;
    const json answer = answer_to(request.dump());
    EXPECT_TRUE(answer.at("quasi_static_subtracted").get<bool>());
    expect_agreement(answer, set.at("recomputed_ref_basis"), false);
}

// ---- the table of both measurements -------------------------------------------------------------

TEST(SeparationTable, StandsForWorkpieceOneAlone) {
    const json answer = answer_to("\xef\xbb\xbf"
                                  "feature,nominal_x,nominal_y,on_machine_y,cmm_y\r\n"
                                  "\"slot, long\",-10,40,40.001,40.004\r\n"
                                  "# a remark\r\n"
                                  "\"slot, long\",10,40,+40.002,40.002\r\n"
                                  "corner,0,0,0.001,0.001");
    ASSERT_EQ(answer.at("features").size(), 2u);
    const json& slot = answer.at("features")[0];
    EXPECT_EQ(slot.at("feature"), "slot, long");
    EXPECT_EQ(slot.at("axis"), "x"); // the one axis that moved
    EXPECT_EQ(slot.at("direction"), "y");
    EXPECT_NEAR(slot.at("quasi_static_um")[0].get<double>(), 3, 1e-10);
    EXPECT_FALSE(answer.at("features")[1].contains("axis"));
    EXPECT_TRUE(answer.at("not_evaluated").contains("features.corner"));
}

TEST(SeparationTable, GivesTheSameAsTheLists) {
    std::string csv = "feature,nominal_x,on_machine_x,cmm_x\n";
    json request = features();
    const json& feature = request.at("features")[0];
    for (std::size_t i = 0; i < 5; ++i)
        csv += "block," + feature.at("nominal_mm")[i].dump() + "," +
               feature.at("on_machine_mm")[i].dump() + "," + feature.at("cmm_mm")[i].dump() + "\n";
    const json model = {{"ranges_mm", {{"x", {-50, 50}}, {"y", {-1, 1}}, {"z", {-1, 1}}}},
                        {"reference_mm", {0, 0, 0}},
                        {"order", 2}};
    request.update(model);
    const json by_lists = answer_to(request.dump());
    request.erase("features");
    request["measurements_csv"] = csv;
    json by_table = answer_to(request.dump());
    EXPECT_EQ(by_table.at("dynamic"), by_lists.at("dynamic"));
    EXPECT_EQ(by_table.at("quasi_static"), by_lists.at("quasi_static"));
    EXPECT_EQ(answer_to(csv).at("features"), by_table.at("features"));
}

TEST(SeparationTable, CarriesThePointsOfWorkpieceTwo) {
    const json set = reference_sets()[0];
    std::string csv = "feature,nominal_x,nominal_y,nominal_z,on_machine_x,on_machine_y,"
                      "on_machine_z,cmm_x,cmm_y,cmm_z\n";
    for (std::size_t i = 0; i < set.at("points").size(); ++i) {
        csv += "cone";
        for (const double part : {0.0, 1e-3, 2e-3}) // dynamic once, total twice the truth
            for (std::size_t a = 0; a < 3; ++a)
                csv += "," + json(set.at("points")[i][a].get<double>() +
                                  part * set.at("delta")[i][a].get<double>())
                                 .dump();
        csv += "\n";
    }
    json request = request_for(set);
    request.erase("points_mm");
    request.erase("deviation_um");
    request["measurements_csv"] = csv;
    for (const char* kind : {"dynamic", "total", "quasi_static"}) {
        request["deviation"] = kind;
        const json answer = answer_to(request.dump());
        const double factor = std::string{kind} == "total" ? 2 : 1;
        for (const auto& [name, terms] : set.at("truth_terms").items())
            for (std::size_t k = 1; k <= 5; ++k) // 80 mm in double: 1e-11 um a reading
                EXPECT_NEAR(answer.at("terms").at(name.substr(1))[k - 1].get<double>(),
                            factor * terms.at(std::to_string(k)).get<double>(), 1e-10);
    }
}

TEST(SeparationTableRefuses, WithTheNumberOfTheLine) {
    const std::string header = "feature,nominal_x,on_machine_x,cmm_x\n";
    const auto line = [&](const std::string& rows, const std::string& number,
                          const std::string& word) {
        const std::string refusal = refusal_of(header + rows);
        expect_field(refusal, "measurements_csv line " + number);
        EXPECT_NE(refusal.find(word), std::string::npos) << refusal;
    };
    line("a,1,2\n", "2", "cells");
    line("a,1,2,3\n\na,1,2,x\n", "4", "cmm_x");
    line("a,1,2,nan\n", "2", "cmm_x");
    line("a,1,2,1e999\n", "2", "cmm_x");
    line("a,\"1x\",2,3\n", "2", "nominal_x");
    line("a,1,2,\n", "2", "cmm_x is missing");
    line("a,,2,3\n", "2", "nominal_x is missing");
    line("a,1,,\n", "2", "no measured coordinate");
    line(",1,2,3\n", "2", "feature");
    line("\xff,1,2,3\n", "2", "UTF-8");
    line("", "1", "no point");
    expect_field(refusal_of("feature,nominal_x,cmm\n"), "measurements_csv line 1");
    expect_field(refusal_of("feature,nominal_x,nominal_x_mm\n"), "measurements_csv line 1");
    expect_field(refusal_of("feature,nominal_x,on_machine_x,cmm_x,nominal_y,on_machine_y,cmm_y\n"
                            "a,1,1,1,2,2,2\na,2,2,2,2,,\n"),
                 "measurements_csv line 3");
    expect_field(refusal_of(header + "a,1e13,2,3\n"), "features[0].nominal_mm[0]");
}

// ---- refusals ---------------------------------------------------------------------------------

TEST(SeparationCaseRefuses, EachWrongMember) {
    const json good = request_for(reference_sets()[0]);
    const auto with = [&](const std::string& key, const json& value, const std::string& field) {
        json request = good;
        request[json::json_pointer{key}] = value;
        expect_field(refusal_of(request.dump()), field);
    };
    for (const char* key : {"ranges_mm", "reference_mm", "points_mm", "deviation_um"}) {
        json request = good;
        request.erase(key);
        EXPECT_EQ(refusal_of(request.dump()), std::string{"refused: "} + key + ": is missing");
    }
    with("/basis", "legendre", "basis");
    with("/constant", "free", "constant");
    with("/order", 21, "order");
    with("/order", 2.5, "order");
    with("/order", {5, 5}, "order");
    with("/order", {0, 0, 0}, "order");
    with("/order", "best", "order");
    with("/max_order", 3, "max_order");
    with("/signs", {{1, 1, -1}}, "signs");
    with("/signs/1/2", 0, "signs[1][2]");
    with("/ranges_mm/y", {50, -50}, "ranges_mm.y");
    with("/ranges_mm/w", {50, -50}, "ranges_mm.w");
    with("/reference_mm", {0, 0}, "reference_mm");
    with("/points_mm/3", {0, 0}, "points_mm[3]");
    with("/points_mm/3/2", 81, "points_mm[3][2]");
    with("/deviation_um/3/2", "1", "deviation_um[3][2]");
    with("/deviation_um", json::array(), "deviation_um");
    with("/workpiece", 3, "workpiece");
    with("/quasi_static", {{"terms", {{"xw", {1}}}}}, "quasi_static.terms.xw");
    with("/quasi_static", json::object(), "quasi_static.terms");
    with("/reference_deviation_um", {1, 2}, "reference_deviation_um");
    with("/measurements_csv", "feature,nominal_x\n", "points_mm");
    with("/deviation", "total", "deviation");
}

TEST(SeparationCaseRefuses, FeaturesThatAreNone) {
    const auto with = [&](const std::string& key, const json& value, const std::string& field) {
        json request = features();
        request[json::json_pointer{key}] = value;
        expect_field(refusal_of(request.dump()), field);
    };
    with("/features", json::array(), "features");
    with("/features", 5, "features");
    with("/features/0", 5, "features[0]");
    with("/features/0/axis", "a", "features[0].axis");
    with("/features/0/cmm_mm", {1, 2}, "features[0].cmm_mm");
    with("/features/0/positions_mm", {{"x", {1, 2}}}, "features[0].positions_mm");
    with("/features/0/speed", 5, "features[0].speed");
    with("/points_mm", json::array(), "points_mm");
}

} // namespace
} // namespace axiscal::separation_case_test

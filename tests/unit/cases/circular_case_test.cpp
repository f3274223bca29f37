// The contract of "analysis": "circular".

#include "asked.hpp"
#include "tests/support/source_dir.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

namespace axiscal::circular_case_test {
namespace {

using nlohmann::json;
using test::answer_to;
using test::refused_field;
using test::with;
using test::without;

/// Squareness beta and lag difference tau, R 150 mm, 12.5 mm/s: closed forms in every figure.
json made_case(double beta, double tau, double from_deg = 0, double to_deg = 359, double step = 5) {
    json request = {{"analysis", "circular"}, {"nominal_radius_mm", 150}, {"feed_mm_per_min", 750}};
    for (const double sg : {1.0, -1.0}) {
        json trace = {{"sense", sg > 0 ? "ccw" : "cw"},
                      {"angle_rad", json::array()},
                      {"radial_deviation_mm", json::array()}};
        for (double angle = from_deg; angle < to_deg + 1e-9; angle += step) {
            const double theta = angle * std::numbers::pi / 180;
            trace["angle_rad"].push_back(theta);
            trace["radial_deviation_mm"].push_back((sg * 12.5 * tau - 150 * beta) *
                                                   std::sin(theta) * std::cos(theta));
        }
        request["traces"].push_back(std::move(trace));
    }
    return request;
}

json one_sense(json request, std::size_t which) {
    request["traces"].erase(1 - which);
    return request;
}

double value(const json& answer, const char* pointer) {
    return answer.at(json::json_pointer{pointer}).get<double>();
}

json reference_cases() {
    std::ifstream file{test::source_dir() + "/tests/reference/ballbar_synthetic.json"};
    return json::parse(file).at("cases");
}

TEST(CircularCase, AnswersTheNoisyArcOfTheReferenceByTheContractsKeys) {
    const json set = reference_cases().back();
    json request = {{"analysis", "circular"},
                    {"nominal_radius_mm", set.at("request").at("R")},
                    {"feed_mm_per_min", 60 * set.at("request").at("feed").get<double>()}};
    for (const char* sense : {"ccw", "cw"})
        request["traces"].push_back(
            {{"sense", sense},
             {"angle_rad", set.at("request").at(sense).at("theta")},
             {"radial_deviation_mm", set.at("request").at(sense).at("dr")}});
    const json answer = answer_to(request);
    const std::map<std::string, std::string> key{{"square", "squareness_rad"},
                                                 {"servo", "servo_lag_difference_s"},
                                                 {"backlash_x", "backlash_x_mm"},
                                                 {"backlash_y", "backlash_y_mm"},
                                                 {"lateral_x", "lateral_play_x_mm"},
                                                 {"lateral_y", "lateral_play_y_mm"},
                                                 {"straight_x", "straightness_x_mm"},
                                                 {"straight_y", "straightness_y_mm"},
                                                 {"scale_x", "scale_x"},
                                                 {"scale_y", "scale_y"},
                                                 {"off_x_ccw", "center_ccw_mm/0"},
                                                 {"off_y_ccw", "center_ccw_mm/1"},
                                                 {"off_x_cw", "center_cw_mm/0"},
                                                 {"off_y_cw", "center_cw_mm/1"}};
    for (const auto& [theirs, ours] : key)
        EXPECT_NEAR(value(answer, ("/diagnosis/" + ours).c_str()),
                    set.at("recomputed_fit").at(theirs).get<double>(), 1e-12)
            << ours;
    const json& figures = set.at("recomputed_iso230_4");
    for (const std::string sense : {"ccw", "cw"}) {
        const json& of = figures.at(sense);
        EXPECT_NEAR(value(answer, ("/parameters/G_" + sense + "/value").c_str()),
                    of.at("G_mzc").get<double>(), 1e-9);
        EXPECT_NEAR(value(answer, ("/parameters/G_" + sense + "/least_squares").c_str()),
                    of.at("G_lsc").get<double>(), 1e-9);
        EXPECT_NEAR(value(answer, ("/parameters/F_max_" + sense + "/value").c_str()),
                    of.at("F_max").get<double>(), 1e-12);
        EXPECT_EQ(answer.at("parameters").at("F_min_" + sense).at("centre"), "set_up");
    }
    EXPECT_NEAR(value(answer, "/parameters/G_b/value"), figures.at("bi").at("Gb_mzc").get<double>(),
                1e-9);
    EXPECT_NEAR(value(answer, "/parameters/D/value"), figures.at("bi").at("D").get<double>(), 1e-9);
    EXPECT_EQ(answer.at("parameters").at("G_b").at("method"), "minimum_zone");
    EXPECT_EQ(answer.at("diagnosis").at("rank"), 14);
}

TEST(CircularCase, StatesWhatItIs) {
    const json answer = answer_to(with(made_case(5e-5, 0), "/axes", {"Z", "X"}));
    EXPECT_EQ(answer.at("standard"), "ISO 230-4");
    EXPECT_EQ(answer.at("unit"), "mm");
    EXPECT_EQ(answer.at("plane"), "ZX");
    EXPECT_EQ(answer.at("source"), "external");
    EXPECT_EQ(answer.at("compensation"), "as_measured");
    EXPECT_FALSE(answer.contains("not_evaluated"));
    EXPECT_FALSE(answer.contains("budget"));
    EXPECT_EQ(answer.at("traces")[0].at("full_circle"), true);
    const json& first = answer.at("diagnosis").at("ranking")[0];
    EXPECT_EQ(first.at("cause"), "squareness");
    EXPECT_NE(first.at("words").get<std::string>().find("Z and X"), std::string::npos);
}

TEST(CircularCase, OneSenseAnswersWhatItCanAndNamesTheRest) {
    const json answer = answer_to(one_sense(made_case(5e-5, 0), 0));
    EXPECT_NEAR(value(answer, "/parameters/G_ccw/value"), 150 * 5e-5, 1e-12);
    for (const char* key : {"G_cw", "G_b", "F_max_cw", "F_min_cw", "D"}) {
        EXPECT_FALSE(answer.at("parameters").contains(key)) << key;
        EXPECT_TRUE(answer.at("not_evaluated").contains(key)) << key;
    }
    EXPECT_FALSE(answer.at("diagnosis").contains("squareness_rad"));
    EXPECT_FALSE(answer.at("diagnosis").contains("center_cw_mm"));
    EXPECT_FALSE(answer.at("diagnosis").at("not_separable").empty());
}

TEST(CircularCase, FeedbackSignalsAreCalledGfAndAreNeverMixed) {
    const json feedback = with(made_case(5e-5, 0), "/source", "feedback");
    const json answer = answer_to(feedback);
    EXPECT_EQ(answer.at("source"), "feedback");
    EXPECT_NEAR(value(answer, "/parameters/G_f_b/value"), 150 * 5e-5, 1e-12);
    for (const char* key : {"G_ccw", "G_b", "F_max_ccw", "D"})
        EXPECT_FALSE(answer.at("parameters").contains(key)) << key;
    EXPECT_EQ(refused_field(with(feedback, "/traces/1/source", "external")), "traces[1].source");
    EXPECT_EQ(refused_field(with(made_case(5e-5, 0), "/traces/1/source", "feedback")),
              "traces[1].source");
    EXPECT_EQ(refused_field(with(made_case(5e-5, 0), "/source", "Feedback signals")), "source");
    EXPECT_EQ(answer_to(with(made_case(5e-5, 0), "/source", "a ballbar of 2019")).at("source"),
              "external")
        << "a remark";
}

TEST(CircularCase, TemperatureMovesFAndDAndNothingElse) {
    const json plain = made_case(5e-5, 2e-4);
    const json warm = with(plain, "/temperature",
                           {{"bar_degC", 25},
                            {"machine_degC", 23},
                            {"bar_expansion_per_K", 1.2e-6},
                            {"machine_expansion_per_K", 11.5e-6},
                            {"bar_length_mm", 150.01}});
    const double shift = 150.01 * 1.2e-6 * 5 - 150 * 11.5e-6 * 3;
    const json before = answer_to(plain), after = answer_to(warm);
    EXPECT_NEAR(value(after, "/correction_to_20C_mm"), shift, 1e-15);
    EXPECT_EQ(after.at("compensation"), "F_and_D_at_20C");
    EXPECT_NEAR(value(after, "/parameters/D/value"), value(before, "/parameters/D/value") + shift,
                1e-15);
    EXPECT_EQ(after.at("parameters").at("G_b"), before.at("parameters").at("G_b"));
    EXPECT_EQ(after.at("diagnosis").at("scale_x"), before.at("diagnosis").at("scale_x"));
    EXPECT_NEAR(value(after, "/diagnosis/scale_x_at_20C"),
                value(before, "/diagnosis/scale_x") + shift / 150, 1e-15);
    for (const auto& [key, unused] : warm.at("temperature").items()) {
        json lacking = warm;
        lacking["temperature"].erase(key);
        EXPECT_EQ(refused_field(lacking), "temperature." + key);
    }
    EXPECT_EQ(refused_field(with(warm, "/temperature/machine_expansion_per_K", 11.5)),
              "temperature.machine_expansion_per_K");
}

TEST(CircularCase, UncertaintyGivesEachFigureItsOwnTwice) {
    const json request = with(
        made_case(5e-5, 0), "/uncertainty",
        {{"device_width_um", 0.5}, {"calibration_U_um", 1}, {"calibration_k", 2}, {"trials", 300}});
    const json answer = answer_to(request);
    const double u_device = 0.5e-3 / std::sqrt(12.0);
    EXPECT_NEAR(value(answer, "/parameters/G_b/expanded_uncertainty/value"), 2 * u_device, 1e-15);
    EXPECT_NEAR(value(answer, "/parameters/D/expanded_uncertainty/value"), 1e-3, 1e-15);
    EXPECT_EQ(answer.at("parameters").at("D").at("expanded_uncertainty").at("k"), 2);
    EXPECT_NEAR(value(answer, "/parameters/D/expanded_uncertainty/monte_carlo"), 1e-3, 2e-4);
    EXPECT_EQ(answer.at("budget").at("contributions").size(), 2);
    EXPECT_EQ(answer.at("budget").at("trials"), 300);
    EXPECT_EQ(refused_field(with(request, "/uncertainty/eve_um", -1)), "uncertainty.eve_um");
    EXPECT_EQ(refused_field(with(request, "/uncertainty/trials", 1e9)), "uncertainty.trials");
    EXPECT_EQ(refused_field(with(request, "/uncertainty/eve", 1)), "uncertainty.eve");
    EXPECT_EQ(refused_field(with(request, "/uncertainty/bar_temperature_width_K", 1)),
              "uncertainty.bar_temperature_width_K");
}

/// Squareness alone: a radius of 3.75 um sin 2 theta, so that each G is 7.5 um; its U is
/// 2 * 0.5 um / sqrt(12) = 0.289 um.
TEST(CircularCase, IsJudgedByItsLimits) {
    json request =
        with(made_case(5e-5, 0), "/uncertainty", {{"device_width_um", 0.5}, {"trials", 300}});
    request["tolerances"] = {{"name", "agreed"},
                             {"source", "order 17"},
                             {"unit", "um"},
                             {"rule", "guard-U"},
                             {"limits",
                              {{{"parameter", "G_b"}, {"limit", 7.6}},
                               {{"parameter", "G_ccw"}, {"limit", 8}},
                               {{"parameter", "G_cw"}, {"limit", 7}}}}};
    const json answer = answer_to(request);
    EXPECT_EQ(answer.at("verdicts").at("G_b").at("verdict"), "not_provable");
    EXPECT_EQ(answer.at("verdicts").at("G_ccw").at("verdict"), "pass");
    EXPECT_EQ(answer.at("verdicts").at("G_cw").at("verdict"), "fail");
    EXPECT_DOUBLE_EQ(value(answer, "/verdicts/G_cw/limit"), 0.007);
    EXPECT_EQ(answer.at("tolerances").at("rule"), "guard-U");
    EXPECT_EQ(refused_field(with(request, "/tolerances/limits/0/parameter", "E")),
              "tolerances.limits[0].parameter");
    EXPECT_EQ(refused_field(with(request, "/tolerances/limits/0/travel_up_to_mm", 5)),
              "tolerances.limits[0].travel_up_to_mm");
    EXPECT_EQ(refused_field(with(request, "/tolerances/unit", "deg")), "tolerances.unit");
}

TEST(CircularCase, LeastSquaresCentreIsRefusedBelow90Deg) {
    const json shorter = made_case(5e-5, 0, 10, 95, 1);
    EXPECT_EQ(refused_field(with(shorter, "/f_centre", "least_squares")), "f_centre");
    EXPECT_EQ(answer_to(shorter).at("parameters").at("F_max_ccw").at("centre"), "set_up");
    EXPECT_EQ(refused_field(with(shorter, "/f_centre", "nominal")), "f_centre");
    EXPECT_EQ(answer_to(with(made_case(5e-5, 0, 0, 120, 1), "/f_centre", "least_squares"))
                  .at("parameters")
                  .at("F_max_ccw")
                  .at("centre"),
              "least_squares");
}

TEST(CircularCase, AnglesInDegreesAreTheSameCircle) {
    const json radians = made_case(5e-5, 0);
    json degrees = radians;
    for (json& trace : degrees.at("traces")) {
        for (const json& angle : trace.at("angle_rad"))
            trace["angle_deg"].push_back(angle.get<double>() * 180 / std::numbers::pi);
        trace.erase("angle_rad");
    }
    for (const char* figure : {"G_ccw", "G_cw", "G_b"}) {
        const auto value = [&](const json& request) {
            return answer_to(request).at("parameters").at(figure).at("value").get<double>();
        };
        EXPECT_NEAR(value(degrees), value(radians), 1e-12) << figure;
    }
    EXPECT_EQ(refused_field(with(radians, "/traces/0/angle_deg", json::array({1, 2, 3}))),
              "traces[0].angle_deg");
    json per_second = radians;
    per_second["feed_mm_per_s"] = 12.5;
    EXPECT_EQ(refused_field(per_second), "feed_mm_per_s");
}

TEST(CircularCase, RefusesByField) {
    const json good = made_case(5e-5, 0);
    EXPECT_EQ(refused_field(without(good, "nominal_radius_mm")), "nominal_radius_mm");
    EXPECT_EQ(refused_field(without(good, "feed_mm_per_min")), "feed_mm_per_min");
    EXPECT_EQ(refused_field(without(good, "traces")), "traces");
    EXPECT_EQ(refused_field(with(good, "/traces", json::array())), "traces");
    EXPECT_EQ(refused_field(with(good, "/nominal_radius_mm", 0)), "nominal_radius_mm");
    EXPECT_EQ(refused_field(with(good, "/traces/0/sense", "left")), "traces[0].sense");
    EXPECT_EQ(refused_field(with(good, "/traces/1/sense", "ccw")), "traces[1].sense");
    EXPECT_EQ(refused_field(with(good, "/traces/1/angle_rad/3", "1")), "traces[1].angle_rad[3]");
    EXPECT_EQ(refused_field(with(good, "/traces/1/angle_rad", {1, 2, 3})),
              "traces[1].radial_deviation_mm");
    EXPECT_EQ(refused_field(with(good, "/traces/1/feed", 1)), "traces[1].feed");
    EXPECT_EQ(refused_field(with(good, "/f_center", "set_up")), "f_center");
    EXPECT_EQ(refused_field(with(good, "/axes", {"X", "X"})), "axes");
    EXPECT_EQ(refused_field(with(good, "/axes", {"X", 1})), "axes");
    json thrice = good;
    thrice["traces"].push_back(good["traces"][0]);
    EXPECT_EQ(refused_field(thrice), "traces[2].sense");
}

TEST(CircularCase, NumbersInNumbersOut) {
    json small = made_case(5e-5, 1e-4, 0, 359, 40);
    small["temperature"] = {{"bar_degC", 25},
                            {"machine_degC", 23},
                            {"bar_expansion_per_K", 1.2e-6},
                            {"machine_expansion_per_K", 11.5e-6},
                            {"bar_length_mm", 150.01}};
    small["uncertainty"] = {{"device_width_um", 0.5}, {"eve_um", 1}, {"n", 2}, {"trials", 3}};
    test::expect_numbers_in_numbers_out(small);
    test::expect_numbers_in_numbers_out(one_sense(made_case(5e-5, 1e-4, 10, 50, 10), 1));
}

TEST(CircularCase, WordsForPaperChangeNoFigure) {
    const json request = made_case(2e-5, 1e-4);
    json worded = request;
    worded["report"] = {{"customer", "Example customer"},
                        {"centre_mm", {1, 2, 3}},
                        {"air_degC", 21.5},
                        {"instruments", {{{"name", "ballbar"}, {"serial", "B-1"}}}}};
    EXPECT_EQ(answer_to(worded), answer_to(request));
}

TEST(CircularCase, RefusesWordsForPaperOfAWrongKind) {
    const json request = made_case(2e-5, 1e-4);
    const auto refused = [&](const json& report) {
        json worded = request;
        worded["report"] = report;
        return refused_field(worded);
    };
    EXPECT_EQ(refused({{"customre", "x"}}), "report.customre");
    EXPECT_EQ(refused({{"customer", 7}}), "report.customer");
    EXPECT_EQ(refused({{"air_degC", 1000}}), "report.air_degC");
    EXPECT_EQ(refused({{"centre_mm", {1, 2}}}), "report.centre_mm");
    EXPECT_EQ(refused({{"instruments", {{{"model", 5}}}}}), "report.instruments[0].model");
    EXPECT_EQ(refused(json::array()), "report");
}

} // namespace
} // namespace axiscal::circular_case_test

#include "asked.hpp"

namespace axiscal::drift_case_test {
namespace {

using nlohmann::json;
using test::answer_to;
using test::refused_field;
using test::with;
using test::without;

json spindle() {
    return json::parse(
        R"({"analysis":"drift","unit":"um","time_min":[0,30,60,90,120],"at_min":[45,500],
        "channels":[{"name":"Y1","readings":[0,4,6,7,7]},{"name":"Y2","readings":[0,2,3,3,3]}],
        "tilts":[{"name":"A","channels":["Y1","Y2"],"distance_mm":100}],
        "temperatures":[{"name":"nose","time_min":[0,60,120],"readings":[20,23,23.1],
                         "settled_band_K":0.2,"gradient_limit_K_per_h":2}]})");
}

TEST(DriftCase, GivesRangesChangesTiltsAndTemperatures) {
    const json answer = answer_to(spindle());
    const json& first = answer.at("channels")[0];
    EXPECT_EQ(first.at("name"), "Y1");
    EXPECT_EQ(first.at("total").at("range"), 7);
    EXPECT_EQ(first.at("window").at("range"), 6); // the first hour
    EXPECT_EQ(first.at("window").at("to_min"), 60);
    EXPECT_EQ(first.at("changes")[0].at("change"), 5);
    EXPECT_FALSE(first.at("changes")[1].contains("change"));
    EXPECT_EQ(first.at("changes")[1].at("reason"), "outside the record");
    EXPECT_EQ(first.at("end").at("change"), 7);
    // (7 - 3) um over 100 mm
    EXPECT_NEAR(answer.at("tilts")[0].at("end").at("change").get<double>(), 4e-5, 1e-19);
    const json& nose = answer.at("temperatures")[0];
    EXPECT_EQ(nose.at("settled"), true);
    EXPECT_EQ(nose.at("settled_from_min"), 60);
    EXPECT_NEAR(nose.at("gradient").at("K_per_h").get<double>(), 3, 1e-12);
    EXPECT_EQ(nose.at("gradient").at("exceeded"), true);
}

TEST(DriftCase, TiltDoesNotDependOnTheUnitOfTheReadings) {
    json in_mm = with(spindle(), "/unit", "mm");
    for (auto& channel : in_mm["channels"])
        for (auto& reading : channel["readings"])
            reading = reading.get<double>() / 1000;
    EXPECT_NEAR(answer_to(in_mm).at("tilts")[0].at("total").at("range").get<double>(),
                answer_to(spindle()).at("tilts")[0].at("total").at("range").get<double>(), 1e-18);
}

TEST(DriftCase, ChangeFromFirstToLastIsHeldAgainstItsLimit) {
    const json answer = answer_to(with(spindle(), "/allowed_change", 5));
    EXPECT_EQ(answer.at("channels")[0].at("end").at("within_allowed_change"), false); // 7
    EXPECT_EQ(answer.at("channels")[1].at("end").at("within_allowed_change"), true);  // 3
    EXPECT_FALSE(
        answer_to(spindle()).at("channels")[0].at("end").contains("within_allowed_change"));
    EXPECT_EQ(refused_field(with(spindle(), "/allowed_change", 0)), "allowed_change");
}

TEST(DriftCase, AShortTemperatureRecordSaysSo) {
    const json answer = answer_to(with(spindle(), "/temperatures/0/slope_window_min", 500));
    EXPECT_EQ(answer.at("temperatures")[0].at("settled"), false);
    EXPECT_TRUE(answer.at("temperatures")[0].at("not_evaluated").contains("gradient"));
}

TEST(DriftCaseRefuses, ByTheField) {
    EXPECT_EQ(refused_field({{"analysis", "drift"}, {"unit", "um"}}), "channels");
    EXPECT_EQ(refused_field(without(spindle(), "unit")), "unit");
    EXPECT_EQ(refused_field(without(spindle(), "time_min")), "channels[0].time_min");
    EXPECT_EQ(refused_field(with(spindle(), "/channels/1/readings", {1, 2})),
              "channels[1].readings");
    EXPECT_EQ(refused_field(with(spindle(), "/channels/1/name", "Y1")), "channels[1].name");
    EXPECT_EQ(refused_field(with(spindle(), "/channels/0/reading", 1)), "channels[0].reading");
    EXPECT_EQ(refused_field(with(spindle(), "/tilts/0/channels", {"Y1", "Z"})),
              "tilts[0].channels[1]");
    EXPECT_EQ(refused_field(with(spindle(), "/tilts/0/distance_mm", 0)), "tilts[0].distance_mm");
    EXPECT_EQ(refused_field(with(spindle(), "/window_min", -1)), "window_min");
    EXPECT_EQ(refused_field(with(spindle(), "/temperatures/0/settled_band_K", -1)),
              "temperatures[0].settled_band_K");
}

TEST(DriftCaseLaws, NumbersInNumbersOut) {
    test::expect_numbers_in_numbers_out(spindle());
}

} // namespace
} // namespace axiscal::drift_case_test

// What a person would ask about the input stands beside the figures.
#include "tests/unit/cases/asked.hpp"

#include <numbers>

namespace axiscal::plausibility_test {
namespace {

using nlohmann::json;
using test::answer_to, test::refused_field, test::with, test::without;

/// All remarks of the answer in one text; empty without the member.
std::string remarks_on(const json& request) {
    const json remarks = answer_to(request).value("remarks", json::array());
    return remarks.empty() ? "" : remarks.dump();
}

bool tells(const json& request, const std::string& words) {
    return remarks_on(request).find(words) != std::string::npos;
}

json two_approaches() {
    return json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"um","target_unit":"mm","readings":"deviations",
        "targets":[0,500,1000],"forward":[[0,1],[2,3],[9,10]],"backward":[[-1,0],[2,4],[8,9]],
        "uncertainty":{"device_width_um":1,"eve_um":3,"monte_carlo":false}})");
}

// U = 2 k u_EVE / sqrt(n - 1) with k = 2 (ISO 230-2, annex A): 2 x 2 x 2 x 3 / (2 sqrt 3) for n
// = 2.
TEST(Plausibility, TheApproachesOfTheRowsCountWhateverNStates) {
    for (const int n : {1, 2, 5, 1000}) {
        const json request = with(two_approaches(), "/uncertainty/n", n);
        const json answer = answer_to(request);
        EXPECT_NEAR(
            answer["parameters"]["R_forward"]["expanded_uncertainty"]["value"].get<double>(),
            4 * std::numbers::sqrt3, 1e-12);
        EXPECT_EQ(tells(request, "the rows hold 2"), n != 2) << n;
    }
    EXPECT_EQ(remarks_on(two_approaches()), "");
}

TEST(Plausibility, TargetsInMicrometresAreAskedAfter) {
    EXPECT_TRUE(tells(without(two_approaches(), "target_unit"), "they span 1 mm: if"));
    json long_axis = with(without(two_approaches(), "target_unit"), "/targets", {0, 5e5, 1e6});
    EXPECT_EQ(remarks_on(long_axis), ""); // a metre of travel in micrometres
    const json rotary = json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"C","kind":"rotary"},"unit":"arcsec","readings":"deviations",
        "targets":[0,90,180],"forward":[[0],[1],[2]]})");
    EXPECT_TRUE(tells(rotary, "if they are degrees"));
    EXPECT_EQ(remarks_on(with(rotary, "/target_unit", "deg")), "");
}

TEST(Plausibility, OtherLinesInMicrometresAreAskedAfterToo) {
    const json line = json::parse(R"({"analysis":"straightness","axis":"X","unit":"um",
        "targets":[0,250,500],"deviations":[0,1,0]})");
    EXPECT_TRUE(tells(line, "target_unit"));
    EXPECT_EQ(remarks_on(with(line, "/target_unit", "mm")), "");
    const json rule = json::parse(R"({"analysis":"target_rule","axis":{"name":"X","kind":"linear"},
        "unit":"um","targets":[0,250,500,750,1000],"approaches":5})");
    EXPECT_TRUE(tells(rule, "are millimetres"));
}

TEST(Plausibility, ADeviationBeyondHalfTheIntervalIsAskedAfter) {
    const json wrapped = json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"C","kind":"rotary"},"unit":"deg","readings":"positions",
        "targets":[0,90,180,270],"forward":[[359.9995,0.0004],[90,90],[180,180],[270,270]]})");
    EXPECT_TRUE(tells(wrapped, "forward[0][0] deviates by 360 deg, more than half"));
    const json positions = json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"mm","readings":"deviations",
        "targets":[0,500,1000],"forward":[[0.001],[500.002],[1000.003]]})");
    EXPECT_TRUE(tells(positions, "are the rows positions"));
    EXPECT_EQ(remarks_on(with(positions, "/readings", "positions")), "");
}

TEST(Plausibility, ALengthThatTheTargetsContradictIsAskedAfter) {
    EXPECT_TRUE(tells(with(two_approaches(), "/uncertainty/length_m", 1000), "length_m"));
    EXPECT_EQ(remarks_on(with(two_approaches(), "/uncertainty/length_m", 1)), "");
    EXPECT_TRUE(tells(with(two_approaches(), "/uncertainty/device_width_um", 1000), "is it in nm"));
}

json circle(double turn, const std::string& key) {
    json trace{{"sense", "ccw"}, {key, json::array()}, {"radial_deviation_mm", json::array()}};
    for (int i = 0; i < 180; ++i) {
        trace[key].push_back(i * turn / 180);
        trace["radial_deviation_mm"].push_back(0.001 * (i % 3));
    }
    return {{"analysis", "circular"},
            {"nominal_radius_mm", 100},
            {"feed_mm_per_min", 1000},
            {"traces", {trace}}};
}

TEST(Plausibility, AnglesOverTenTurnsAreAskedAfter) {
    EXPECT_TRUE(tells(circle(360, "angle_rad"), "57 times: are its angles degrees"));
    EXPECT_EQ(remarks_on(circle(360, "angle_deg")), "");
    EXPECT_EQ(remarks_on(circle(2 * std::numbers::pi, "angle_rad")), "");
}

TEST(Plausibility, RadiiInMicrometresAreAskedAfter) {
    json request = circle(360, "angle_deg");
    for (json& deviation : request["traces"][0]["radial_deviation_mm"])
        deviation = deviation.get<double>() * 1000;
    EXPECT_TRUE(tells(request, "micrometres"));
}

TEST(Plausibility, ARecordShorterThanItsWindowIsTold) {
    const json drift = json::parse(R"({"analysis":"drift","unit":"um",
        "channels":[{"name":"X","time_min":[0,1,2],"readings":[0,1,2]}]})");
    EXPECT_TRUE(tells(drift, "lasts 2 min, less than the window of 60 min"));
    EXPECT_EQ(remarks_on(with(drift, "/window_min", 2)), "");
}

json air(double pressure, double temperature) {
    return {{"analysis", "air_index"},        {"model", "ciddor"},
            {"vacuum_wavelength_nm", 632.99}, {"temperature_degC", temperature},
            {"pressure_Pa", pressure},        {"relative_humidity_percent", 50}};
}

TEST(Plausibility, AirInOtherUnitsIsRefusedByTheMemberThatIsWrong) {
    for (const double pressure : {1013.25, 760.0, 101.325, 29.92, 14.7})
        EXPECT_EQ(refused_field(air(pressure, 20)), "pressure_Pa") << pressure;
    EXPECT_EQ(refused_field(air(101325, 293.15)), "temperature_degC");
    EXPECT_EQ(refused_field(air(101325, 20)), "accepted");
    for (const double wavelength : {0.633, 0.00633, 100.0})
        EXPECT_EQ(refused_field(with(air(101325, 20), "/vacuum_wavelength_nm", wavelength)),
                  "vacuum_wavelength_nm");
}

} // namespace
} // namespace axiscal::plausibility_test

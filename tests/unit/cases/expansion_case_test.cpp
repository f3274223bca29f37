#include "asked.hpp"

#include <cmath>

namespace axiscal::expansion_case_test {
namespace {

using nlohmann::json;
using test::answer_to;
using test::refused_field;
using test::with;
using test::without;

json scale() {
    return json::parse(R"({"analysis":"expansion","kind":"scale","unit":"um",
        "machine":{"expansion_per_K":2.2e-5,"temperature_degC":[24.5,25.5]},
        "instrument":{"expansion_per_K":1e-5,"temperature_degC":24},
        "distance":[0,500000],"deviation":[1,0]})");
}

json interferometer() {
    return json::parse(R"({"analysis":"expansion","kind":"interferometer",
        "vacuum_wavelength_nm":632.9908,"counts":[1000000,-250000.5],"n_minus_1":0.00027,
        "n_minus_1_at_zero":0.000271,"dead_path_mm":100,"beam_angle_rad":0.001,
        "machine":{"expansion_per_K":1.17e-5,"temperature_degC":22},
        "abbe":{"offset_mm":200,"angle_rad":5e-6}})");
}

TEST(ExpansionCase, FormChoosesAndBothStandThere) {
    const json answer = answer_to(scale());
    EXPECT_EQ(answer.at("form"), "first_order");
    EXPECT_EQ(answer.at("machine").at("sensors"), 2);
    EXPECT_EQ(answer.at("machine").at("temperature_degC"), 25);
    const json& point = answer.at("points")[1];
    EXPECT_NEAR(point.at("first_order").get<double>(), -35, 1e-9);
    EXPECT_EQ(point.at("at_20C"), point.at("first_order"));
    const json exact = answer_to(with(scale(), "/form", "exact"));
    EXPECT_EQ(exact.at("points")[1].at("at_20C"), point.at("exact"));
    EXPECT_FALSE(answer.contains("remarks"));
    EXPECT_TRUE(answer_to(with(scale(), "/machine/temperature_degC", 25)).contains("remarks"));
}

TEST(ExpansionCase, LaserHasNoStrainOfItsOwnAndSaysThatTheAirIsOut) {
    json laser = without(with(scale(), "/kind", "laser"), "instrument");
    EXPECT_EQ(refused_field(laser), "wavelength_compensated");
    laser["wavelength_compensated"] = false;
    EXPECT_EQ(refused_field(laser), "wavelength_compensated");
    laser["wavelength_compensated"] = true;
    const json answer = answer_to(laser);
    // 500000 * 2.2e-5 * 5
    EXPECT_NEAR(answer.at("points")[1].at("first_order").get<double>(), -55, 1e-9);
    EXPECT_FALSE(answer.contains("instrument"));
}

TEST(ExpansionCase, InterferometerGivesEachStep) {
    const json point = answer_to(interferometer()).at("points")[0];
    for (const char* key : {"vacuum_mm", "in_air_mm", "cosine_mm", "along_axis_mm", "at_20C_mm",
                            "first_order_mm", "exact_mm"})
        EXPECT_TRUE(point.contains(key)) << key;
    // 1e6 waves of 632.9908 nm there and back; the dead path gives 100 mm of 1e-6
    EXPECT_NEAR(point.at("vacuum_mm").get<double>(), 316.4954, 1e-12);
    EXPECT_NEAR(point.at("in_air_mm").get<double>(), (316.4954 + 1e-4) / 1.00027, 1e-9);
    EXPECT_FALSE(
        answer_to(without(interferometer(), "machine")).at("points")[0].contains("exact_mm"));
    EXPECT_FALSE(answer_to(without(interferometer(), "abbe")).contains("abbe_mm"));
}

TEST(ExpansionCaseRefuses, ByTheKey) {
    EXPECT_EQ(refused_field(without(scale(), "kind")), "kind");
    EXPECT_EQ(refused_field(without(scale(), "instrument")), "instrument");
    EXPECT_EQ(refused_field(with(scale(), "/instrument", "a glass scale")), "instrument");
    EXPECT_EQ(refused_field(with(scale(), "/machine/alpha", 1)), "machine.alpha");
    EXPECT_EQ(refused_field(with(scale(), "/machine/temperature_degC", json::array())),
              "machine.temperature_degC");
    EXPECT_EQ(refused_field(with(scale(), "/deviation", {1})), "deviation");
    EXPECT_EQ(refused_field(with(scale(), "/counts", 1)), "counts");
    EXPECT_EQ(refused_field(with(interferometer(), "/passes", 3)), "passes");
    EXPECT_EQ(refused_field(with(interferometer(), "/n_minus_1", {0.1, 0.1, 0.1})), "n_minus_1");
    EXPECT_EQ(refused_field(without(interferometer(), "n_minus_1_at_zero")), "n_minus_1_at_zero");
    EXPECT_EQ(refused_field(with(interferometer(), "/beam_walk_mm", 1)), "beam_angle_rad");
    EXPECT_EQ(refused_field(with(interferometer(), "/beam_walk_travel_mm", 1)),
              "beam_walk_travel_mm");
    EXPECT_EQ(refused_field(with(interferometer(), "/abbe/angle_rad", 2)), "abbe.angle_rad");
}

TEST(ExpansionCaseLaws, NumbersInNumbersOut) {
    test::expect_numbers_in_numbers_out(scale());
    test::expect_numbers_in_numbers_out(interferometer());
}

} // namespace
} // namespace axiscal::expansion_case_test

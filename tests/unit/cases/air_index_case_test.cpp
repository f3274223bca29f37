#include "asked.hpp"
#include "tests/support/source_dir.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace axiscal::air_index_case_test {
namespace {

using nlohmann::json;
using test::answer_to;
using test::refused_field;
using test::with;
using test::without;

json workshop() {
    return {{"analysis", "air_index"},       {"model", "ciddor"},
            {"vacuum_wavelength_nm", 633.0}, {"temperature_degC", 20.0},
            {"pressure_Pa", 101325.0},       {"relative_humidity_percent", 50.0},
            {"comment", "after NIST's page"}};
}

/// One row of the reference as a case; null where it is none.
json case_of_row(const std::vector<std::string>& cell) {
    if (cell.front().starts_with("#") || cell.front() == "model") return nullptr;
    json request = without(workshop(), "relative_humidity_percent");
    request["model"] = cell[0];
    request["vacuum_wavelength_nm"] = std::stod(cell[1]);
    request["temperature_degC"] = std::stod(cell[2]);
    request["pressure_Pa"] = std::stod(cell[3]);
    if (cell[4].empty())
        request["vapour_pressure_Pa"] = std::stod(cell[5]);
    else
        request["relative_humidity_percent"] = std::stod(cell[4]);
    request["co2_ppm"] = std::stod(cell[6]);
    return request;
}

TEST(AirIndexCase, EveryRowOfTheReferenceComesOutWithinItsTolerance) {
    std::ifstream file{test::source_dir() + "/tests/reference/air_index.csv"};
    int rows = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells{line};
        std::vector<std::string> cell(9);
        for (auto& text : cell)
            std::getline(cells, text, ',');
        const json request = case_of_row(cell);
        if (request.is_null()) continue;
        const json answer = answer_to(request);
        EXPECT_NEAR(answer.at("n_minus_1").get<double>(), std::stod(cell[7]) - 1,
                    std::stod(cell[8]))
            << line;
        const bool knows_co2 = cell[0] == "ciddor" || cell[0] == "bonsch_potulski";
        EXPECT_EQ(answer.contains("ignored"), !knows_co2) << line;
        ++rows;
    }
    EXPECT_EQ(rows, 27);
}

TEST(AirIndexCase, SaysWhatItUsedAndWhereItHolds) {
    const json answer = answer_to(workshop());
    EXPECT_EQ(answer.at("co2_ppm"), 450);
    EXPECT_EQ(answer.at("validity").at("pressure"), (json{60e3, 120e3}));
    EXPECT_FALSE(answer.contains("outside_validity"));
    EXPECT_FALSE(answer.contains("note"));
    const json thin = answer_to(with(workshop(), "/pressure_Pa", 5e4));
    EXPECT_EQ(thin.at("outside_validity"), json{"pressure"});
    const json bonsch = answer_to(with(workshop(), "/model", "bonsch_potulski"));
    EXPECT_EQ(bonsch.at("co2_ppm"), 400);
    EXPECT_TRUE(bonsch.contains("note"));
    const json edlen = answer_to(with(with(workshop(), "/model", "edlen_nist"), "/co2_ppm", 400));
    EXPECT_EQ(edlen.at("ignored"), json{"co2_ppm"});
    EXPECT_FALSE(edlen.contains("co2_ppm"));
}

TEST(AirIndexCase, SaturationFormCanBeChosen) {
    const double iapws = answer_to(workshop()).at("vapour_pressure_Pa");
    const double ciddor =
        answer_to(with(workshop(), "/saturation", "ciddor")).at("vapour_pressure_Pa");
    EXPECT_NE(iapws, ciddor);
    EXPECT_NEAR(iapws, ciddor, 1);
    EXPECT_EQ(refused_field(with(workshop(), "/saturation", "magnus")), "saturation");
}

TEST(AirIndexCaseRefuses, TheImpossibleAndTheMisspelt) {
    EXPECT_EQ(refused_field(without(workshop(), "model")), "model");
    EXPECT_EQ(refused_field(with(workshop(), "/model", "owens")), "model");
    EXPECT_EQ(refused_field(with(workshop(), "/humidity", 50)), "humidity");
    EXPECT_EQ(refused_field(with(workshop(), "/vapour_pressure_Pa", 1000)), "vapour_pressure_Pa");
    EXPECT_EQ(refused_field(without(workshop(), "relative_humidity_percent")),
              "relative_humidity_percent");
    for (const char* key : {"vacuum_wavelength_nm", "temperature_degC", "pressure_Pa",
                            "relative_humidity_percent", "co2_ppm"}) {
        EXPECT_EQ(refused_field(with(workshop(), std::string{"/"} + key, -1000)), key);
        EXPECT_EQ(refused_field(with(workshop(), std::string{"/"} + key, "x")), key);
        std::string text = with(workshop(), std::string{"/"} + key, "HERE").dump();
        text.replace(text.find("\"HERE\""), 6, "NaN");
        EXPECT_TRUE(analyze_cases(text).error_line.starts_with(std::string{"refused: "} + key));
    }
}

TEST(AirIndexCaseLaws, NumbersInNumbersOut) {
    for (const char* model : {"ciddor", "edlen_nist", "birch_downs", "bonsch_potulski"})
        test::expect_numbers_in_numbers_out(with(workshop(), "/model", model));
}

} // namespace
} // namespace axiscal::air_index_case_test

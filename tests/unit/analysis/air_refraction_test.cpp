#include "analysis/air/air_refraction.hpp"
#include "reference_data.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <sstream>

namespace axiscal::air_refraction_test {
namespace {

struct Row {
    std::string model;
    AirState air;
    double n_minus_1 = 0, tolerance = 0;
    std::string line;
};

std::optional<Row> row_from(const std::string& line) {
    std::istringstream cells{line};
    std::vector<std::string> cell(9);
    for (auto& text : cell)
        std::getline(cells, text, ',');
    if (cell[0] != "ciddor" && cell[0] != "edlen_nist") return std::nullopt;
    Row row{cell[0], {}, std::stod(cell[7]) - 1, std::stod(cell[8]), line};
    row.air.vacuum_wavelength = nm(std::stod(cell[1]));
    row.air.temperature = Temperature::celsius(std::stod(cell[2]));
    row.air.pressure = pascal(std::stod(cell[3]));
    row.air.relative_humidity =
        cell[4].empty()
            ? unity(std::stod(cell[5]) / saturation_vapour_pressure(row.air.temperature).in(pascal))
            : percent(std::stod(cell[4]));
    row.air.co2_ppm = std::stod(cell[6]);
    return row;
}

std::vector<Row> reference_rows() {
    std::ifstream file{test::reference_path("air_index.csv")};
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);)
        if (const auto row = row_from(line)) rows.push_back(*row);
    return rows;
}

TEST(AirRefraction, AgreesWithEveryCiddorAndEdlenRowOfTheReference) {
    const auto rows = reference_rows();
    ASSERT_GE(rows.size(), 22u);
    for (const auto& row : rows) {
        const auto formula = row.model == "ciddor" ? AirFormula::ciddor : AirFormula::edlen;
        const auto ours = refractivity_of(formula, row.air);
        ASSERT_TRUE(ours.has_value()) << row.line;
        EXPECT_NEAR(ours->n_minus_1, row.n_minus_1, row.tolerance) << row.line;
    }
}

TEST(AirRefraction, SaturationPressureAgreesWithThePublishedIapwsCheckValues) {
    const auto relative = [](double kelvins, double published_Pa) {
        return saturation_vapour_pressure(Temperature::kelvin(kelvins)).si() / published_Pa - 1;
    };
    EXPECT_NEAR(relative(300, 3536.58941), 0, 2e-9);
    EXPECT_NEAR(relative(500, 2.63889776e6), 0, 2e-9);
    EXPECT_NEAR(relative(600, 12.3443146e6), 0, 3e-9);
}

TEST(AirRefraction, IceAndWaterMeetAtTheTriplePoint) {
    // IAPWS: 611.657 Pa at 273.16 K for both phases
    EXPECT_NEAR(saturation_vapour_pressure(Temperature::kelvin(273.16)).si(), 611.657, 0.01);
    EXPECT_NEAR(saturation_vapour_pressure(Temperature::celsius(-1e-9)).si(),
                saturation_vapour_pressure(Temperature::celsius(0)).si(), 0.2);
}

AirState workshop() {
    return {20.0_degC, 101325.0_Pa, percent(50), 632.9908_nm, 450};
}

TEST(AirRefraction, SensitivitiesNearTheWorkshopStateAreThePublishedOnes) {
    // per K, per Pa and per % of relative humidity (Ciddor, 633 nm)
    for (const AirFormula formula : {AirFormula::ciddor, AirFormula::edlen}) {
        const double n0 = refractivity_of(formula, workshop())->n_minus_1;
        AirState air = workshop();
        air.temperature = 21.0_degC;
        EXPECT_NEAR(refractivity_of(formula, air)->n_minus_1 - n0, -0.94e-6, 0.03e-6);
        air = workshop();
        air.pressure += pascal(1);
        EXPECT_NEAR(refractivity_of(formula, air)->n_minus_1 - n0, 2.68e-9, 0.01e-9);
        air = workshop();
        air.relative_humidity = percent(51);
        EXPECT_NEAR(refractivity_of(formula, air)->n_minus_1 - n0, -8.5e-9, 0.2e-9);
    }
}

TEST(AirRefraction, RefusesThePhysicallyImpossibleByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto field = [](AirState air) {
        const auto result = refractivity_of(AirFormula::ciddor, air);
        return result ? std::string{"accepted"} : result.error().field;
    };
    AirState air = workshop();
    EXPECT_EQ(field(air), "accepted");
    air.temperature = Temperature::celsius(nan);
    EXPECT_EQ(field(air), "air temperature");
    air = workshop(), air.relative_humidity = percent(101);
    EXPECT_EQ(field(air), "relative humidity");
    air = workshop(), air.pressure = pascal(0);
    EXPECT_EQ(field(air), "air pressure");
    air = workshop(), air.pressure = pascal(1000); // below the vapour's own 1170 Pa
    EXPECT_EQ(field(air), "air pressure");
    air = workshop(), air.vacuum_wavelength = metre(0);
    EXPECT_EQ(field(air), "vacuum wavelength");
    air = workshop(), air.co2_ppm = -1;
    EXPECT_EQ(field(air), "CO2");
}

TEST(AirRefraction, RemarksOnAStateOutsideTheFormulasRange) {
    AirState air = workshop();
    EXPECT_TRUE(refractivity_of(AirFormula::edlen, air)->remarks.empty());
    air.temperature = 45.0_degC;
    EXPECT_EQ(refractivity_of(AirFormula::edlen, air)->remarks.size(), 1u);
    EXPECT_TRUE(refractivity_of(AirFormula::ciddor, air)->remarks.empty());
    air.pressure = 50000.0_Pa;
    EXPECT_EQ(refractivity_of(AirFormula::ciddor, air)->remarks.size(), 1u);
}

} // namespace
} // namespace axiscal::air_refraction_test

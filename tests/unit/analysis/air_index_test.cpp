#include "analysis/air/air_index.hpp"

#include "analysis/air/air_formulas.hpp"
#include "analysis/air/air_refraction.hpp"
#include "reference_data.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>
#include <sstream>

namespace axiscal::air_index_test {
namespace {

const std::map<std::string, AirModel> models{{"ciddor", AirModel::ciddor},
                                             {"edlen_nist", AirModel::edlen_nist},
                                             {"birch_downs", AirModel::birch_downs},
                                             {"bonsch_potulski", AirModel::bonsch_potulski}};

AirConditions workshop() {
    AirConditions air;
    air.vacuum_wavelength_nm = 632.9908;
    air.temperature_degC = 20;
    air.pressure_Pa = 101325;
    air.relative_humidity_percent = 50;
    return air;
}

AirConditions with_vapour(double t_C, double p_Pa, double vapour_Pa) {
    AirConditions air = workshop();
    air.temperature_degC = t_C;
    air.pressure_Pa = p_Pa;
    air.relative_humidity_percent.reset();
    air.vapour_pressure_Pa = vapour_Pa;
    return air;
}

double index_of(AirModel model, const AirConditions& air) {
    const auto index = air_index_of(model, air);
    EXPECT_TRUE(index.has_value()) << (index ? "" : index.error().field);
    return index ? index->n_minus_1 : 0;
}

TEST(AirIndex, AgreesWithEveryRowOfTheReferenceWithinItsTolerance) {
    std::ifstream file{test::reference_path("air_index.csv")};
    std::map<std::string, int> seen;
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells{line};
        std::vector<std::string> cell(9);
        for (auto& text : cell)
            std::getline(cells, text, ',');
        if (!models.contains(cell[0])) continue;
        AirConditions air =
            with_vapour(std::stod(cell[2]), std::stod(cell[3]), 0); // the vapour follows
        air.vacuum_wavelength_nm = std::stod(cell[1]);
        air.vapour_pressure_Pa.reset();
        if (cell[4].empty())
            air.vapour_pressure_Pa = std::stod(cell[5]);
        else
            air.relative_humidity_percent = std::stod(cell[4]);
        air.co2_ppm = std::stod(cell[6]);
        EXPECT_NEAR(index_of(models.at(cell[0]), air), std::stod(cell[7]) - 1, std::stod(cell[8]))
            << line;
        ++seen[cell[0]];
    }
    EXPECT_GE(seen["ciddor"], 18);
    for (const char* name : {"edlen_nist", "birch_downs", "bonsch_potulski"})
        EXPECT_GE(seen[name], 2) << name;
}

TEST(AirIndex, GivesTheBitsThatARunGets) {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> t{0, 40}, p{6e4, 1.2e5}, humidity{0, 1};
    for (int trial = 0; trial < 1000; ++trial) {
        AirState state{Temperature::celsius(t(random)), pascal(p(random)), unity(humidity(random)),
                       nm(632.9908), 450};
        AirConditions air = with_vapour(state.temperature.in_celsius(), state.pressure.si(),
                                        state.relative_humidity.si() *
                                            saturation_vapour_pressure(state.temperature).si());
        air.vacuum_wavelength_nm = 632.9908;
        EXPECT_NEAR(index_of(AirModel::ciddor, air),
                    refractivity_of(AirFormula::ciddor, state)->n_minus_1, 1e-18);
        EXPECT_NEAR(index_of(AirModel::edlen_nist, air),
                    refractivity_of(AirFormula::edlen, state)->n_minus_1, 1e-18);
    }
}

/// The papers' own statements: all four within 3e-8 near 20 degC.
TEST(AirIndexLaws, ModelsAgreeNear20Degrees) {
    std::mt19937_64 random{8};
    std::uniform_real_distribution<double> t{17, 23}, p{9e4, 1.1e5}, humidity{0, 60};
    for (int trial = 0; trial < 2000; ++trial) {
        AirConditions air = workshop();
        air.temperature_degC = t(random);
        air.pressure_Pa = p(random);
        air.relative_humidity_percent = humidity(random);
        air.co2_ppm = 450;
        const double ciddor = index_of(AirModel::ciddor, air);
        for (const auto& [name, model] : models)
            EXPECT_NEAR(index_of(model, air), ciddor, 4e-8) << name;
    }
}

TEST(AirIndexLaws, MoreVapourLessIndexAndMorePressureMoreIndex) {
    std::mt19937_64 random{9};
    std::uniform_real_distribution<double> t{0, 40}, p{6e4, 1.2e5}, vapour{0, 600};
    for (int trial = 0; trial < 500; ++trial)
        for (const auto& [name, model] : models) {
            const AirConditions air = with_vapour(t(random), p(random), vapour(random));
            AirConditions wetter = air, denser = air;
            *wetter.vapour_pressure_Pa += 10;
            denser.pressure_Pa += 100;
            EXPECT_LT(index_of(model, wetter), index_of(model, air)) << name;
            EXPECT_NEAR(index_of(model, denser) - index_of(model, air), 2.7e-7, 0.4e-7) << name;
        }
}

TEST(AirIndex, BirchDownsIsNistsFormAt292Point75Kelvin) {
    const AirConditions air = with_vapour(292.75 - 273.15, 101325, 1200);
    EXPECT_NEAR(index_of(AirModel::birch_downs, air), index_of(AirModel::edlen_nist, air), 1e-17);
}

TEST(AirIndex, CarbonDioxideCountsWhereThePaperHasIt) {
    AirConditions air = workshop();
    EXPECT_EQ(*air_index_of(AirModel::ciddor, air)->co2_ppm, 450);
    EXPECT_EQ(*air_index_of(AirModel::bonsch_potulski, air)->co2_ppm, 400);
    for (const AirModel model : {AirModel::ciddor, AirModel::bonsch_potulski}) {
        air.co2_ppm = 400;
        const double thin = index_of(model, air);
        air.co2_ppm = 600;
        // about 1.45e-10 a ppm of n - 1 = 2.7e-4 (5.3e-7 relative)
        EXPECT_NEAR((index_of(model, air) - thin) / 200, 1.45e-10, 0.03e-10);
        EXPECT_TRUE(air_index_of(model, air)->ignored.empty());
    }
    for (const AirModel model : {AirModel::edlen_nist, AirModel::birch_downs}) {
        const auto with = air_index_of(model, air);
        EXPECT_EQ(with->ignored, std::vector<std::string>{"co2_ppm"});
        EXPECT_FALSE(with->co2_ppm.has_value());
        EXPECT_EQ(with->n_minus_1, index_of(model, workshop()));
        EXPECT_TRUE(air_index_of(model, workshop())->ignored.empty());
    }
}

TEST(AirIndex, NamesEveryConditionOutsideTheRangeAndComputesAllTheSame) {
    const auto names = [](AirModel model, const AirConditions& air) {
        return air_index_of(model, air)->outside_validity;
    };
    using Names = std::vector<std::string>;
    for (const auto& [name, model] : models)
        EXPECT_EQ(names(model, workshop()), Names{}) << name;
    AirConditions air = workshop();
    air.pressure_Pa = 1e4;
    EXPECT_EQ(names(AirModel::ciddor, air), Names{"pressure"});
    air.temperature_degC = 30;
    EXPECT_EQ(names(AirModel::ciddor, air), Names{"pressure"});
    EXPECT_EQ(names(AirModel::birch_downs, air), (Names{"temperature", "pressure"}));
    air = workshop(), air.relative_humidity_percent = 100;
    EXPECT_EQ(names(AirModel::ciddor, air), Names{});
    air.relative_humidity_percent = 103;
    EXPECT_EQ(names(AirModel::ciddor, air), Names{"relative_humidity"});
    EXPECT_EQ(names(AirModel::ciddor, with_vapour(20, 101325, 2500)), Names{"relative_humidity"});
    air = workshop(), air.vacuum_wavelength_nm = 1700, air.co2_ppm = 3000;
    EXPECT_EQ(names(AirModel::bonsch_potulski, air), (Names{"vacuum_wavelength", "co2"}));
}

TEST(AirIndex, NoAirHasNoRefractivity) {
    for (const auto& [name, model] : models)
        EXPECT_EQ(index_of(model, with_vapour(20, 0, 0)), 0) << name;
}

std::string refused_field(const AirConditions& air, AirModel model = AirModel::ciddor) {
    const auto index = air_index_of(model, air);
    return index ? "accepted" : index.error().field;
}

TEST(AirIndexRefuses, ThePhysicallyImpossibleByItsKey) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -273.15, -300.0})
        EXPECT_EQ(refused_field(with_vapour(bad, 101325, 0)), "temperature_degC");
    for (const double bad : {nan, infinity, -1.0})
        EXPECT_EQ(refused_field(with_vapour(20, bad, 0)), "pressure_Pa");
    for (const double bad : {nan, infinity, -1.0, 101326.0})
        EXPECT_EQ(refused_field(with_vapour(20, 101325, bad)), "vapour_pressure_Pa");
    AirConditions air = workshop();
    for (const double bad : {nan, infinity, -0.5, 1e5}) {
        air.relative_humidity_percent = bad;
        EXPECT_EQ(refused_field(air), "relative_humidity_percent");
    }
    for (const double bad : {nan, 0.0, -632.0, 132.03, 64.82, 1e-200, infinity}) {
        air = workshop(), air.vacuum_wavelength_nm = bad;
        EXPECT_EQ(refused_field(air), "vacuum_wavelength_nm") << bad;
    }
    air = workshop(), air.vacuum_wavelength_nm = 160.33;
    EXPECT_EQ(refused_field(air, AirModel::birch_downs), "vacuum_wavelength_nm");
    for (const double bad : {nan, -1.0, 1.1e6}) {
        air = workshop(), air.co2_ppm = bad;
        EXPECT_EQ(refused_field(air, AirModel::birch_downs), "co2_ppm");
    }
}

TEST(AirIndexRefuses, BothHumiditiesOrNone) {
    AirConditions air = workshop();
    air.vapour_pressure_Pa = 1000;
    EXPECT_EQ(refused_field(air), "vapour_pressure_Pa");
    air.vapour_pressure_Pa.reset();
    air.relative_humidity_percent.reset();
    EXPECT_EQ(refused_field(air), "relative_humidity_percent");
}

TEST(AirIndexRefuses, HumidityWhereWaterHasNoSaturation) {
    AirConditions air = workshop();
    air.temperature_degC = 374;
    EXPECT_EQ(refused_field(air), "relative_humidity_percent");
    EXPECT_EQ(refused_field(with_vapour(374, 101325, 100)), "accepted");
}

TEST(AirIndexLaws, EveryStateIsComputedOrRefusedNeverNaN) {
    std::mt19937_64 random{10};
    std::uniform_real_distribution<double> t{-280, 1500}, exponent{-12, 12}, humidity{-5, 200},
        wavelength{-2, 5};
    for (int trial = 0; trial < 20000; ++trial) {
        AirConditions air = workshop();
        air.temperature_degC = t(random);
        air.pressure_Pa = std::pow(10, exponent(random));
        air.relative_humidity_percent = humidity(random);
        air.vacuum_wavelength_nm = std::pow(10, wavelength(random));
        for (const auto& [name, model] : models) {
            const auto index = air_index_of(model, air);
            ASSERT_TRUE(!index || std::isfinite(index->n_minus_1)) << name;
        }
    }
}

TEST(AirIndex, CiddorsOwnSaturationIsWithinOnePerMilleOfIapws) {
    for (double t = 0; t <= 40; t += 0.5) {
        const double kelvins = t + 273.15;
        EXPECT_NEAR(saturation_of_ciddor_Pa(kelvins) / saturation_over_water_Pa(kelvins), 1, 1e-3)
            << t;
    }
    AirConditions air = workshop();
    const double iapws = air_index_of(AirModel::ciddor, air)->vapour_pressure_Pa;
    air.saturation = SaturationForm::ciddor;
    const double own = air_index_of(AirModel::ciddor, air)->vapour_pressure_Pa;
    EXPECT_NE(own, iapws);
    EXPECT_NEAR(own, iapws, 1e-3 * iapws);
}

TEST(AirIndex, IceVanishesTowardsAbsoluteZero) {
    double last = saturation_over_ice_Pa(273.15);
    for (double kelvins = 270; kelvins > 0; kelvins -= 5) {
        EXPECT_LE(saturation_over_ice_Pa(kelvins), last) << kelvins;
        last = saturation_over_ice_Pa(kelvins);
    }
}

} // namespace
} // namespace axiscal::air_index_test

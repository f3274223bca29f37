#include "analysis/compensation/expansion.hpp"

#include "reference_data.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace axiscal::expansion_test {
namespace {

nlohmann::json entry(const std::string& id) {
    const auto file = test::reference_json("uncertainty_thermal.json");
    for (const auto& found : file.at("thermal"))
        if (found.at("id") == id) return found;
    ADD_FAILURE() << id;
    return {};
}

TEST(Expansion, AgreesWithTheClosedFormsOfTheReference) {
    for (const char* id : {"nde_material", "nde_both"}) {
        const auto request = entry(id).at("request");
        const ThermalBody machine{request.at("alpha_M"), request.at("T_M_C")};
        const ThermalBody scale{request.value("alpha_D", 0.0), request.value("T_D_C", 20.0)};
        const auto found = deviation_at_20C(request.at("L"), request.at("x"), machine, scale);
        EXPECT_NEAR(found->first_order, entry(id).at("exact").at("x20").get<double>(), 1e-9);
        const double of_machine = thermal_strain(machine);
        const double difference = of_machine - thermal_strain(scale);
        const double second_order =
            (request.at("L").get<double>() * of_machine - request.at("x").get<double>()) *
            difference;
        EXPECT_NEAR(found->exact - found->first_order, second_order, 1e-6); // third order
    }
}

TEST(Expansion, InterferometerAgreesWithTheReference) {
    for (const char* id : {"disp_deadpath", "disp_cosine"}) {
        const auto request = entry(id).at("request"), expected = entry(id).at("recomputed");
        InterferometerSetup setup;
        setup.vacuum_wavelength_nm = request.value("lambda_nm", 632.9908);
        setup.n_minus_1_at_zero = request.value("n_datum", 1.0) - 1;
        setup.dead_path_mm = request.value("dead_path_mm", 0.0);
        setup.beam_angle_rad = request.value("misalign_rad", 0.0);
        setup.machine = ThermalBody{request.value("alpha_M", 0.0), request.value("T_M_C", 20.0)};
        const auto found =
            displacement_of(setup, request.at("N"), request.at("n").get<double>() - 1);
        // n - 1 out of a printed n: 1e-16 of 316 mm
        EXPECT_NEAR(found->along_axis_mm, expected.at("D_air_mm").get<double>(), 1e-12 * 316);
        EXPECT_NEAR(found->at_20C->exact, expected.at("D20_mm").get<double>(), 1e-12 * 316);
        EXPECT_NEAR(found->at_20C->first_order, expected.at("D20_first_order_mm").get<double>(),
                    1e-12 * 316);
    }
    const auto abbe = entry("disp_cosine");
    EXPECT_NEAR(abbe_error(abbe.at("request").at("abbe_offset_mm"),
                           abbe.at("request").at("abbe_angle_rad")),
                abbe.at("recomputed").at("abbe_mm").get<double>(), 1e-17);
}

TEST(ExpansionLaws, FormsDifferBySecondOrderOnly) {
    std::mt19937_64 random{1};
    std::uniform_real_distribution<double> alpha{0, 25e-6}, t{10, 35}, length{-3e3, 3e3},
        deviation{-0.1, 0.1};
    for (int trial = 0; trial < 1000; ++trial) {
        const ThermalBody machine{alpha(random), t(random)}, scale{alpha(random), t(random)};
        const double L = length(random), x = deviation(random);
        const auto found = deviation_at_20C(L, x, machine, scale);
        const double s = thermal_strain(machine), d = s - thermal_strain(scale);
        // -(L + x) d / (1 + s) + L d = (L s - x) d / (1 + s)
        EXPECT_NEAR(found->exact - found->first_order, (L * s - x) * d / (1 + s), 1e-12);
    }
}

TEST(ExpansionLaws, ScaleOfTheMachinesOwnStuffAtItsTemperatureChangesNothing) {
    std::mt19937_64 random{2};
    std::uniform_real_distribution<double> alpha{0, 25e-6}, t{10, 35}, length{-3e3, 3e3};
    for (int trial = 0; trial < 200; ++trial) {
        const ThermalBody body{alpha(random), t(random)};
        const auto found = deviation_at_20C(length(random), 0.0125, body, body);
        EXPECT_EQ(found->first_order, 0.0125);
        EXPECT_EQ(found->exact, 0.0125);
    }
}

/// A simulated machine: the true displacement at 20 degC is known, the light path is built from it.
TEST(ExpansionLaws, InterferometerFindsTheDisplacementThatWasMade) {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> travel{-2000, 2000}, index{2.5e-4, 2.9e-4},
        dead{0, 1000}, gamma{-2e-3, 2e-3}, t{15, 30};
    for (int trial = 0; trial < 500; ++trial) {
        InterferometerSetup setup;
        setup.passes = trial % 2 == 0 ? 2 : 4;
        setup.n_minus_1_at_zero = index(random);
        setup.dead_path_mm = dead(random);
        setup.beam_angle_rad = gamma(random);
        setup.machine = ThermalBody{11.7e-6, t(random)};
        const double truth_mm = travel(random), n_minus_1 = index(random);
        const double now_mm = truth_mm * (1 + thermal_strain(*setup.machine));
        const double beam_mm = now_mm * std::cos(setup.beam_angle_rad);
        const double path_mm = setup.passes * ((1 + n_minus_1) * (setup.dead_path_mm + beam_mm) -
                                               (1 + setup.n_minus_1_at_zero) * setup.dead_path_mm);
        const double counts = path_mm / (setup.vacuum_wavelength_nm * 1e-6);
        const auto found = displacement_of(setup, counts, n_minus_1);
        EXPECT_NEAR(found->along_axis_mm, now_mm, 1e-11);
        EXPECT_NEAR(found->at_20C->exact, truth_mm, 1e-11);
    }
}

TEST(Expansion, CosineErrorKeepsItsDigitsAtSmallAngles) {
    InterferometerSetup setup;
    setup.beam_angle_rad = 1e-7;
    const auto found = displacement_of(setup, 2e9 / 632.9908 * 1e3, 0); // 1 km
    // L (1 / cos g - 1) = L g^2 / 2
    EXPECT_NEAR(found->cosine_mm / (found->in_air_mm * 0.5e-14), 1, 1e-9);
}

TEST(Expansion, BeamWalkOfARetroreflectorIsTwiceTheSideways) {
    EXPECT_NEAR(beam_angle_of_walk(2, 1000), 1e-3, 1e-9);
}

TEST(ExpansionRefuses, WhatNoBodyDoes) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto field = [](double L, double x, ThermalBody machine, ThermalBody scale) {
        const auto found = deviation_at_20C(L, x, machine, scale);
        return found ? std::string{"accepted"} : found.error().field;
    };
    EXPECT_EQ(field(nan, 0, {}, {}), "distance");
    EXPECT_EQ(field(1, 1e13, {}, {}), "deviation");
    EXPECT_EQ(field(1, 0, {nan, 20}, {}), "machine.expansion_per_K");
    EXPECT_EQ(field(1, 0, {1e-5, -280}, {}), "machine.temperature_degC");
    EXPECT_EQ(field(1, 0, {-1, 22}, {}), "machine");
    EXPECT_EQ(field(1, 0, {}, {11, 25}), "instrument");
    InterferometerSetup setup;
    setup.passes = 3;
    EXPECT_EQ(displacement_of(setup, 1, 0).error().field, "passes");
    setup.passes = 2, setup.dead_path_mm = -1;
    EXPECT_EQ(displacement_of(setup, 1, 0).error().field, "dead_path_mm");
    setup.dead_path_mm = 0, setup.beam_angle_rad = 1.6;
    EXPECT_EQ(displacement_of(setup, 1, 0).error().field, "beam_angle_rad");
    setup.beam_angle_rad = 0;
    EXPECT_EQ(displacement_of(setup, 1, 1.000271).error().field, "n_minus_1");
    EXPECT_EQ(displacement_of(setup, nan, 0).error().field, "counts");
}

} // namespace
} // namespace axiscal::expansion_test

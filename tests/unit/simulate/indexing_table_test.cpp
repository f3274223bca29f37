// The simulated rotary axis: what its table leaves of the angle, what its interferometer counts.
#include "scenario.hpp"
#include "simulated_machine.hpp"
#include "truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace axiscal::simulate::indexing_table_test {
namespace {

constexpr double rad = std::numbers::pi / 180;

Scenario rotary_scenario() {
    Scenario scenario;
    scenario.indexing_table.emplace();
    scenario.laser.kind = "umd2-heterodyne";
    scenario.laser.counts_per_cycle = 1;
    return scenario;
}

TEST(IndexingTable, LeavesTheRestWithItsOwnDeviation) {
    TableScenario table;
    table.deviation_arcsec.assign(72, 0);
    table.deviation_arcsec[2] = 3.6;
    table.deviation_arcsec[71] = -7.2;
    EXPECT_NEAR(rest_deg(table, 11.5, 10), 1.5 + 0.001, 1e-12);
    EXPECT_NEAR(rest_deg(table, -5, -5), -0.002, 1e-12);
    EXPECT_NEAR(rest_deg(table, 361, 360), 1, 1e-12);
}

// N = fold n S sin(rest) / lambda, zero at the first sample.
TEST(IndexingTable, IsCountedByTheSineOfTheRest) {
    Scenario scenario = rotary_scenario();
    SimulatedMachine machine{scenario};
    EXPECT_EQ(machine.cycles_of_rest(0, 0), 0);
    const double n = 1 + refractivity(air_at(scenario.air, 1), nm(scenario.laser.wavelength_nm));
    EXPECT_NEAR(machine.cycles_of_rest(2.5, 1),
                2 * n * 32.61 * std::sin(2.5 * rad) / (632.991354e-6), 1e-6);
    scenario.laser.sign = -1;
    SimulatedMachine turned{scenario};
    EXPECT_EQ(turned.cycles_of_rest(0, 0), 0);
    EXPECT_LT(turned.cycles_of_rest(2.5, 1), 0);
}

TEST(IndexingTable, AnAngleDoesNotGrow) {
    Scenario scenario = rotary_scenario();
    scenario.thermal.material.start = 35;
    SimulatedMachine machine{scenario};
    EXPECT_NEAR(machine.slide_mm(90, 0, 0), 90, 1e-6);
    scenario.indexing_table.reset();
    SimulatedMachine linear{scenario};
    EXPECT_GT(linear.slide_mm(90, 0, 0), 90.01); // 15 K of 11.7e-6/K on 90 mm
}

TEST(IndexingTable, TheTruthsBoundKnowsNoExpansionAndNoLongPathOfAir) {
    Scenario scenario = rotary_scenario();
    scenario.thermal.material.start = 35;
    scenario.errors.approach_noise_um = 0.03;
    const TruthPlan plan{{0, 45, 90}, 2, true};
    const auto truth = truth_of(scenario, plan);
    EXPECT_EQ(truth.at("terms_um").at("material_scale"), 0);
    EXPECT_EQ(truth.at("terms_um").at("first_order"), 0);
    // 632.99 nm / 2 / 65536 on an arm of 32.61 mm: 8.5e-6 thousandths of a degree
    EXPECT_NEAR(truth.at("terms_um").at("counting").get<double>(),
                0.632991354 / 2 / 65536 / (32.61 * rad), 1e-12);
    // two rests of 2500 thousandths of a degree times 6e-8
    EXPECT_NEAR(truth.at("terms_um").at("formula").get<double>(), 2 * 2500 * 6e-8, 1e-12);
}

TEST(IndexingTable, IsReadFromTheScenario) {
    const auto scenario = parse_scenario("[indexing_table]\nstep_deg = 1.0\narm_mm = 30.0\n"
                                         "range_deg = 5.0\ndeviation_arcsec = [0.0, 0.5]\n",
                                         true);
    ASSERT_TRUE(scenario) << scenario.error().detail;
    ASSERT_TRUE(scenario->indexing_table);
    EXPECT_EQ(scenario->indexing_table->step_deg, 1);
    EXPECT_EQ(scenario->indexing_table->deviation_arcsec.size(), 2U);
    EXPECT_FALSE(parse_scenario("[indexing_table]\nstep_deg = 0.0\n", true));
}

} // namespace
} // namespace axiscal::simulate::indexing_table_test

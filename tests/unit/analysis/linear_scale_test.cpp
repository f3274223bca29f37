// A linear scale in the place of the laser: its own expansion, and nothing of air.
#include "largest_error.hpp"
#include "linear_scale_run.hpp"
#include "stated_uncertainty.hpp"

#include "analysis/compensation/thermal_compensation.hpp"
#include "analysis/drift/run_drift.hpp"
#include "analysis/uncertainty/run_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::linear_scale_test {
namespace {

using test::at_seconds;
using test::largest_error_mm;
using test::run_by_scale;
using test::ScaleTruth;

/// One point at 500 mm, of which the scale counts just 500 mm: scale 10e-6 / K at 24 degC, machine
/// 22e-6 / K at 25 degC.
RunRecord one_point(ExpansionForm form) {
    ScaleTruth truth;
    truth.machine_per_K = 22e-6, truth.scale_per_K = 10e-6, truth.form = form;
    truth.machine_C = [](double) { return 25.0; };
    truth.scale_C = [](double) { return 24.0; };
    RunRecord run = run_by_scale(truth);
    run.plan.targets = {mm(500)};
    run.plan.approaches = 1;
    run.plan.bidirectional = false;
    run.plan.points = {{0, 0, Direction::positive, 0}};
    run.points.resize(1);
    run.points.front().planned = run.plan.points.front();
    run.points.front().reading = run.datums.front().reading + mm(500);
    return run;
}

// 500 (1 + 4e-5) = 500.02 true; 500.02 (1 - 11e-5) = 499.9649978. The rule of differences,
// -500 (22e-6 5 - 10e-6 4) = -0.035, leaves out the product of both strains, 2.2 nm.
TEST(LinearScale, BringsACountedLengthTo20DegreesByBothExpansions) {
    const auto found = compensate_to_20C(one_point(ExpansionForm::first_order));
    ASSERT_TRUE(found) << describe(found.error());
    EXPECT_NEAR(found->deviations.forward()[0][0], -0.0350022, 1e-10);
    EXPECT_NEAR(found->summary.before[0], 0.02, 1e-10);
    ASSERT_TRUE(found->summary.scale);
    EXPECT_NEAR(found->summary.scale->largest_correction, 0.02, 1e-10);
    EXPECT_NEAR(found->summary.largest_material_correction, 0.0550022, 1e-10);
    EXPECT_DOUBLE_EQ(found->summary.scale->first_degC, 24);
    EXPECT_DOUBLE_EQ(found->summary.material_last_degC, 25);
}

// 500.02 / 1.00011 = 499.96500384958
TEST(LinearScale, DividesByTheMachinesStrainInTheExactForm) {
    const auto found = compensate_to_20C(one_point(ExpansionForm::exact));
    ASSERT_TRUE(found) << describe(found.error());
    EXPECT_NEAR(found->deviations.forward()[0][0], -0.03499615042, 1e-10);
}

TEST(LinearScale, FindsTheTruthWithoutAnyAirSensorWhicheverWayItCounts) {
    for (const int sign : {1, -1})
        for (const double celsius : {17.0, 20.0, 26.0}) {
            ScaleTruth truth;
            truth.sign = sign;
            truth.machine_C = [celsius](double) { return celsius; };
            EXPECT_LT(largest_error_mm(run_by_scale(truth), truth), 1e-9) << sign << " " << celsius;
        }
}

TEST(LinearScale, FollowsAScaleThatWarmsDuringTheRun) {
    ScaleTruth truth;
    truth.scale_C = [](double s) { return 20 + 3 * s / 2300; };
    truth.machine_C = [](double s) { return 22 - s / 2300; };
    EXPECT_LT(largest_error_mm(run_by_scale(truth), truth), 1e-9);
    RunRecord run = run_by_scale(truth);
    run.scale->coefficient = Expansion{}; // 3 K at 1 m of glass: 25 um
    const auto blind = compensate_to_20C(run);
    ASSERT_TRUE(blind);
    const auto right = compensate_to_20C(run_by_scale(truth));
    EXPECT_GT(std::fabs(blind->summary.after.back() - right->summary.after.back()) +
                  std::fabs(blind->summary.after[10] - right->summary.after[10]),
              1e-4);
}

TEST(LinearScale, TellsNothingOfAir) {
    const auto found = compensate_to_20C(run_by_scale({}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->summary.air_formula, "");
    EXPECT_EQ(found->summary.largest_air_correction, 0);
    EXPECT_EQ(found->summary.refractive_index_minus_1_first, 0);
    EXPECT_EQ(found->summary.vacuum_wavelength_nm, 0);
    EXPECT_EQ(found->deviations.provenance(), "compensated_to_20C");
}

TEST(LinearScale, ItsSensorIsNoneOfTheMachine) {
    RunRecord run = run_by_scale({});
    std::erase_if(run.channels, [](const auto& c) { return c.id == test::machine_channel; });
    const auto without_machine = compensate_to_20C(run);
    ASSERT_FALSE(without_machine);
    EXPECT_NE(without_machine.error().detail.find("no channel of material temperature"),
              std::string::npos);
    run = run_by_scale({});
    run.scale->channels.clear();
    const auto without_scale = compensate_to_20C(run);
    ASSERT_FALSE(without_scale);
    EXPECT_EQ(without_scale.error().fault, Fault::environment_stale);
    EXPECT_NE(without_scale.error().detail.find("no channel of scale temperature"),
              std::string::npos);
}

TEST(LinearScale, MeasuresNoRotaryAxis) {
    RunRecord run = run_by_scale({});
    run.plan.axis_kind = AxisKind::rotary;
    run.rotary.emplace();
    const auto found = compensate_to_20C(run);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().fault, Fault::bad_run_file);
}

/// L = 10 intervals of 95.3 mm.
constexpr double length_m = 0.953;

RunRecord run_with_statements() {
    ScaleTruth truth;
    truth.scale_per_K = 10e-6;
    truth.scale_C = [](double) { return 24.0; };
    RunRecord run = run_by_scale(truth);
    run.scale->standard_uncertainty = um_per_m_kelvin(0.5);
    run.scale->temperature_width = kelvin(0.5);
    run.uncertainty = test::stated_uncertainty();
    return run;
}

TEST(LinearScale, ItsOwnTemperatureAndExpansionAreTermsOfTheBudget) {
    const RunUncertainty known = uncertainty_of(run_with_statements(), 2);
    EXPECT_TRUE(known.missing.empty());
    ASSERT_TRUE(known.budget);
    const auto* temperature = known.budget->find(UncertaintyTerm::device_temperature);
    const auto* expansion = known.budget->find(UncertaintyTerm::device_expansion);
    ASSERT_TRUE(temperature && expansion);
    EXPECT_NEAR(temperature->u, 10 * length_m * 0.5 / (2 * std::sqrt(3.0)), 1e-9);
    EXPECT_NEAR(expansion->u, length_m * 4 * 0.5, 1e-9); // the width is 2 sqrt 3 u
    EXPECT_NE(known.budget->find("E"), nullptr);
}

TEST(LinearScale, WithoutTheWidthOfItsTemperatureNoSystematicUIsStated) {
    RunRecord run = run_with_statements();
    run.scale->temperature_width.reset();
    const RunUncertainty known = uncertainty_of(run, 2);
    ASSERT_EQ(known.missing.size(), 1U);
    EXPECT_EQ(known.missing[0].words, "the width of the scale's temperature");
    ASSERT_TRUE(known.budget);
    EXPECT_EQ(known.budget->find("E"), nullptr);
    EXPECT_NE(known.budget->find("R"), nullptr);
}

TEST(LinearScale, TakesTheDeviceFromItsOwnCertificateAlone) {
    RunRecord run = run_with_statements();
    run.uncertainty->device_U = {};
    ChannelCalibration of_scale;
    of_scale.channel = 0;
    of_scale.expanded_uncertainty = 0.6e-6; // k = 2
    of_scale.expanded_uncertainty_per_m = 1e-6;
    run.calibrations = {of_scale};
    const RunUncertainty known = uncertainty_of(run, 2);
    ASSERT_TRUE(known.statement.device_U);
    EXPECT_NEAR(*known.statement.device_U, 0.6 + length_m, 1e-9);
}

/// An axis at rest 900 mm from its datum, and a scale that warms by 2 K beside it.
TEST(LinearScale, ADriftTestSeesTheAxisAndNotTheWarmingScale) {
    ScaleTruth truth;
    truth.machine_per_K = 0, truth.scale_per_K = 10e-6;
    truth.scale_C = [](double s) { return 20 + 2 * std::min(s, 600.0) / 600; };
    RunRecord run = run_by_scale(truth);
    run.points.clear();
    run.environment.clear();
    for (double s = 0; s <= 600; s += 10) {
        const double reading_m = test::counted_mm(truth, 900, s) * 1e-3;
        run.environment.push_back({0, at_seconds(s), reading_m});
        run.environment.push_back({test::machine_channel, at_seconds(s), 20});
        run.environment.push_back({test::scale_channel, at_seconds(s), truth.scale_C(s)});
    }
    const auto drift =
        evaluate_drift(run, {std::chrono::minutes{10}, std::chrono::seconds{10}, mm(900)});
    ASSERT_TRUE(drift) << describe(drift.error());
    EXPECT_EQ(drift->without_air, 0);
    EXPECT_NEAR(drift->eve.range, 0, 1e-6);
    EXPECT_NEAR(drift->as_read.range, 900e3 * (1 - 1 / (1 + 2e-5)), 1e-6); // 18 um
}

} // namespace
} // namespace axiscal::linear_scale_test

#include "analysis/compensation/thermal_compensation.hpp"
#include "largest_error.hpp"
#include "reference_data.hpp"
#include "simulated_run.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::thermal_compensation_test {
namespace {

using test::at_seconds;
using test::largest_error_mm;
using test::simulated_run;
using test::Truth;

/// Ciddor and modified Edlen lie within 4e-8 of Boensch and Potulski between 17 and 27 degC at
/// 45 % humidity; that acts on the 1 m of path, and the dead path sees only its change.
constexpr double longest_mm = 1000;
constexpr double air_bound_mm = 4e-8 * longest_mm;

TEST(ThermalCompensation, FindsTheTruthWithMaterialAt17And20And26Degrees) {
    for (const double celsius : {17.0, 20.0, 26.0})
        for (const AirFormula formula : {AirFormula::ciddor, AirFormula::edlen}) {
            Truth truth;
            truth.formula = formula;
            truth.material_C = [celsius](double) { return celsius; };
            truth.air_C = [celsius](double) { return celsius + 0.5; };
            EXPECT_LT(largest_error_mm(simulated_run(truth), truth), air_bound_mm)
                << celsius << name_of(formula);
        }
}

TEST(ThermalCompensation, FirstOrderDiffersFromExactByTheSquareOfTheStrain) {
    Truth truth;
    truth.form = ExpansionForm::first_order;
    truth.material_C = [](double) { return 26.0; };
    const double strain = truth.expansion_per_K * 6;
    EXPECT_LT(largest_error_mm(simulated_run(truth), truth),
              air_bound_mm + longest_mm * strain * strain);

    const Length length = mm(1000);
    const Expansion alpha = per_kelvin(truth.expansion_per_K);
    const Length difference =
        displacement_at_20C(length, alpha, 26.0_degC, ExpansionForm::exact) -
        displacement_at_20C(length, alpha, 26.0_degC, ExpansionForm::first_order);
    // 1/(1 + e) - (1 - e) = e^2 - e^3 + ...
    EXPECT_NEAR(difference.in(mm), 1000 * strain * strain, 1000 * strain * strain * strain);
}

TEST(ThermalCompensation, FollowsTemperaturesThatDriftDuringTheRun) {
    Truth truth;
    truth.material_C = [](double s) { return 21 + 3 * s / 2300; };
    truth.air_C = [](double s) { return 20 + 2 * s / 2300; };
    truth.pressure_Pa = [](double s) { return 99800 + 500 * s / 2300; };
    // 3 K over the run are 35 um at 1 m: start and end means would miss by up to half of that
    EXPECT_LT(largest_error_mm(simulated_run(truth), truth),
              air_bound_mm + 4e-8 * truth.dead_path_mm);
}

TEST(ThermalCompensation, DeadPathCountsWhenTheAirChangesAfterTheDatum) {
    Truth truth;
    truth.dead_path_mm = 2000;
    truth.air_C = [](double s) { return s < 80 ? 20.0 : 24.0; };
    EXPECT_LT(largest_error_mm(simulated_run(truth), truth),
              air_bound_mm + 4e-8 * truth.dead_path_mm);
    RunRecord run = simulated_run(truth);
    const auto with = compensate_to_20C(run);
    run.laser.dead_path = Length{};
    const auto without = compensate_to_20C(run);
    // -0.94e-6/K * 4 K * 2 m = -7.5 um
    const double shift_mm = with->deviations.forward()[3][2] - without->deviations.forward()[3][2];
    EXPECT_NEAR(shift_mm, 0.94e-6 * 4 * 2000, 0.04 * 0.94e-6 * 4 * 2000);
}

TEST(ThermalCompensation, BeamAngleIsTakenOut) {
    Truth truth;
    truth.beam_tangent = 2e-3; // reads 2 um short at 1 m
    EXPECT_LT(largest_error_mm(simulated_run(truth), truth), air_bound_mm);
}

TEST(ThermalCompensation, NegativeSignAndDatumInsideTheTravel) {
    Truth truth;
    truth.sign = -1;
    truth.datum_mm = 480.125;
    truth.dead_path_mm = 700;
    EXPECT_LT(largest_error_mm(simulated_run(truth), truth), air_bound_mm);
}

TEST(ThermalCompensation, AgreesWithTheClosedFormsOfTheReference) {
    const auto file = test::reference_json("uncertainty_thermal.json").at("thermal");
    const auto& dead_path = file.at(2);
    ASSERT_EQ(dead_path.at("id"), "disp_deadpath");
    const Length vacuum = nm(632.9908) * 500000;
    EXPECT_NEAR(displacement_in_air(vacuum, 0.000271, 0.00027, mm(500)).in(mm),
                dead_path.at("exact").at("D_air_mm").get<double>(), 1e-10);
    const auto& cosine = file.at(3);
    ASSERT_EQ(cosine.at("id"), "disp_cosine");
    LaserSetup laser;
    laser.beam_walk_travel = mm(1000);
    laser.beam_walk = mm(2000 * std::tan(0.001));
    const Length in_air =
        displacement_in_air(vacuum, 0.00027, 0.00027, Length{}) * cosine_factor_of(laser);
    const auto& expected = cosine.at("recomputed");
    EXPECT_NEAR(in_air.in(mm), expected.at("D_air_mm").get<double>(), 1e-10);
    const auto at_20C = [&](ExpansionForm form) {
        return displacement_at_20C(in_air, per_kelvin(1.17e-5), 22.0_degC, form).in(mm);
    };
    EXPECT_NEAR(at_20C(ExpansionForm::exact), expected.at("D20_mm").get<double>(), 1e-10);
    EXPECT_NEAR(at_20C(ExpansionForm::first_order), expected.at("D20_first_order_mm").get<double>(),
                1e-10);
    const auto& material = file.at(0);
    ASSERT_EQ(material.at("id"), "nde_material");
    const double shift_um =
        displacement_at_20C(um(1e6), per_kelvin(1.17e-5), 23.0_degC, ExpansionForm::first_order)
            .in(um)-1e6;
    EXPECT_NEAR(10 + shift_um, material.at("exact").at("x20").get<double>(), 1e-9);
}

TEST(ThermalCompensation, WithoutABeamWalkTravelTheCosineIsOne) {
    LaserSetup laser;
    laser.beam_walk = mm(3);
    EXPECT_EQ(cosine_factor_of(laser), 1);
}

TEST(ThermalCompensation, SummaryTellsBeforeAndAfterInPlanOrder) {
    Truth truth;
    truth.material_C = [](double) { return 26.0; };
    const RunRecord run = simulated_run(truth);
    const auto found = compensate_to_20C(run);
    ASSERT_TRUE(found.has_value());
    const CompensationSummary& summary = found->summary;
    ASSERT_EQ(summary.before.size(), 110u);
    EXPECT_EQ(summary.after[10], found->deviations.forward()[10][0]);
    EXPECT_EQ(summary.after[11], found->deviations.backward()[10][0]);
    const double last_target_mm = 12.417 + 10 * 95.3;
    const double expansion_mm = last_target_mm * 11.7e-6 * 6;
    EXPECT_NEAR(summary.before[10] - summary.after[10], expansion_mm, expansion_mm * 1e-4);
    EXPECT_NEAR(summary.largest_material_correction, expansion_mm, expansion_mm * 1e-4);
    EXPECT_NEAR(summary.largest_air_correction, last_target_mm * 2.68e-4, 0.02);
    EXPECT_DOUBLE_EQ(summary.material_first_degC, 26.0);
    EXPECT_EQ(summary.air_formula, "ciddor");
    EXPECT_EQ(found->deviations.provenance(), "compensated_to_20C");
}

TEST(ThermalCompensation, TargetsKeepTheDecimalsThatWereGiven) {
    const auto found = compensate_to_20C(simulated_run({}));
    EXPECT_EQ(found->deviations.targets()[0], 12.417);
    EXPECT_EQ(found->deviations.targets()[10], 965.417);
}

TEST(ThermalCompensation, OffsetOfTheCounterDoesNotMatter) {
    RunRecord run = simulated_run({});
    const auto before = compensate_to_20C(run)->summary.after;
    run.datums[0].reading += mm(4096);
    for (auto& point : run.points)
        point.reading += mm(4096);
    const auto after = compensate_to_20C(run)->summary.after;
    // a sum of 5 m rounds to 4.4e-16 m twice
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_NEAR(before[i], after[i], 2e-12);
}

// ---- refusals -------------------------------------------------------------------------------

Error refusal_of(const RunRecord& run) {
    auto found = compensate_to_20C(run);
    return found ? Error{Fault::none, "", {}, ""} : found.error();
}

void drop_readings(RunRecord& run, int channel, double from_s, double to_s) {
    std::erase_if(run.environment, [=](const EnvironmentReading& reading) {
        return reading.channel == channel && reading.at > at_seconds(from_s) &&
               reading.at < at_seconds(to_s);
    });
}

TEST(ThermalCompensation, RefusesAStaleChannelNamingItAndTheStep) {
    RunRecord run = simulated_run({});
    run.air.oldest = std::chrono::seconds{60};
    drop_readings(run, 5, 440, 600); // step 22 is at 520 s: 80 s from either side
    const Error error = refusal_of(run);
    EXPECT_EQ(error.fault, Fault::environment_stale);
    EXPECT_NE(error.detail.find("scale right"), std::string::npos) << error.detail;
    EXPECT_NE(error.detail.find("step 22"), std::string::npos) << error.detail;
    EXPECT_NE(error.detail.find("80.0 s"), std::string::npos) << error.detail;
}

TEST(ThermalCompensation, ReadingJustAsOldAsTheLimitStillCounts) {
    RunRecord run = simulated_run({});
    run.air.oldest = std::chrono::seconds{80};
    drop_readings(run, 5, 440, 600);
    EXPECT_EQ(refusal_of(run).fault, Fault::none);
    run.air.oldest -= std::chrono::nanoseconds{1};
    EXPECT_EQ(refusal_of(run).fault, Fault::environment_stale);
}

TEST(ThermalCompensation, RefusesWhatWasNotMeasured) {
    for (const int channel : {1, 2, 3}) {
        RunRecord run = simulated_run({});
        std::erase_if(run.channels, [=](const auto& record) { return record.id == channel; });
        EXPECT_EQ(refusal_of(run).fault, Fault::environment_stale) << channel;
    }
    RunRecord run = simulated_run({});
    drop_readings(run, 2, -1, 1e6);
    EXPECT_EQ(refusal_of(run).fault, Fault::environment_stale);
}

TEST(ThermalCompensation, AirNeverServesAsMaterial) {
    RunRecord run = simulated_run({});
    run.channels[3].medium = run.channels[4].medium = Medium::air;
    const Error error = refusal_of(run);
    EXPECT_EQ(error.fault, Fault::environment_stale);
    EXPECT_NE(error.detail.find("material temperature"), std::string::npos) << error.detail;
}

TEST(ThermalCompensation, RefusesAnIncompleteRunAndAnotherDatum) {
    RunRecord run = simulated_run({});
    run.points.pop_back();
    EXPECT_EQ(refusal_of(run).fault, Fault::incomplete_run);
    run = simulated_run({});
    run.points[50].datum_id = "serial/1/1";
    EXPECT_EQ(refusal_of(run).fault, Fault::datum_lost);
    run = simulated_run({});
    run.datums.clear();
    EXPECT_EQ(refusal_of(run).fault, Fault::bad_run_file);
    EXPECT_NE(refusal_of(RunRecord{}).fault, Fault::none);
}

TEST(ThermalCompensation, RefusesAPlanThatDoesNotFillItsTable) {
    RunRecord run = simulated_run({});
    run.plan.points[1].approach = 1; // one cell twice, one never
    run.points[1].planned.approach = 1;
    EXPECT_EQ(refusal_of(run).fault, Fault::bad_run_file);
    run = simulated_run({});
    run.plan.points[0].target_index = run.points[0].planned.target_index = 11;
    EXPECT_EQ(refusal_of(run).fault, Fault::bad_run_file);
}

TEST(ThermalCompensation, RefusesImpossibleValuesAndSetups) {
    RunRecord run = simulated_run({});
    for (auto& reading : run.environment)
        if (reading.channel == 3) reading.value = 120;
    EXPECT_EQ(refusal_of(run).fault, Fault::bad_run_file);
    run = simulated_run({});
    run.points[7].reading = metre(std::nan(""));
    EXPECT_NE(refusal_of(run).detail.find("step 8"), std::string::npos);
    run = simulated_run({});
    run.laser.dead_path = mm(-1);
    EXPECT_EQ(refusal_of(run).fault, Fault::bad_run_file);
    run = simulated_run({});
    run.plan.axis_kind = AxisKind::rotary;
    EXPECT_EQ(refusal_of(run).fault, Fault::refused);
}

} // namespace
} // namespace axiscal::thermal_compensation_test

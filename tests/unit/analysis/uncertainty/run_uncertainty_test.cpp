#include "analysis/uncertainty/run_uncertainty.hpp"

#include "analysis/positioning/positioning_certificate.hpp"
#include "tests/unit/analysis/simulated_run.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::run_uncertainty_test {
namespace {

const double root_12 = std::sqrt(12.0);

/// Targets from 12.417 mm in steps of 95.3 mm: L = 0.953 m; n = 5, m = 11.
RunRecord stated_run() {
    RunRecord run = test::simulated_run({});
    run.uncertainty = test::stated_uncertainty();
    return run;
}

double u_of(const RunUncertainty& known, UncertaintyTerm term) {
    return known.budget->find(term)->u;
}

std::vector<std::string> names_of(const RunUncertainty& known) {
    std::vector<std::string> names;
    for (const MissingTerm& term : known.missing)
        names.push_back(term.name);
    return names;
}

bool has(const RunUncertainty& known, const char* key) {
    return known.budget && known.budget->find(key) != nullptr;
}

TEST(RunUncertainty, TakesLengthTemperatureAndExpansionFromTheRun) {
    const RunUncertainty known = uncertainty_of(stated_run(), 2);
    ASSERT_TRUE(known.budget);
    EXPECT_TRUE(known.missing.empty());
    // material at 23 degC, its two sensors 0.25 K below and above: dT = 3.25 K
    EXPECT_NEAR(u_of(known, UncertaintyTerm::device), 0.7 * 0.953 / 2, 1e-12);
    EXPECT_NEAR(u_of(known, UncertaintyTerm::misalignment), 1 / (2 * 0.953) / root_12, 1e-12);
    EXPECT_NEAR(u_of(known, UncertaintyTerm::machine_temperature), 11.7 * 0.953 * 0.7 / root_12,
                1e-12);
    EXPECT_NEAR(u_of(known, UncertaintyTerm::machine_expansion), 0.953 * 3.25 * 2 / root_12, 1e-12);
    EXPECT_NEAR(u_of(known, UncertaintyTerm::environment), 1.7 / root_12, 1e-12);
}

TEST(RunUncertainty, OfEachParameterIsTheClosedFormOfTheAnnex) {
    const RunUncertainty known = uncertainty_of(stated_run(), 2);
    const double eve = 1.7 / root_12;
    double systematic = 0;
    for (const double u : {0.7 * 0.953 / 2, 1 / (2 * 0.953) / root_12, 11.7 * 0.953 * 0.7 / root_12,
                           0.953 * 3.25 * 2 / root_12})
        systematic += u * u;
    const auto U = [&](const char* key) { return known.budget->find(key)->expanded; };
    EXPECT_NEAR(U("R_forward"), 4 * eve, 1e-12); // n = 5
    EXPECT_NEAR(U("B"), 2 * eve * std::sqrt(0.4), 1e-12);
    EXPECT_NEAR(U("R"), 2 * eve * std::sqrt(4.4), 1e-12);
    EXPECT_NEAR(U("E"), 2 * std::sqrt(systematic + eve * eve / 5), 1e-12);
    EXPECT_NEAR(U("M"), 2 * std::sqrt(systematic + eve * eve / 10), 1e-12);
    EXPECT_NEAR(U("A_backward"), 2 * std::sqrt(systematic + eve * eve * 4.2), 1e-12);
}

TEST(RunUncertainty, CountsADeviceLimitOfTheWholeLengthOnce) {
    RunRecord run = stated_run();
    run.uncertainty->device_U = {um(0.5), std::nullopt};
    run.uncertainty->device_k = 2.5;
    EXPECT_NEAR(u_of(uncertainty_of(run, 2), UncertaintyTerm::device), 0.2, 1e-12);
    run.uncertainty->device_U = {};
    run.uncertainty->device_width = {std::nullopt, Ratio::from_si(0.8e-6)};
    EXPECT_NEAR(u_of(uncertainty_of(run, 2), UncertaintyTerm::device), 0.8 * 0.953 / root_12,
                1e-12);
}

TEST(RunUncertainty, TakesTheLargestOffsetOfAnyMaterialSensorBelow20DegreesToo) {
    RunRecord run = stated_run();
    for (EnvironmentReading& reading : run.environment)
        if (reading.channel == 4) reading.value = 16.5; // the air sensor stays at 22
    EXPECT_NEAR(*uncertainty_of(run, 2).statement.temperature_offset_K, 3.5, 1e-12);
}

TEST(RunUncertainty, TakesTheWidthOfTheCoefficientFromItsStandardUncertaintyAndSaysSo) {
    RunRecord run = stated_run();
    run.uncertainty->expansion_width.reset();
    EXPECT_EQ(names_of(uncertainty_of(run, 2)), std::vector<std::string>{"expansion"});
    run.material.standard_uncertainty = per_kelvin(0.6e-6);
    const RunUncertainty known = uncertainty_of(run, 2);
    EXPECT_TRUE(known.missing.empty());
    // the standard uncertainty itself comes out again
    EXPECT_NEAR(u_of(known, UncertaintyTerm::machine_expansion), 0.953 * 3.25 * 0.6, 1e-12);
    ASSERT_EQ(known.remarks.size(), 1U);
    EXPECT_NE(known.remarks[0].find("2.08"), std::string::npos) << known.remarks[0];
}

/// Laser 0.4 um/m and material 0.06 K, both k = 2; air 0.1 K, 20 Pa and 4 %.
void add_certificates(RunRecord& run) {
    run.channels.push_back(
        {0, "axis 1", run.laser.instrument, "", ChannelKind::displacement, Medium::none, 0});
    const auto add = [&](int channel, double U) {
        run.calibrations.emplace_back().channel = channel;
        run.calibrations.back().expanded_uncertainty = U;
    };
    run.calibrations.emplace_back().expanded_uncertainty_per_m = 0.4e-6;
    add(1, 0.1), add(2, 20), add(3, 4), add(4, 0.06), add(5, 0.06);
}

TEST(RunUncertainty, TakesDeviceAndTemperatureFromTheCertificatesWhereNothingIsStated) {
    RunRecord run = stated_run();
    run.uncertainty->device_U = {};
    run.uncertainty->temperature_width.reset();
    add_certificates(run);
    const RunUncertainty known = uncertainty_of(run, 2);
    EXPECT_TRUE(known.missing.empty());
    // u of one metre: laser 0.2 um; by NIST's sensitivities of air 0.05 K x 0.945, 10 Pa x 0.0027,
    // 2 % x 0.0085 um: sqrt(0.04 + 0.002233 + 0.000729 + 0.000289) = 0.20797 um; times 0.953 m.
    EXPECT_NEAR(u_of(known, UncertaintyTerm::device), 0.20797 * 0.953, 0.001);
    // u = 0.03 K of the material's worst sensor: 11.7 um/(m K) x 0.953 m x 0.03 K
    EXPECT_NEAR(u_of(known, UncertaintyTerm::machine_temperature), 11.7 * 0.953 * 0.03, 1e-12);
    EXPECT_EQ(known.remarks.size(), 2U);
}

TEST(RunUncertainty, TakesWhatIsStatedBeforeTheCertificates) {
    RunRecord run = stated_run();
    const RunUncertainty before = uncertainty_of(run, 2);
    add_certificates(run);
    const RunUncertainty known = uncertainty_of(run, 2);
    for (const UncertaintyTerm term :
         {UncertaintyTerm::device, UncertaintyTerm::machine_temperature})
        EXPECT_EQ(u_of(known, term), u_of(before, term));
    EXPECT_TRUE(known.remarks.empty());
}

TEST(RunUncertainty, LeavesOutEveryParameterOfWhichATermIsMissing) {
    RunRecord run = stated_run();
    run.uncertainty->misalignment.reset();
    RunUncertainty known = uncertainty_of(run, 2);
    EXPECT_EQ(names_of(known), std::vector<std::string>{"alignment"});
    EXPECT_FALSE(has(known, "A") || has(known, "E_forward") || has(known, "M"));
    EXPECT_TRUE(has(known, "R") && has(known, "R_forward") && has(known, "B") &&
                has(known, "B_mean"));
    run = stated_run();
    run.uncertainty->eve.reset();
    known = uncertainty_of(run, 2);
    EXPECT_EQ(names_of(known), std::vector<std::string>{"drift"});
    EXPECT_TRUE(known.budget->parameters.empty());
    EXPECT_EQ(known.budget->contributions.size(), 4U);
}

TEST(RunUncertainty, NamesEveryTermOfARunWithoutStatement) {
    const RunUncertainty known = uncertainty_of(test::simulated_run({}), 2);
    EXPECT_FALSE(known.budget);
    EXPECT_EQ(names_of(known), (std::vector<std::string>{"device", "alignment", "temperature",
                                                         "expansion", "drift"}));
    EXPECT_TRUE(known.remarks.empty());
}

TEST(RunUncertainty, OfAnImpossibleStatementIsMissingWithItsReason) {
    RunRecord run = stated_run();
    run.uncertainty->misalignment = mm(96); // L / 10 = 95.3 mm
    const RunUncertainty known = uncertainty_of(run, 2);
    EXPECT_FALSE(known.budget);
    ASSERT_EQ(known.missing.size(), 1U);
    EXPECT_NE(known.missing[0].words.find("a tenth of the length"), std::string::npos);
    run.plan.targets.resize(1); // no length at all
    EXPECT_FALSE(uncertainty_of(run, 2).budget);
    run.plan.targets.clear();
    EXPECT_FALSE(uncertainty_of(run, 2).budget);
}

/// The figures of a run that is simulated beside its budget.
MonteCarloResult simulated(RunRecord run) {
    return *make_certificate(std::move(run), "").value().uncertainty.simulation;
}

TEST(RunUncertainty, IsSimulatedBesideTheFormulas) {
    const MonteCarloResult drawn = simulated(stated_run());
    EXPECT_EQ(drawn.figures.size(), 12U);
    EXPECT_EQ(drawn.trials, 100'000);
    // B_mean is linear in the readings: u_EVE sqrt(2 / (n m)), in mm; sampling 0.2 %
    EXPECT_NEAR(drawn.find("B_mean")->u, 0.0017 / root_12 * std::sqrt(2.0 / 55), 1e-6 * 0.7);
    EXPECT_EQ(drawn.find("C"), nullptr);
}

TEST(RunUncertainty, IsSimulatedOnlyForParametersWhoseEveryTermIsStated) {
    RunRecord run = stated_run();
    run.uncertainty->misalignment.reset();
    const MonteCarloResult drawn = simulated(run);
    EXPECT_TRUE(drawn.find("R") && drawn.find("B"));
    EXPECT_FALSE(drawn.find("A") || drawn.find("E"));
    run.uncertainty->eve.reset();
    EXPECT_FALSE(make_certificate(run, "").value().uncertainty.simulation);
    EXPECT_FALSE(make_certificate(test::simulated_run({}), "").value().uncertainty.simulation);
}

TEST(RunUncertainty, IsSimulatedWithTheSeedOfThePlanOrOneOfTheRunsId) {
    RunRecord run = stated_run();
    run.plan.seed = (std::uint64_t{1} << 60) + 4711; // a case can state 53 bits
    EXPECT_EQ(simulated(run).seed, 4711U);
    run.plan.seed.reset();
    run.run_id = "foobar"; // 64-bit FNV-1a, published: 0x85944171f73967e8
    EXPECT_EQ(simulated(run).seed, 0x85944171f73967e8U & 0x1fffffffffffffU);
}

TEST(RunUncertainty, FindsTheTargetOfEachParameter) {
    RunRecord run = stated_run();
    run.uncertainty->targets = {{"A", um(5)}, {"R", um(2)}};
    EXPECT_EQ(target_uncertainty_of(run, "R")->limit, um(2));
    EXPECT_EQ(target_uncertainty_of(run, "E"), nullptr);
    run.uncertainty.reset();
    EXPECT_EQ(target_uncertainty_of(run, "A"), nullptr);
}

TEST(RunUncertainty, MakesTheCertificateFinalAndLeavesEveryBitOfItsResult) {
    const auto bare = make_certificate(test::simulated_run({}), "");
    const auto stated = make_certificate(stated_run(), "");
    ASSERT_TRUE(bare && stated);
    EXPECT_TRUE(bare->preliminary);
    EXPECT_FALSE(stated->preliminary);
    EXPECT_EQ(canonical_bytes(bare->result), canonical_bytes(stated->result));
}

} // namespace
} // namespace axiscal::run_uncertainty_test

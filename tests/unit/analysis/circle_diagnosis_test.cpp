// The decomposition against truths that the traces were made from.

#include "analysis/circular/circle_diagnosis.hpp"
#include "synthetic_circle.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::circle_diagnosis_test {
namespace {

using circular::Cause;
using namespace test;

CircleDiagnosis diagnose(const CircularTest& test) {
    return diagnose_circle(test, {"X", "Y"}).value();
}

std::vector<Cause> every_cause() {
    std::vector<Cause> causes;
    for (std::size_t i = 0; i < circular::cause_count; ++i)
        causes.push_back(static_cast<Cause>(i));
    return causes;
}

const CauseContribution* find(const CircleDiagnosis& diagnosis, const std::string& cause) {
    const auto found = std::ranges::find(diagnosis.ranking, cause, &CauseContribution::cause);
    return found == diagnosis.ranking.end() ? nullptr : &*found;
}

/// Every cause of a size that makes micrometres.
CircleTruth random_truth(std::mt19937_64& random, double R, double F) {
    std::uniform_real_distribution<double> um{-0.01, 0.01};
    CircleTruth truth;
    for (const Cause cause : every_cause())
        truth[reference_name(cause)] = um(random) / leverage_of(cause, R, F);
    return truth;
}

TEST(CircleDiagnosis, FindsTheTruthOfEverySyntheticCaseOfTheReference) {
    const auto sets = reference_json("ballbar_synthetic.json").at("cases");
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const CircleDiagnosis found = diagnose(reference_test(set));
        EXPECT_EQ(found.rank, 14);
        EXPECT_FALSE(found.reversals_masked);
        EXPECT_TRUE(found.not_separable.empty());
        EXPECT_TRUE(found.cyclic.empty());
        CircleTruth truth = set.at("truth");
        const bool noisy = !set.at("request").is_null();
        for (const Cause cause : every_cause()) {
            const auto& estimate = found.of(cause);
            const double fitted = set.at("recomputed_fit").at(reference_name(cause));
            EXPECT_NEAR(*estimate.value, fitted, 1e-13) << reference_name(cause);
            const double allowed = noisy ? 3.5 * estimate.standard_uncertainty : 1e-15;
            EXPECT_NEAR(*estimate.value, truth[reference_name(cause)], allowed)
                << reference_name(cause);
        }
        if (noisy) {
            EXPECT_NEAR(found.residual_rms_mm, 2e-4, 1e-5);
        }
    }
}

TEST(CircleDiagnosis, FindsEveryMixtureOfCausesAtAnyRadiusAndFeed) {
    std::mt19937_64 random{7};
    for (const double R : {20.0, 150.0, 500.0})
        for (int trial = 0; trial < 20; ++trial) {
            const double F = 5 + 10.0 * trial;
            const CircleTruth truth = random_truth(random, R, F);
            const auto angles =
                trial % 2 ? even_angles(-20, 200, 0.5) : even_angles(0.25, 359.9, 0.5);
            const CircleDiagnosis found = diagnose(made_test(truth, angles, R, F));
            EXPECT_FALSE(found.reversals_masked);
            for (const Cause cause : every_cause())
                EXPECT_NEAR(*found.of(cause).value * leverage_of(cause, R, F),
                            truth.at(reference_name(cause)) * leverage_of(cause, R, F), 1e-14)
                    << reference_name(cause);
        }
}

TEST(CircleDiagnosis, StatesUncertaintiesThatTheScatterOfManyTestsConfirms) {
    std::mt19937_64 random{11};
    std::normal_distribution<double> noise{0, 3e-4};
    const auto clean = made_test(CircleTruth{{"square", 2e-5}}, even_angles(-20, 200, 1));
    std::map<Cause, double> squares;
    constexpr int tests = 200;
    for (int i = 0; i < tests; ++i) {
        CircularTest test = clean;
        for (auto& trace : test.traces)
            for (double& dr : trace.radial_deviation_mm)
                dr += noise(random);
        const CircleDiagnosis found = diagnose(test);
        if (found.reversals_masked || !found.cyclic.empty()) continue; // chance; not what is asked
        for (const Cause cause : every_cause()) {
            const double truth = cause == Cause::squareness ? 2e-5 : 0;
            const double z =
                (*found.of(cause).value - truth) / found.of(cause).standard_uncertainty;
            squares[cause] += z * z;
        }
    }
    for (const Cause cause : every_cause()) // chi-square of 200: 1 +- 0.1
        EXPECT_NEAR(squares[cause] / tests, 1, 0.4) << reference_name(cause);
}

TEST(CircleDiagnosis, OneSenseDoesNotTellSquarenessFromLagDifferenceAndSaysSo) {
    CircularTest test =
        made_test(CircleTruth{{"square", 5e-5}, {"backlash_x", 0.004}}, even_angles(0.5, 359.5, 1));
    test.traces.pop_back();
    const CircleDiagnosis found = diagnose(test);
    EXPECT_FALSE(found.of(Cause::squareness).value);
    EXPECT_FALSE(found.of(Cause::servo_lag_difference).value);
    EXPECT_FALSE(found.of(Cause::center_cw_x).value) << "was not measured";
    EXPECT_NEAR(*found.of(Cause::backlash_x).value, 0.004, 1e-14);
    EXPECT_EQ(found.columns, 12);
    const auto tied = [&](Cause a, Cause b) {
        return std::ranges::any_of(found.not_separable, [&](const InseparableGroup& group) {
            return std::ranges::find(group.causes, a) != group.causes.end() &&
                   std::ranges::find(group.causes, b) != group.causes.end();
        });
    };
    EXPECT_TRUE(tied(Cause::squareness, Cause::servo_lag_difference));
    EXPECT_EQ(find(found, "squareness"), nullptr);
    // what the two make together is known: R beta of an ellipse
    ASSERT_NE(find(found, "not_separable"), nullptr);
    EXPECT_NEAR(found.not_separable.front().peak_to_valley_mm, 150 * 5e-5, 2e-6)
        << "the nearest reading is half a degree off the crest";
}

TEST(CircleDiagnosis, AnArcWithinAQuarterLeavesOutWhatItCannotSee) {
    const CircularTest test = made_test(CircleTruth{{"square", 5e-5}}, even_angles(10, 80, 0.5));
    const CircleDiagnosis found = diagnose(test);
    EXPECT_LT(found.rank, found.columns);
    EXPECT_FALSE(found.of(Cause::backlash_x).value) << "no reversal of X was seen";
    EXPECT_FALSE(found.not_separable.empty());
    for (const InseparableGroup& group : found.not_separable)
        EXPECT_TRUE(std::isfinite(group.peak_to_valley_mm));
}

TEST(CircleDiagnosis, ASpikeIsFoundAndDoesNotBendTheCauses) {
    const CircleTruth truth{{"backlash_x", 0.005}, {"square", 3e-5}, {"straight_y", 0.002}};
    CircularTest test = made_test(truth, even_angles(0.25, 359.9, 0.5));
    CircularTrace& ccw = test.traces.front();
    for (std::size_t i = 0; i < ccw.angle_rad.size(); ++i) {
        const double past = ccw.angle_rad[i] / one_degree - 90; // Y reverses
        if (past > 0 && past < 3)
            ccw.radial_deviation_mm[i] -= 0.006 * (1 - std::fabs(past - 1.5) / 1.5);
    }
    const CircleDiagnosis found = diagnose(test);
    EXPECT_TRUE(found.reversals_masked);
    for (const Cause cause : every_cause())
        EXPECT_NEAR(*found.of(cause).value,
                    truth.contains(reference_name(cause)) ? truth.at(reference_name(cause)) : 0,
                    1e-13);
    int spikes = 0;
    for (const auto& reversal : found.reversals) {
        if (!reversal.spike_significant) continue;
        ++spikes;
        EXPECT_EQ(reversal.sense, Sense::ccw);
        EXPECT_EQ(reversal.axis, 1);
        EXPECT_EQ(reversal.at_deg, 90);
        EXPECT_NEAR(reversal.spike_mm, -0.006, 0.006 * 0.5 / 1.5 / 2 + 1e-9);
        EXPECT_NEAR(reversal.spike_width_deg, 1.5, 0.6);
        EXPECT_NEAR(reversal.spike_width_ms,
                    reversal.spike_width_deg * one_degree * 150 / test.feed_mm_per_s * 1000, 1e-9);
    }
    EXPECT_EQ(spikes, 1);
    ASSERT_NE(find(found, "reversal_spikes"), nullptr);
    EXPECT_NE(find(found, "reversal_spikes")->words.find("inward"), std::string::npos);
}

TEST(CircleDiagnosis, EveryReversalHasAStepOfItsOwn) {
    CircularTest test =
        made_test(CircleTruth{{"backlash_x", 0.004}}, even_angles(0.25, 359.9, 0.5));
    // counter-clockwise at 180 deg the step is 1 um higher: fading out over 60 deg of arc
    CircularTrace& ccw = test.traces.front();
    for (std::size_t i = 0; i < ccw.angle_rad.size(); ++i) {
        const double past = ccw.angle_rad[i] / one_degree - 180;
        if (past > 0 && past < 12.1) ccw.radial_deviation_mm[i] += 0.001;
    }
    const CircleDiagnosis found = diagnose(test);
    ASSERT_EQ(found.reversals.size(), 8);
    for (const auto& reversal : found.reversals) {
        const bool changed = reversal.sense == Sense::ccw && reversal.at_deg == 180;
        const double truth = reversal.axis == 1 ? 0 : changed ? 0.005 : 0.004;
        EXPECT_NEAR(reversal.step_mm, truth, 1.5e-4) << reversal.at_deg;
    }
}

TEST(CircleDiagnosis, FindsAPeriodicErrorOfUnknownPitchAndItsAxis) {
    std::mt19937_64 random{3};
    std::normal_distribution<double> noise{0, 2e-4};
    for (const int axis : {0, 1})
        for (const double pitch : {10.0, 12.345, 40.0}) {
            const double R = 150, amplitude = 0.0015, phase = 0.7;
            CircularTest test = made_test(CircleTruth{{"square", 3e-5}, {"lateral_x", 0.002}},
                                          even_angles(0.125, 359.9, 0.25));
            for (auto& trace : test.traces)
                for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
                    const double w =
                        axis == 0 ? std::cos(trace.angle_rad[i]) : std::sin(trace.angle_rad[i]);
                    trace.radial_deviation_mm[i] +=
                        amplitude * w * std::cos(2 * std::numbers::pi * R * w / pitch + phase) +
                        noise(random);
                }
            const CircleDiagnosis found = diagnose(test);
            ASSERT_EQ(found.cyclic.size(), 1) << pitch;
            const auto& cyclic = found.cyclic.front();
            EXPECT_EQ(cyclic.axis, axis);
            EXPECT_NEAR(cyclic.pitch_mm, pitch, 5 * cyclic.pitch_standard_uncertainty_mm);
            EXPECT_LT(cyclic.pitch_standard_uncertainty_mm, pitch * 1e-2);
            EXPECT_NEAR(cyclic.amplitude_mm, amplitude,
                        5 * cyclic.amplitude_standard_uncertainty_mm);
            EXPECT_LT(cyclic.amplitude_standard_uncertainty_mm, 5e-5);
            EXPECT_NEAR(cyclic.phase_rad, phase, 0.2);
            EXPECT_NEAR(*found.of(Cause::squareness).value, 3e-5,
                        5 * found.of(Cause::squareness).standard_uncertainty);
        }
}

TEST(CircleDiagnosis, APeriodicErrorWithoutNoiseIsFoundExactly) {
    const double R = 100, pitch = 8;
    CircularTest test =
        made_test(CircleTruth{{"backlash_y", 0.003}}, even_angles(0.125, 359.9, 0.25), R);
    for (auto& trace : test.traces)
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
            const double c = std::cos(trace.angle_rad[i]);
            trace.radial_deviation_mm[i] +=
                0.002 * c * std::cos(2 * std::numbers::pi * R * c / pitch - 1.2);
        }
    const CircleDiagnosis found = diagnose(test);
    ASSERT_EQ(found.cyclic.size(), 1);
    EXPECT_NEAR(found.cyclic.front().pitch_mm, pitch, 1e-9);
    EXPECT_NEAR(found.cyclic.front().amplitude_mm, 0.002, 1e-12);
    EXPECT_NEAR(found.cyclic.front().phase_rad, -1.2, 1e-8);
    EXPECT_NEAR(*found.of(Cause::backlash_y).value, 0.003, 1e-12);
}

TEST(CircleDiagnosis, LobesEvenInAngleAreNoErrorOfAnAxis) {
    std::mt19937_64 random{13};
    std::normal_distribution<double> noise{0, 1e-4};
    for (const int lobes : {4, 5, 8, 13, 40})
        for (const bool noisy : {false, true}) {
            CircularTest test =
                made_test(CircleTruth{{"square", 1e-5}}, even_angles(0.25, 359.9, 0.5));
            for (auto& trace : test.traces)
                for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
                    trace.radial_deviation_mm[i] +=
                        0.002 * std::sin(lobes * trace.angle_rad[i]) + (noisy ? noise(random) : 0);
            const CircleDiagnosis found = diagnose(test);
            EXPECT_TRUE(found.cyclic.empty()) << lobes;
            ASSERT_TRUE(found.lobes) << lobes;
            EXPECT_EQ(found.lobes->per_turn, lobes);
            // what the step-shaped causes take of them
            EXPECT_NEAR(found.lobes->amplitude_mm, 0.002, 0.0007);
        }
}

TEST(CircleDiagnosis, NoiseAloneShowsNoPeriodNoSpikeNoStep) {
    std::mt19937_64 random{5};
    std::normal_distribution<double> noise{0, 5e-4};
    int cyclic = 0, spikes = 0, steps = 0;
    for (int i = 0; i < 30; ++i) {
        CircularTest test = made_test({}, even_angles(0.25, 359.9, 0.5));
        for (auto& trace : test.traces)
            for (double& dr : trace.radial_deviation_mm)
                dr += noise(random);
        const CircleDiagnosis found = diagnose(test);
        cyclic += static_cast<int>(found.cyclic.size());
        for (const auto& reversal : found.reversals)
            spikes += reversal.spike_significant ? 1 : 0;
        for (const auto& step : found.change_overs)
            steps += step.significant ? 1 : 0;
        ASSERT_TRUE(found.vibration);
        EXPECT_NEAR(found.vibration->rms_mm, 5e-4, 6e-5) << "white noise passes whole";
    }
    EXPECT_EQ(cyclic, 0);
    EXPECT_EQ(spikes, 0);
    EXPECT_LE(steps, 1);
}

TEST(CircleDiagnosis, AChangeOverOfTheLeadIsASignedStep) {
    std::mt19937_64 random{6};
    std::normal_distribution<double> noise{0, 1e-4};
    CircularTest test = made_test({}, even_angles(0.25, 359.9, 0.5));
    for (auto& trace : test.traces)
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
            const double angle = trace.angle_rad[i] / one_degree;
            trace.radial_deviation_mm[i] += noise(random) + (angle > 45 && angle < 75 ? 0.002 : 0);
        }
    const CircleDiagnosis found = diagnose(test);
    for (const auto& step : found.change_overs) {
        if (step.at_deg != 45) continue;
        EXPECT_TRUE(step.significant);
        EXPECT_NEAR(step.step_mm, step.sense == Sense::ccw ? 0.002 : -0.002, 3e-4);
    }
    EXPECT_NE(find(found, "change_over"), nullptr);
}

TEST(CircleDiagnosis, RanksTheCausesByWhatEachAddsToG) {
    const CircularTest test = made_test(CircleTruth{{"square", 4e-5},
                                                    {"backlash_y", 0.002},
                                                    {"straight_x", 0.006},
                                                    {"lateral_x", 0.003},
                                                    {"scale_x", 3e-5},
                                                    {"scale_y", 2.5e-5},
                                                    {"off_x_ccw", 0.04}},
                                        even_angles(0.5, 359.5, 1));
    const CircleDiagnosis found = diagnose(test);
    EXPECT_TRUE(
        std::ranges::is_sorted(found.ranking, std::ranges::greater{}, &CauseContribution::G_mm));
    EXPECT_EQ(found.ranking.front().cause, "squareness");
    // closed forms: R beta; By; Sx sin 3 theta / 4; P |s| / 2, which the senses double; R (ex - ey)
    EXPECT_NEAR(find(found, "squareness")->G_mm, 150 * 4e-5, 1e-5);
    EXPECT_NEAR(find(found, "backlash_y")->G_mm, 0.002, 1e-5);
    EXPECT_NEAR(find(found, "straightness_x")->G_mm, 0.003, 1e-5);
    EXPECT_NEAR(find(found, "straightness_x")->peak_to_valley_mm, 0.012, 1e-5);
    EXPECT_NEAR(find(found, "lateral_play_x")->G_mm, 0.0015, 2e-5);
    EXPECT_NEAR(find(found, "lateral_play_x")->G_b_mm, 0.003, 2e-5);
    EXPECT_NEAR(find(found, "scale_mismatch")->G_mm, 150 * 5e-6, 1e-6);
    EXPECT_EQ(find(found, "center"), nullptr) << "a centre is no form";
}

TEST(CircleDiagnosis, SaysTheSignsInWords) {
    const auto words = [](const char* name, double value, const std::string& cause) {
        const auto test = made_test(CircleTruth{{name, value}}, even_angles(0.5, 359.5, 1));
        return find(diagnose(test), cause)->words;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_TRUE(has(words("square", 5e-5, "squareness"), "50 urad"));
    EXPECT_TRUE(has(words("square", 5e-5, "squareness"), "more than 90 deg"));
    EXPECT_TRUE(has(words("square", 5e-5, "squareness"), "135/315"));
    EXPECT_TRUE(has(words("square", -5e-5, "squareness"), "less than 90 deg"));
    EXPECT_TRUE(has(words("servo", 4e-4, "servo_lag_difference"), "X lags Y by 0.4 ms"));
    EXPECT_TRUE(has(words("servo", -4e-4, "servo_lag_difference"), "Y lags X"));
    EXPECT_TRUE(has(words("servo", 2.5e-5, "servo_lag_difference"), "X lags Y by 25 us"));
    EXPECT_TRUE(has(words("backlash_x", 0.008, "backlash_x"), "X loses 8 um"));
    EXPECT_TRUE(has(words("backlash_x", 0.008, "backlash_x"), "outward at 0 and 180 deg"));
    EXPECT_TRUE(has(words("backlash_y", -0.003, "backlash_y"), "Y gains 3 um"));
    EXPECT_TRUE(has(words("scale_x", 1e-5, "scale_mismatch"), "X travels 10 um/m farther than Y"));
    EXPECT_TRUE(has(words("straight_x", 0.01, "straightness_x"), "middle toward +Y"));
    EXPECT_TRUE(has(words("lateral_x", 0.01, "lateral_play_x"),
                    "the counter-clockwise trace lies outside"));
    EXPECT_TRUE(
        has(words("lateral_y", 0.01, "lateral_play_y"), "the clockwise trace lies outside"));
}

TEST(CircleDiagnosis, AMillionReadingsGiveTheSameCausesAsAThousand) {
    std::mt19937_64 random{9};
    const CircleTruth truth = random_truth(random, 150, 1000.0 / 60);
    const auto angles = even_angles(0.0005, 359.9999, 0.001);
    const CircleDiagnosis found = diagnose(made_test(truth, angles));
    for (const Cause cause : every_cause())
        EXPECT_NEAR(*found.of(cause).value * leverage_of(cause, 150, 1000.0 / 60),
                    truth.at(reference_name(cause)) * leverage_of(cause, 150, 1000.0 / 60), 1e-9);
}

TEST(CircleDiagnosis, ACommonLagIsBoundedAndNotClaimed) {
    const CircleDiagnosis found = diagnose(
        made_test(CircleTruth{{"scale_x", -2e-6}, {"scale_y", -2e-6}}, even_angles(0.5, 359.5, 1)));
    ASSERT_TRUE(found.common_lag && found.common_lag->longest_s);
    const double tau = *found.common_lag->longest_s, turning = (1000.0 / 60) / 150;
    EXPECT_NEAR(-150 * (turning * tau) * (turning * tau) / 2, 150 * -2e-6, 1e-12);
}

} // namespace
} // namespace axiscal::circle_diagnosis_test

#include "analysis/positioning/budget_inputs.hpp"
#include "linear_scale_run.hpp"
#include "simulated_run.hpp"
#include "stated_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace axiscal::budget_inputs_test {
namespace {

Certificate certificate_of(RunRecord run) {
    auto made = make_certificate(std::move(run), "");
    EXPECT_TRUE(made);
    return *std::move(made);
}

RunRecord stated_run() {
    RunRecord run = test::simulated_run({});
    run.uncertainty = test::stated_uncertainty();
    return run;
}

BudgetInput named(const std::vector<BudgetInput>& inputs, const std::string& quantity) {
    const auto found = std::ranges::find(inputs, quantity, &BudgetInput::quantity);
    return found == inputs.end() ? BudgetInput{} : *found;
}

TEST(BudgetInputs, WhatAPersonTypedIsMarkedWithItsKey) {
    const auto inputs = budget_inputs_of(certificate_of(stated_run()));
    const BudgetInput eve = named(inputs, "E_VE");
    EXPECT_EQ(eve.origin, InputOrigin::typed);
    EXPECT_EQ(eve.where, "uncertainty.eve");
    EXPECT_NEAR(*eve.value, 1.7, 1e-12);
    const BudgetInput device = named(inputs, "U of the device over the length");
    EXPECT_NEAR(*device.value, 0.7 * 0.953, 1e-9) << "0.7 um/m over ten intervals of 95.3 mm";
    EXPECT_EQ(named(inputs, "offset of the beam over the length").where,
              "uncertainty.misalignment");
}

TEST(BudgetInputs, TheDistanceFrom20DegreesIsThatOfTheReadings) {
    const BudgetInput offset =
        named(budget_inputs_of(certificate_of(stated_run())), "largest distance from 20 degC");
    EXPECT_EQ(offset.origin, InputOrigin::readings);
    EXPECT_NEAR(*offset.value, 3.25, 1e-9) << "23 degC, and the right sensor 0.25 K above";
}

/// The two sensors of the run lie 0.5 K apart.
TEST(BudgetInputs, AGradientThatExceedsTheTypedWidthIsSeen) {
    RunRecord run = stated_run();
    const auto width = [&] {
        return named(budget_inputs_of(certificate_of(run)),
                     "full width of the material's temperature");
    };
    EXPECT_NEAR(*width().seen, 0.5, 1e-9);
    EXPECT_FALSE(width().exceeded()) << "0.7 K are typed";
    run.uncertainty->temperature_width = kelvin(0.3);
    EXPECT_TRUE(width().exceeded());
    run.channels.pop_back();
    EXPECT_FALSE(width().seen) << "one sensor shows no gradient";
}

/// A cosine error of 2 um over 1 m is an angle of 2 mrad, 1.906 mm over the length of the targets.
TEST(BudgetInputs, TheAlignmentThatWasKeptIsHeldAgainstTheTypedOne) {
    Certificate certificate = certificate_of(stated_run());
    AlignmentRecord& alignment = certificate.attachments.alignment.emplace();
    alignment.reached = metre(1);
    alignment.far = FarRest{metre(1), um(9), um(7), um(0.25), 40, true};
    const BudgetInput beam =
        named(budget_inputs_of(certificate), "offset of the beam over the length");
    EXPECT_NEAR(*beam.seen, 953 * 2e-3, 1e-3);
    EXPECT_TRUE(beam.exceeded()) << "1 mm is typed";
}

/// The run grows by 0.2 um from pass to pass of 22 points: by 0.2 * 109 / 22 from its first to its
/// last.
TEST(BudgetInputs, ADriftOfTheRunItselfIsHeldAgainstEVE) {
    RunRecord run = stated_run();
    const auto eve = [&] { return named(budget_inputs_of(certificate_of(run)), "E_VE"); };
    EXPECT_NEAR(*eve().seen, 0.2 * 109 / 22, 1e-3);
    EXPECT_FALSE(eve().exceeded()) << "1.7 um are typed";
    run.uncertainty->eve = um(0.9);
    EXPECT_TRUE(eve().exceeded());
}

TEST(BudgetInputs, TheWeakestStrengthOfTheAlignmentIsNamed) {
    const std::string quantity = "least strength along the travel";
    Certificate certificate = certificate_of(stated_run());
    EXPECT_FALSE(named(budget_inputs_of(certificate), quantity).value) << "nothing was aligned";
    AlignmentRecord& alignment = certificate.attachments.alignment.emplace();
    alignment.places = {{mm(0), mm(500), 10, 71, 80, 80}, {mm(500), mm(1000), 10, 48, 60, 60}};
    const BudgetInput strength = named(budget_inputs_of(certificate), quantity);
    EXPECT_EQ(strength.value, 48);
    EXPECT_EQ(strength.unit, "%");
    EXPECT_EQ(strength.origin, InputOrigin::readings);
}

TEST(BudgetInputs, WhatIsNotStatedIsMissingAndADriftTestIsNamed) {
    RunRecord run = stated_run();
    run.uncertainty->misalignment.reset();
    Certificate certificate = certificate_of(std::move(run));
    certificate.attachments.eve_source = "20260101T000000Z-X-drift";
    const auto inputs = budget_inputs_of(certificate);
    const BudgetInput beam = named(inputs, "offset of the beam over the length");
    EXPECT_EQ(beam.origin, InputOrigin::missing);
    EXPECT_FALSE(beam.value);
    const BudgetInput eve = named(inputs, "E_VE");
    EXPECT_EQ(eve.origin, InputOrigin::drift_test);
    EXPECT_EQ(eve.where, "20260101T000000Z-X-drift");
}

TEST(BudgetInputs, AScaleBringsItsOwn) {
    RunRecord run = test::run_by_scale({});
    run.uncertainty = test::stated_uncertainty();
    const auto inputs = budget_inputs_of(certificate_of(std::move(run)));
    const BudgetInput offset = named(inputs, "largest distance of the scale from 20 degC");
    EXPECT_EQ(offset.origin, InputOrigin::readings);
    EXPECT_NEAR(*offset.value, 6.5, 1e-9) << "26.5 degC";
    EXPECT_NEAR(*named(inputs, "coefficient of the scale").value, 8.5, 1e-9);
}

} // namespace
} // namespace axiscal::budget_inputs_test

// Angles beside an indexing table and a polygon: closed forms, and a run made from a known truth.
#include "analysis/rotary/rotary_position.hpp"

#include "analysis/positioning/positioning_certificate.hpp"
#include "rotary_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace axiscal::rotary_position_test {
namespace {

using test::rad;
using test::table_of_5_degrees;
using test::truth_with_a_bad_table;
using test::TruthOfAngle;

RotarySetup polygon_of_8_faces() {
    RotarySetup setup;
    setup.method = AngleMethod::polygon;
    setup.step_deg = 45;
    setup.range_deg = 0.2;
    return setup;
}

DatumRecord datum_at(double coordinate_deg, Length reading = {}) {
    DatumRecord datum;
    datum.coordinate = mm(coordinate_deg);
    datum.reading = reading;
    return datum;
}

TEST(RotaryPosition, IsTableStepAndRest) {
    const RotarySetup setup = table_of_5_degrees();
    const DatumRecord datum = datum_at(-2, mm(7));
    // sin 1.25 deg on an arm of 32.61 mm, n - 1 = 2.7e-4: 0.711383... mm
    const Length reading = mm(7 + 32.61 * std::sin(1.25 * rad) * (1 + 2.7e-4));
    const auto found = rotary_position(setup, 1, datum, reading, 2.7e-4, 6);
    ASSERT_TRUE(found) << describe(found.error());
    EXPECT_NEAR(found->in(mm), -2 + 30 + 1.25, 1e-12);
    const auto mirrored = rotary_position(setup, -1, datum, reading, 2.7e-4, 6);
    EXPECT_NEAR(mirrored->in(mm), -2 + 30 - 1.25, 1e-12);
}

TEST(RotaryPosition, TakesOutTheCertifiedDeviationOfThePosition) {
    RotarySetup setup = table_of_5_degrees();
    setup.deviations_arcsec.assign(72, 0);
    setup.deviations_arcsec[0] = 0.4;
    setup.deviations_arcsec[71] = 3.6; // also position -1
    const double with_axis = rotary_position(setup, 1, datum_at(0), {}, 0, -1)->in(mm);
    EXPECT_NEAR(with_axis, -5 - (3.6 - 0.4) / 3600, 1e-12);
    setup.certificate_with_axis = false;
    const double against = rotary_position(setup, 1, datum_at(0), {}, 0, 71)->in(mm);
    EXPECT_NEAR(against, 355 + (3.6 - 0.4) / 3600, 1e-12);
}

TEST(RotaryPosition, OfAPolygonIsFaceAndReading) {
    RotarySetup setup = polygon_of_8_faces();
    setup.deviations_arcsec = {0, 1, -2, 0, 0, 0, 0, 0};
    const DatumRecord datum = datum_at(-5); // where the axis was armed does not matter
    EXPECT_EQ(artefact_index(setup, datum.coordinate, mm(90)), 2);
    const auto found = rotary_position(setup, 1, datum, mm(7.2 / 3600), 0.5, 2);
    EXPECT_NEAR(found->in(mm), 90 + (7.2 + 2) / 3600, 1e-12); // n does not count
}

TEST(RotaryPosition, TheTableStandsAtTheNearestWholeStepFromTheDatum) {
    const RotarySetup setup = table_of_5_degrees();
    EXPECT_EQ(artefact_index(setup, mm(-2), mm(-2)), 0);
    EXPECT_EQ(artefact_index(setup, mm(-2), mm(0.4)), 0);
    EXPECT_EQ(artefact_index(setup, mm(-2), mm(0.6)), 1);
    EXPECT_EQ(artefact_index(setup, mm(-2), mm(-9.6)), -2);
    EXPECT_EQ(positions_of_a_turn(setup), 72);
}

TEST(RotaryPosition, ARestBeyondTheRangeIsANamedFault) {
    RotarySetup setup = table_of_5_degrees();
    for (const double rest_deg : {10.1, -10.1, 80.0}) {
        const Length reading = mm(32.61 * std::sin(rest_deg * rad));
        const auto found = rotary_position(setup, 1, datum_at(0), reading, 0, 0);
        ASSERT_FALSE(found) << rest_deg;
        EXPECT_EQ(found.error().fault, Fault::outside_window);
        EXPECT_NE(found.error().detail.find("beyond its range of 10.0000 deg"), std::string::npos)
            << found.error().detail;
    }
    EXPECT_FALSE(rotary_position(setup, 1, datum_at(0), mm(33), 0, 0)); // no angle at all
    EXPECT_FALSE(rotary_position(setup, 1, datum_at(0), metre(std::nan("")), 0, 0));
    setup = polygon_of_8_faces();
    EXPECT_FALSE(rotary_position(setup, 1, datum_at(0), mm(0.21), 0, 0));
    EXPECT_TRUE(rotary_position(setup, 1, datum_at(0), mm(0.19), 0, 0));
}

TEST(RotaryPosition, AWayGivesAtLeastSoMuchReading) {
    const RotarySetup setup = table_of_5_degrees();
    const Length least = least_reading_of_way(setup, mm(1));
    for (int tenth = -25; tenth <= 25; ++tenth) {
        const double end_deg = 0.1 * tenth;
        const double from = std::sin((end_deg - 1) * rad), to = std::sin(end_deg * rad);
        EXPECT_LE(least.in(mm), 32.61 * (to - from) + 1e-12) << end_deg;
    }
    EXPECT_NEAR(least / (mm(1) * reading_per_coordinate(setup)), 1, 2e-3);
}

TEST(RotaryRun, TheAutocollimatorsChannelIsNoEnvironment) {
    RunRecord run = test::polygon_run();
    run.channels.push_back({9, "autocollimator", "collimator", "", ChannelKind::angle});
    const auto certificate = make_certificate(run, "hash");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    for (const EnvironmentSummary& summary : certificate->environment)
        EXPECT_NE(summary.channel, "autocollimator");
    EXPECT_EQ(certificate->environment.size(), 5U); // air and material of the simulated run
    EXPECT_EQ(certificate->traces.size(), 5U);
}

TEST(RotaryRun, FindsTheTruthBehindATableWithErrors) {
    const TruthOfAngle truth = truth_with_a_bad_table();
    const RunRecord run = truth.run();
    const auto found = compensate_to_20C(run);
    ASSERT_TRUE(found) << describe(found.error());
    EXPECT_EQ(found->deviations.unit(), "deg");
    // The air formulas differ by 4e-8 of a rest of 2.5 degrees: 0.0004 seconds of arc.
    constexpr double bound_deg = 5e-4 / 3600;
    for (const PlannedPoint& point : run.plan.points) {
        const auto i = static_cast<std::size_t>(point.target_index);
        const auto& rows = point.direction == Direction::positive ? found->deviations.forward()
                                                                  : found->deviations.backward();
        EXPECT_NEAR(rows[i][static_cast<std::size_t>(point.approach)],
                    TruthOfAngle::deviation_deg(point, run.plan.targets[i].in(mm)), bound_deg)
            << point.step;
    }
}

TEST(RotaryRun, ATableTakenAsExactLeavesItsErrorsInTheFigures) {
    const TruthOfAngle truth = truth_with_a_bad_table();
    RunRecord run = truth.run();
    const double E = *evaluate_positioning(compensate_to_20C(run)->deviations).parameters.E;
    run.rotary->deviations_arcsec.clear();
    const auto bare = compensate_to_20C(run);
    EXPECT_GT(*evaluate_positioning(bare->deviations).parameters.E, E + 1.0 / 3600);
    ASSERT_EQ(bare->summary.remarks.size(), 1U);
    EXPECT_NE(bare->summary.remarks[0].find("taken as 0"), std::string::npos);
}

TEST(RotaryRun, NeedsNoMaterialSensorAndIsNotBroughtTo20Degrees) {
    RunRecord run = truth_with_a_bad_table().run();
    std::erase_if(run.channels,
                  [](const ChannelRecord& channel) { return channel.medium == Medium::material; });
    std::erase_if(run.environment,
                  [](const EnvironmentReading& reading) { return reading.channel >= 4; });
    const auto found = compensate_to_20C(run);
    ASSERT_TRUE(found) << describe(found.error());
    EXPECT_EQ(found->deviations.provenance(), "none_needed: an angle does not expand");
    EXPECT_EQ(found->summary.largest_material_correction, 0);
    // n - 1 = 2.65e-4 of a rest of 2.4 degrees is 2.3 seconds of arc
    EXPECT_NEAR(found->summary.largest_air_correction * 3600, 2.3, 0.3);
}

TEST(RotaryRun, GetsACertificateWithTheBudgetOfAnnexB) {
    RunRecord run = truth_with_a_bad_table().run();
    auto preliminary = make_certificate(run, "hash");
    ASSERT_TRUE(preliminary) << describe(preliminary.error());
    ASSERT_EQ(preliminary->uncertainty.missing.size(), 2U);
    UncertaintySetup& stated = run.uncertainty.emplace();
    stated.device_width.fixed = mm(2.0 / 3600);
    stated.eve = mm(0.6 / 3600);
    const auto whole = make_certificate(run, "hash");
    ASSERT_TRUE(whole) << describe(whole.error());
    EXPECT_TRUE(whole->uncertainty.missing.empty());
    ASSERT_TRUE(whole->uncertainty.budget);
    const auto* device = whole->uncertainty.budget->find(UncertaintyTerm::device);
    ASSERT_NE(device, nullptr);
    EXPECT_NEAR(device->u, 2 / (2 * std::sqrt(3.0)), 1e-9); // seconds of arc, rectangular
}

TEST(RotaryRun, RefusesASetupThatCannotBe) {
    for (const auto& spoil : std::vector<std::function<void(RotarySetup&)>>{
             [](RotarySetup& setup) { setup.step_deg = 0; },
             [](RotarySetup& setup) { setup.arm = {}; },
             [](RotarySetup& setup) { setup.range_deg = -1; },
             [](RotarySetup& setup) { setup.deviations_arcsec[3] = std::nan(""); },
             [](RotarySetup& setup) { setup.range_deg = 0.5; }}) { // of a rest of 2.4 degrees
        RunRecord run = truth_with_a_bad_table().run();
        spoil(*run.rotary);
        const auto found = compensate_to_20C(run);
        ASSERT_FALSE(found);
        EXPECT_EQ(found.error().fault, Fault::bad_run_file);
    }
}

} // namespace
} // namespace axiscal::rotary_position_test

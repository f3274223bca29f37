// Expected bytes: the record of dls-controls/elcomat3000 (etc/simulations/elcomat3000.py), and what
// lnls-ima/ima-utils reads. The polygon's expectations are worked out by hand.
#include "wire/elcomat_line.hpp"

#include "scenario.hpp"
#include "simulated_machine.hpp"
#include "truth.hpp"

#include <gtest/gtest.h>

namespace axiscal::simulate::elcomat_line_test {
namespace {

TEST(ElcomatLine, AnswersEachRequestWithBothAxesAndTheState) {
    EXPECT_EQ(elcomat_record(4.5, 2.3), "4 003 4.50 2.30\r");
    EXPECT_EQ(elcomat_record(-12.345, 0), "4 003 -12.35 0.00\r");
    std::string typed = "a\r\na";
    EXPECT_EQ(elcomat_answer(typed, 1.0, 0), "4 003 1.00 0.00\r4 003 1.00 0.00\r");
    EXPECT_EQ(typed, "");
    typed = "\r\n";
    EXPECT_EQ(elcomat_answer(typed, 1.0, 0), "");
}

TEST(ElcomatLine, CallsNoAxisValidWithoutLight) {
    EXPECT_EQ(elcomat_record(std::nullopt, 2.3), "4 000 0.00 0.00\r");
}

TEST(Polygon, ShowsTheNearestFaceWithItsDeviationWithinTheRange) {
    PolygonScenario polygon;
    polygon.range_arcsec = 600;
    polygon.deviation_arcsec = {0, 1, -2, 0, 0, 0, 0, 0.5};
    EXPECT_NEAR(face_arcsec(polygon, 0).value(), 0, 1e-9);
    EXPECT_NEAR(face_arcsec(polygon, 45 + 3.0 / 3600).value(), 4, 1e-9);
    EXPECT_NEAR(face_arcsec(polygon, -45).value(), 0.5, 1e-9); // face 7
    EXPECT_NEAR(face_arcsec(polygon, 450).value(), -2, 1e-9);  // a turn and two faces
    EXPECT_TRUE(face_arcsec(polygon, 45 + 598.0 / 3600));
    EXPECT_FALSE(face_arcsec(polygon, 45 + 600.0 / 3600));
    EXPECT_FALSE(face_arcsec(polygon, 22));
}

TEST(Polygon, ItsTruthKnowsNeitherExpansionNorAir) {
    Scenario scenario;
    scenario.polygon.emplace().poll_s = 0.02;
    scenario.thermal.material.start = 35;
    scenario.errors.noise_um = 0.1;
    scenario.truth.window_s = 0.5;
    const auto truth = truth_of(scenario, {{0, 45, 90}, 2, true});
    const auto& terms = truth.at("terms_um");
    for (const char* name : {"material_scale", "first_order", "air", "formula"})
        EXPECT_EQ(terms.at(name), 0) << name;
    EXPECT_NEAR(terms.at("counting").get<double>(), 0.01 / 3.6, 1e-12);
    EXPECT_NEAR(terms.at("sigma").get<double>(), 0.1 / 5, 1e-12); // of 25 answers
}

TEST(Polygon, WithoutOneAnAutocollimatorIsRefused) {
    const std::string laser = "[laser]\nkind = \"umd2-homodyne\"\npath = \"laser.tty\"\n";
    const std::string sensor = "[[sensor]]\nname = \"c\"\nkind = \"elcomat\"\npath = \"c.tty\"\n";
    EXPECT_TRUE(parse_scenario(laser + sensor + "[polygon]\nfaces = 12\n", true));
    EXPECT_FALSE(parse_scenario(laser + sensor, true));
    EXPECT_FALSE(parse_scenario(sensor + "[polygon]\nfaces = 12\n", true));
    EXPECT_FALSE(parse_scenario("[polygon]\nfaces = 2\n", true));
}

} // namespace
} // namespace axiscal::simulate::elcomat_line_test

// G, G(b), F and D against the reference and closed forms.

#include "analysis/circular/circular_parameters.hpp"
#include "synthetic_circle.hpp"

#include <gtest/gtest.h>

namespace axiscal::circular_parameters_test {
namespace {

using namespace test;

CircularParameters evaluate(const CircularTest& test,
                            RadialCentre centre = RadialCentre::automatic,
                            const std::optional<BarExpansion>& bar = {}) {
    return evaluate_circular(test, centre, bar).value();
}

std::string refused_field(const CircularTest& test,
                          RadialCentre centre = RadialCentre::automatic,
                          const std::optional<BarExpansion>& bar = {}) {
    const auto result = evaluate_circular(test, centre, bar);
    return result ? "" : result.error().field;
}

/// k lobes of amplitude a in both senses.
CircularTest lobed(int k, double a, const std::vector<double>& angles, double R = 150) {
    CircularTest test = made_test({}, angles, R);
    for (auto& trace : test.traces)
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
            trace.radial_deviation_mm[i] = a * std::cos(k * trace.angle_rad[i]);
    return test;
}

TEST(CircularParameters, AgreeWithEveryReferenceCase) {
    constexpr double agreement = 1e-9; // mm; the reference's own
    const auto sets = reference_json("ballbar_synthetic.json").at("cases");
    for (const auto& set : sets) {
        SCOPED_TRACE(set.at("id"));
        const CircularParameters found = evaluate(reference_test(set));
        const auto& expected = set.at("recomputed_iso230_4");
        const bool full = set.at("request").is_null();
        for (const Sense sense : {Sense::ccw, Sense::cw}) {
            const auto& of = expected.at(std::string{name_of(sense)});
            const SenseFigures& figures = *found.of(sense);
            EXPECT_EQ(figures.cover.full_circle, full);
            EXPECT_NEAR(figures.G.minimum_zone_mm, of.at("G_mzc").get<double>(), agreement);
            EXPECT_NEAR(figures.G.least_squares_mm, of.at("G_lsc").get<double>(), agreement);
            EXPECT_LE(figures.G.gap_mm, 1e-12 * 151);
            EXPECT_EQ(figures.F.centre, full ? RadialCentre::least_squares : RadialCentre::set_up);
            EXPECT_NEAR(figures.F.max_mm, of.at("F_max").get<double>(), agreement);
            EXPECT_NEAR(figures.F.min_mm, of.at("F_min").get<double>(), agreement);
        }
        const auto& both = expected.at("bi");
        EXPECT_NEAR(found.G_b->minimum_zone_mm, both.at("Gb_mzc").get<double>(), agreement);
        EXPECT_NEAR(found.G_b->least_squares_mm, both.at("Gb_lsc").get<double>(), agreement);
        EXPECT_NEAR(*found.D_mm, both.at("D").get<double>(), agreement);
        EXPECT_TRUE(found.not_evaluated.empty());
    }
}

TEST(CircularParameters, LobesGiveClosedForms) {
    for (const int k : {2, 3, 4, 5, 8}) {
        const double a = 0.004;
        // readings at every crest and trough of every k
        const CircularParameters found = evaluate(lobed(k, a, even_angles(0, 359.9, 0.5)));
        const double reached = k == 8 ? a : a; // 0.5 deg meets them all
        EXPECT_NEAR(found.ccw->G.minimum_zone_mm, 2 * reached, 1e-12) << k;
        EXPECT_NEAR(found.G_b->minimum_zone_mm, 2 * reached, 1e-12);
        EXPECT_NEAR(found.cw->F.max_mm, reached, 1e-12);
        EXPECT_NEAR(found.cw->F.min_mm, -reached, 1e-12);
        EXPECT_NEAR(*found.D_mm, 0, 1e-12);
    }
}

TEST(CircularParameters, ANanometreAtHalfAMetreKeepsItsDigits) {
    const CircularParameters found = evaluate(lobed(3, 1e-6, even_angles(0, 359.9, 1), 500));
    EXPECT_NEAR(found.ccw->G.minimum_zone_mm, 2e-6, 1e-13);
    EXPECT_NEAR(found.ccw->F.max_mm, 1e-6, 1e-13);
    CircularTest larger = made_test({}, even_angles(0, 359, 1), 500);
    for (auto& trace : larger.traces)
        for (double& dr : trace.radial_deviation_mm)
            dr = 1e-6;
    const CircularParameters even = evaluate(larger);
    EXPECT_NEAR(*even.D_mm, 1e-6, 1e-13);
    EXPECT_NEAR(even.G_b->minimum_zone_mm, 0, 1e-12);
}

TEST(CircularParameters, FIsCountedFromTheCentreThatIsAskedFor) {
    const CircularTest test =
        made_test(CircleTruth{{"off_x_ccw", 0.02}, {"off_x_cw", 0.02}}, even_angles(0, 359, 1));
    const auto set_up = evaluate(test, RadialCentre::set_up);
    EXPECT_NEAR(set_up.ccw->F.max_mm, 0.02, 1e-15);
    EXPECT_NEAR(set_up.ccw->F.min_mm, -0.02, 1e-15);
    EXPECT_EQ(set_up.ccw->F.centre, RadialCentre::set_up);
    const auto fitted = evaluate(test);
    EXPECT_NEAR(fitted.ccw->F.max_mm, 0, 3e-6) << "second order of the offset";
    const auto arc = made_test(CircleTruth{{"off_x_ccw", 0.02}}, even_angles(0, 100, 1));
    EXPECT_EQ(evaluate(arc).ccw->F.centre, RadialCentre::set_up);
    EXPECT_NEAR(evaluate(arc, RadialCentre::least_squares).ccw->F.max_mm, 0, 1e-4);
}

TEST(CircularParameters, LeastSquaresIsRefusedBelow90DegAndSetUpIsNot) {
    const auto shorter = made_test(CircleTruth{{"square", 1e-5}}, even_angles(0, 89, 1));
    EXPECT_EQ(refused_field(shorter, RadialCentre::least_squares), "f_centre");
    const auto found = evaluate(shorter);
    EXPECT_FALSE(found.D_mm);
    EXPECT_TRUE(found.not_evaluated.contains("D"));
    EXPECT_TRUE(found.G_b);
    EXPECT_EQ(refused_field(made_test({}, even_angles(0, 91, 1)), RadialCentre::least_squares), "");
}

TEST(CircularParameters, ReachesTwentyDegreesByBarAndMachine) {
    const CircularTest test = made_test(CircleTruth{{"square", 3e-5}}, even_angles(0.5, 359.5, 1));
    const CircularParameters read = evaluate(test);
    // a steel machine at 23, a bar of 150.01 mm with 1.2e-6 at 25 degC
    const BarExpansion bar{25, 23, 1.2e-6, 11.5e-6, 150.01};
    const double shift = 150.01 * 1.2e-6 * 5 - 150 * 11.5e-6 * 3;
    const CircularParameters at_20 = evaluate(test, RadialCentre::automatic, bar);
    EXPECT_NEAR(*at_20.correction_mm, shift, 1e-15);
    EXPECT_NEAR(*at_20.D_mm - *read.D_mm, shift, 1e-14);
    EXPECT_NEAR(at_20.ccw->F.max_mm - read.ccw->F.max_mm, shift, 1e-14);
    EXPECT_NEAR(at_20.cw->F.min_mm - read.cw->F.min_mm, shift, 1e-14);
    EXPECT_EQ(at_20.ccw->G.minimum_zone_mm, read.ccw->G.minimum_zone_mm);
    EXPECT_EQ(at_20.G_b->minimum_zone_mm, read.G_b->minimum_zone_mm);
    // a machine and a bar of one material at one temperature stay as they are
    EXPECT_NEAR(correction_to_20C_mm({31, 31, 11.5e-6, 11.5e-6, 150}, 150).value(), 0, 1e-18);
}

TEST(CircularParameters, RefuseAnExpansionInMicrometresPerMetre) {
    const CircularTest test = made_test({}, even_angles(0, 359, 1));
    const auto field = [&](const BarExpansion& bar) {
        return refused_field(test, RadialCentre::automatic, bar);
    };
    EXPECT_EQ(field({25, 23, 1.2e-6, 11.5, 150}), "temperature.machine_expansion_per_K");
    EXPECT_EQ(field({25, 23, 1.2, 11.5e-6, 150}), "temperature.bar_expansion_per_K");
    EXPECT_EQ(field({295, 23, 1e-6, 1e-5, 150}), "temperature.bar_degC");
    EXPECT_EQ(field({25, std::nan(""), 1e-6, 1e-5, 150}), "temperature.machine_degC");
    EXPECT_EQ(field({25, 23, 1e-6, 1e-5, 0}), "temperature.bar_length_mm");
}

TEST(CircularParameters, OneSenseGivesItsOwnFiguresWithReasonsForTheRest) {
    CircularTest test = made_test(CircleTruth{{"square", 3e-5}}, even_angles(0.5, 359.5, 1));
    test.traces.erase(test.traces.begin());
    const CircularParameters found = evaluate(test);
    EXPECT_FALSE(found.ccw);
    EXPECT_TRUE(found.cw);
    EXPECT_FALSE(found.G_b);
    EXPECT_FALSE(found.D_mm);
    for (const char* key : {"G_ccw", "G_b", "F_max_ccw", "F_min_ccw", "D"})
        EXPECT_TRUE(found.not_evaluated.contains(key)) << key;
    EXPECT_EQ(found.not_evaluated.size(), 5);
}

TEST(CircularParameters, FeedbackSignalsGiveFormAlone) {
    CircularTest test = made_test(CircleTruth{{"square", 3e-5}}, even_angles(0.5, 359.5, 1));
    test.source = SignalSource::feedback;
    const CircularParameters found = evaluate(test);
    EXPECT_TRUE(found.G_b);
    EXPECT_FALSE(found.D_mm);
    EXPECT_TRUE(found.not_evaluated.contains("F_max_cw"));
}

TEST(CircularParameters, CoverTellsCirclesFromArcs) {
    const auto full = [](const std::vector<double>& angles) {
        return cover_of(angles).full_circle;
    };
    EXPECT_TRUE(full(even_angles(0, 359, 1)));
    EXPECT_TRUE(full(even_angles(-45, 405, 0.5))) << "with overlap";
    EXPECT_TRUE(full(even_angles(0, 315, 45))) << "eight readings";
    EXPECT_TRUE(full(even_angles(0, 360, 0.1)));
    EXPECT_FALSE(full(even_angles(-20, 200, 0.5)));
    EXPECT_FALSE(full(even_angles(0, 350, 1)));
    EXPECT_NEAR(cover_of(even_angles(-20, 200, 0.5)).arc_deg, 220, 1e-9);
    EXPECT_NEAR(cover_of(even_angles(300, 420, 1)).arc_deg, 120, 1e-9);
}

TEST(CircularParameters, RefuseByField) {
    const CircularTest good = made_test({}, even_angles(0, 359, 1));
    const auto field = [&](auto change) {
        CircularTest test = good;
        change(test);
        return refused_field(test);
    };
    EXPECT_EQ(field([](auto& t) { t.nominal_radius_mm = 0; }), "nominal_radius_mm");
    EXPECT_EQ(field([](auto& t) { t.nominal_radius_mm = std::nan(""); }), "nominal_radius_mm");
    EXPECT_EQ(field([](auto& t) { t.feed_mm_per_s = -1; }), "feed_mm_per_min");
    EXPECT_EQ(field([](auto& t) { t.traces.clear(); }), "traces");
    EXPECT_EQ(field([](auto& t) { t.traces[1].sense = Sense::ccw; }), "traces[1].sense");
    EXPECT_EQ(field([](auto& t) { t.traces[1].angle_rad.pop_back(); }),
              "traces[1].radial_deviation_mm");
    EXPECT_EQ(field([](auto& t) { t.traces[0].angle_rad[3] = 1e300; }), "traces[0].angle_rad[3]");
    EXPECT_EQ(field([](auto& t) { t.traces[0].radial_deviation_mm[5] = std::nan(""); }),
              "traces[0].radial_deviation_mm[5]");
    EXPECT_EQ(field([](auto& t) { t.traces[0].radial_deviation_mm[5] = -150; }),
              "traces[0].radial_deviation_mm[5]");
    EXPECT_EQ(field([](auto& t) {
                  for (double& angle : t.traces[0].angle_rad)
                      angle = 1;
              }),
              "traces[0]")
        << "one point has no circle";
}

} // namespace
} // namespace axiscal::circular_parameters_test

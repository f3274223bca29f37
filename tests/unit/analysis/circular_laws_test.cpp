// Laws of the circular figures and of their causes, over seeded random traces.

#include "analysis/circular/circle_diagnosis.hpp"
#include "analysis/circular/circular_parameters.hpp"
#include "synthetic_circle.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::circular_laws_test {
namespace {

using circular::Cause;
using namespace test;

/// Figures in the order G_ccw, G_cw, G_b, F_max_ccw, F_min_ccw, F_max_cw, F_min_cw, D.
std::vector<double> figures_of(const CircularTest& test, RadialCentre centre) {
    const CircularParameters p = evaluate_circular(test, centre).value();
    return {
        p.ccw->G.minimum_zone_mm, p.cw->G.minimum_zone_mm, p.G_b->minimum_zone_mm, p.ccw->F.max_mm,
        p.ccw->F.min_mm,          p.cw->F.max_mm,          p.cw->F.min_mm,         *p.D_mm};
}

template <class Change> CircularTest changed(CircularTest test, Change change) {
    for (CircularTrace& trace : test.traces)
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
            change(trace, i);
    return test;
}

/// The points moved by (x, y) and seen again from the nominal centre: no approximation.
CircularTest moved(const CircularTest& test, double x, double y) {
    const double R = test.nominal_radius_mm;
    return changed(test, [&](CircularTrace& trace, std::size_t i) {
        double &angle = trace.angle_rad[i], &dr = trace.radial_deviation_mm[i];
        const double px = (R + dr) * std::cos(angle) + x, py = (R + dr) * std::sin(angle) + y;
        angle = std::atan2(py, px);
        dr = std::hypot(px, py) - R;
    });
}

class CircularLaws : public testing::Test {
protected:
    static constexpr int trials = 40;
    static constexpr double R = 150, F = 1000.0 / 60;
    std::mt19937_64 random{20260102};

    CircleTruth truth() {
        std::uniform_real_distribution<double> um{-0.01, 0.01};
        CircleTruth made;
        for (std::size_t i = 0; i < circular::cause_count; ++i) {
            const auto cause = static_cast<Cause>(i);
            made[reference_name(cause)] = um(random) / leverage_of(cause, R, F);
        }
        return made;
    }
    CircularTest full() { return noisy(made_test(truth(), even_angles(0.5, 359.5, 1), R, F)); }
    CircularTest arc() { return noisy(made_test(truth(), even_angles(-20, 200, 1), R, F)); }
    CircularTest noisy(CircularTest test) {
        std::normal_distribution<double> noise{0, 1e-3};
        return changed(std::move(test), [&](CircularTrace& trace, std::size_t i) {
            trace.radial_deviation_mm[i] += noise(random);
        });
    }
    static void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
        for (std::size_t i = 0; i < a.size(); ++i)
            EXPECT_NEAR(a[i], b[i], 1e-11) << i;
    }
};

// The source's table 3, row by row.

TEST_F(CircularLaws, TheDiameterActsOnFAndDAlone) {
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = i % 2 ? full() : arc();
        const auto centre = i % 4 < 2 ? RadialCentre::set_up : RadialCentre::least_squares;
        const double k = 1 + 1e-4 * (i - 20); // every circle grows about the nominal centre
        const auto larger = changed(test, [&](CircularTrace& trace, std::size_t j) {
            double& dr = trace.radial_deviation_mm[j];
            dr = k * (R + dr) - R;
        });
        const auto before = figures_of(test, centre), after = figures_of(larger, centre);
        for (std::size_t g = 0; g < 3; ++g)
            EXPECT_NEAR(after[g], k * before[g], 1e-11) << "nothing but the scale itself";
        for (std::size_t f = 3; f < 8; ++f)
            EXPECT_NEAR(after[f], k * (R + before[f]) - R, 1e-11);
    }
}

TEST_F(CircularLaws, TheCentreActsOnFOfAnArcAlone) {
    std::uniform_real_distribution<double> shift{-0.05, 0.05};
    for (int i = 0; i < trials; ++i) {
        const double x = shift(random), y = shift(random);
        const CircularTest circle = full(), part = arc();
        const auto least = RadialCentre::least_squares;
        expect_same(figures_of(moved(circle, x, y), least), figures_of(circle, least));
        const auto before = figures_of(part, RadialCentre::set_up);
        const auto after = figures_of(moved(part, x, y), RadialCentre::set_up);
        for (const std::size_t g : {0u, 1u, 2u, 7u})
            EXPECT_NEAR(after[g], before[g], 1e-11);
        double change = 0;
        for (std::size_t f = 3; f < 7; ++f)
            change = std::max(change, std::fabs(after[f] - before[f]));
        EXPECT_GT(change, 0.05 * std::hypot(x, y));
    }
}

TEST_F(CircularLaws, TheFormActsOnEveryFigure) {
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = full();
        const auto ragged = changed(test, [](CircularTrace& trace, std::size_t j) {
            if (trace.angle_rad[j] < 1 || trace.angle_rad[j] > 5) return;
            trace.radial_deviation_mm[j] += 0.1 * (std::sin(3 * trace.angle_rad[j]) + 0.2);
        });
        const auto before = figures_of(test, RadialCentre::automatic);
        const auto after = figures_of(ragged, RadialCentre::automatic);
        for (std::size_t f = 0; f < before.size(); ++f)
            EXPECT_GT(std::fabs(after[f] - before[f]), 1e-4) << f;
    }
}

// Figures.

TEST_F(CircularLaws, GOfBothIsNeverBelowGOfOneAndLeastSquaresNeverBelowTheMinimumZone) {
    for (int i = 0; i < trials; ++i) {
        const auto p = evaluate_circular(i % 2 ? full() : arc()).value();
        EXPECT_GE(p.G_b->minimum_zone_mm + 1e-12,
                  std::max(p.ccw->G.minimum_zone_mm, p.cw->G.minimum_zone_mm));
        for (const CircularDeviation& G : {p.ccw->G, p.cw->G, *p.G_b})
            EXPECT_GE(G.least_squares_mm + 1e-12, G.minimum_zone_mm);
        EXPECT_GE(p.ccw->F.max_mm, p.ccw->F.min_mm);
    }
}

TEST_F(CircularLaws, TheOrderOfTheReadingsIsOfNoMatter) {
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = full();
        CircularTest shuffled = test;
        for (CircularTrace& trace : shuffled.traces) {
            const auto turn = static_cast<std::ptrdiff_t>(random() % trace.angle_rad.size());
            for (std::vector<double>* column : {&trace.angle_rad, &trace.radial_deviation_mm})
                std::rotate(column->begin(), column->begin() + turn, column->end());
        }
        std::swap(shuffled.traces[0], shuffled.traces[1]);
        expect_same(figures_of(shuffled, RadialCentre::automatic),
                    figures_of(test, RadialCentre::automatic));
    }
}

TEST_F(CircularLaws, WholeTurnsMoreAreTheSameAngle) {
    const CircularTest test = arc();
    const auto turned = changed(test, [](CircularTrace& trace, std::size_t i) {
        trace.angle_rad[i] += 4 * std::numbers::pi * (i % 2 ? 1 : -1);
    });
    expect_same(figures_of(turned, RadialCentre::least_squares),
                figures_of(test, RadialCentre::least_squares));
}

// What becomes of figures and causes when the circle is seen another way. The images of the causes
// follow from the table of effects by substitution.

struct Image {
    Cause from, to;
    double factor;
};

void expect_images(const CircularTest& before,
                   const CircularTest& after,
                   const std::vector<Image>& images) {
    const auto a = diagnose_circle(before, {"X", "Y"}).value();
    const auto b = diagnose_circle(after, {"X", "Y"}).value();
    const double R = before.nominal_radius_mm, F = before.feed_mm_per_s;
    ASSERT_EQ(images.size(), circular::cause_count);
    for (const Image& image : images) {
        EXPECT_NEAR(*b.of(image.to).value * leverage_of(image.to, R, F),
                    image.factor * *a.of(image.from).value * leverage_of(image.from, R, F), 1e-12)
            << reference_name(image.from);
        EXPECT_NEAR(b.of(image.to).standard_uncertainty * leverage_of(image.to, R, F),
                    a.of(image.from).standard_uncertainty * leverage_of(image.from, R, F), 1e-12);
    }
}

TEST_F(CircularLaws, AQuarterTurnExchangesTheAxes) {
    using enum Cause;
    const std::vector<Image> images{{center_ccw_x, center_ccw_y, 1},
                                    {center_ccw_y, center_ccw_x, -1},
                                    {center_cw_x, center_cw_y, 1},
                                    {center_cw_y, center_cw_x, -1},
                                    {scale_x, scale_y, 1},
                                    {scale_y, scale_x, 1},
                                    {squareness, squareness, -1},
                                    {servo_lag_difference, servo_lag_difference, -1},
                                    {backlash_x, backlash_y, 1},
                                    {backlash_y, backlash_x, 1},
                                    {lateral_play_x, lateral_play_y, -1},
                                    {lateral_play_y, lateral_play_x, -1},
                                    {straightness_x, straightness_y, -1},
                                    {straightness_y, straightness_x, 1}};
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = full();
        const auto turned = changed(test, [](CircularTrace& trace, std::size_t j) {
            trace.angle_rad[j] += std::numbers::pi / 2;
        });
        expect_same(figures_of(turned, RadialCentre::automatic),
                    figures_of(test, RadialCentre::automatic));
        expect_images(test, turned, images);
    }
}

TEST_F(CircularLaws, AMirrorExchangesTheSenses) {
    using enum Cause;
    const std::vector<Image> images{{center_ccw_x, center_cw_x, 1},
                                    {center_ccw_y, center_cw_y, -1},
                                    {center_cw_x, center_ccw_x, 1},
                                    {center_cw_y, center_ccw_y, -1},
                                    {scale_x, scale_x, 1},
                                    {scale_y, scale_y, 1},
                                    {squareness, squareness, -1},
                                    {servo_lag_difference, servo_lag_difference, 1},
                                    {backlash_x, backlash_x, 1},
                                    {backlash_y, backlash_y, 1},
                                    {lateral_play_x, lateral_play_x, -1},
                                    {lateral_play_y, lateral_play_y, -1},
                                    {straightness_x, straightness_x, -1},
                                    {straightness_y, straightness_y, 1}};
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = full();
        CircularTest mirrored = changed(test, [](CircularTrace& trace, std::size_t j) {
            trace.angle_rad[j] = -trace.angle_rad[j];
        });
        for (CircularTrace& trace : mirrored.traces)
            trace.sense = trace.sense == Sense::ccw ? Sense::cw : Sense::ccw;
        const auto a = figures_of(test, RadialCentre::automatic);
        expect_same(figures_of(mirrored, RadialCentre::automatic),
                    {a[1], a[0], a[2], a[5], a[6], a[3], a[4], a[7]});
        expect_images(test, mirrored, images);
    }
}

TEST_F(CircularLaws, ExchangedSensesExchangeWhatTheSenseCarriesAlone) {
    using enum Cause;
    std::vector<Image> images{{center_ccw_x, center_cw_x, 1},
                              {center_ccw_y, center_cw_y, 1},
                              {center_cw_x, center_ccw_x, 1},
                              {center_cw_y, center_ccw_y, 1}};
    for (const Cause same : {scale_x, scale_y, squareness, straightness_x, straightness_y})
        images.push_back({same, same, 1});
    for (const Cause turned :
         {servo_lag_difference, backlash_x, backlash_y, lateral_play_x, lateral_play_y})
        images.push_back({turned, turned, -1});
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = full();
        CircularTest exchanged = test;
        std::swap(exchanged.traces[0].sense, exchanged.traces[1].sense);
        const auto a = figures_of(test, RadialCentre::automatic);
        expect_same(figures_of(exchanged, RadialCentre::automatic),
                    {a[1], a[0], a[2], a[5], a[6], a[3], a[4], a[7]});
        expect_images(test, exchanged, images);
    }
}

TEST_F(CircularLaws, LengthsScaleWithTheCircleAndAnglesDoNot) {
    for (int i = 0; i < trials; ++i) {
        const double k = 0.1 + 0.3 * i;
        const CircularTest test = full();
        CircularTest scaled = changed(
            test, [&](CircularTrace& trace, std::size_t j) { trace.radial_deviation_mm[j] *= k; });
        scaled.nominal_radius_mm *= k;
        scaled.feed_mm_per_s *= k;
        const auto a = figures_of(test, RadialCentre::automatic);
        const auto b = figures_of(scaled, RadialCentre::automatic);
        for (std::size_t f = 0; f < a.size(); ++f)
            EXPECT_NEAR(b[f], k * a[f], 1e-11 * std::max(1.0, k));
        const auto da = diagnose_circle(test, {"X", "Y"}).value();
        const auto db = diagnose_circle(scaled, {"X", "Y"}).value();
        for (std::size_t c = 0; c < circular::cause_count; ++c) {
            const auto cause = static_cast<Cause>(c);
            const bool length = leverage_of(cause, 2, 3) == 1;
            EXPECT_NEAR(*db.of(cause).value, (length ? k : 1) * *da.of(cause).value, 1e-12);
        }
        EXPECT_NEAR(da.condition, db.condition, 1e-9 * da.condition);
    }
}

TEST_F(CircularLaws, ACauseAddsToItselfAlone) {
    for (int i = 0; i < trials; ++i) {
        const CircularTest test = i % 2 ? full() : arc();
        const auto before = diagnose_circle(test, {"X", "Y"}).value();
        const auto cause = static_cast<Cause>(static_cast<std::size_t>(i) % circular::cause_count);
        const double more = 0.003 / leverage_of(cause, R, F);
        const auto after =
            diagnose_circle(changed(test,
                                    [&](CircularTrace& trace, std::size_t j) {
                                        trace.radial_deviation_mm[j] +=
                                            true_deviation({{reference_name(cause), more}},
                                                           trace.angle_rad[j], trace.sense, R, F);
                                    }),
                            {"X", "Y"})
                .value();
        for (std::size_t c = 0; c < circular::cause_count; ++c) {
            const auto other = static_cast<Cause>(c);
            EXPECT_NEAR(*after.of(other).value,
                        *before.of(other).value + (other == cause ? more : 0),
                        1e-13 / leverage_of(other, 1, 1) + 1e-12);
        }
    }
}

} // namespace
} // namespace axiscal::circular_laws_test

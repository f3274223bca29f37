// What a polar plot shows, and that the page shows it there.

#include "acquisition/documents/circular/polar_plot.hpp"
#include "pdf_tools.hpp"
#include "synthetic_circular.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace axiscal::polar_plot_test {
namespace {

using test::bare_measurement;
using test::certificate_of;
using test::circular_test;
using test::circular_truth;
using testing::ScratchFolder;

constexpr PageBox plot_box{60, 80, 320, 300};

bool is_round_step(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value * (1 + 1e-9))));
    for (const double step : {1.0, 2.0, 5.0})
        if (std::fabs(value / decade - step) < 1e-6) return true;
    return false;
}

double uniform(std::mt19937& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

/// Causes between a tenth of a micrometre and a tenth of a millimetre on an arc from 120 deg.
CircularCertificate random_certificate(std::mt19937& random) {
    const double size = std::pow(10.0, uniform(random, -4, -1));
    test::CircleTruth truth;
    for (const char* cause : {"off_x_ccw", "off_y_ccw", "off_x_cw", "off_y_cw", "backlash_x",
                              "backlash_y", "straight_x", "lateral_y"})
        truth[cause] = uniform(random, -size, size);
    for (const char* cause : {"scale_x", "scale_y", "square"})
        truth[cause] = uniform(random, -size, size) / 150;
    const double arc = random() % 2 == 0 ? 360 : uniform(random, 120, 350);
    const double start = std::floor(uniform(random, -180, 180));
    return certificate_of(bare_measurement(
        circular_test(truth, static_cast<unsigned>(random()), start, arc, size / 20)));
}

class PolarPlot : public ::testing::Test {
protected:
    /// The plot alone on a page, 1 pixel a point.
    test::PageImage draw(const PolarView& view) {
        PdfDocument document{"plot", "plot", "2026-01-01T00:00:00Z"};
        draw_polar_plot(document.canvas(), plot_box, view);
        place_ = polar_place(document.canvas(), plot_box, view);
        document.end_page();
        const auto bytes = document.finish();
        EXPECT_TRUE(bytes.has_value());
        pdf_ = test::write_pdf(folder_, bytes.value_or(""));
        return test::image_of(pdf_, 1);
    }
    ScratchFolder folder_;
    std::string pdf_;
    PolarPlace place_;
};

/// The darkest of the nine pixels around a point.
int darkest_at(const test::PageImage& image, PagePoint at) {
    int darkest = 255;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const auto x = static_cast<std::size_t>(std::lround(at.x - 0.5) + dx);
            const auto y = static_cast<std::size_t>(std::lround(at.y - 0.5) + dy);
            darkest = std::min(
                darkest,
                static_cast<int>(image.grey[y * static_cast<std::size_t>(image.width) + x]));
        }
    return darkest;
}

TEST(PolarScale, TakesTheLargestRoundMagnificationThatFits) {
    // 100 pt: 45 pt less a rim of 3 pt outward of the base, 46.75 pt inward; 1 mm is 2.8346 pt.
    // 5 um outward: 42 / 0.005 / 2.8346 = 2963
    EXPECT_DOUBLE_EQ(polar_scale(100, -0.001, 0.005).magnification, 2000);
    EXPECT_DOUBLE_EQ(polar_scale(100, -0.001, 0.002).magnification, 5000);
    // 20 um inward: 46.75 / 0.020 / 2.8346 = 824.6
    EXPECT_DOUBLE_EQ(polar_scale(100, -0.020, 0.001).magnification, 500);
    EXPECT_DOUBLE_EQ(polar_scale(100, -0.020, 0.001).division_mm(), 0.020);
    EXPECT_DOUBLE_EQ(polar_scale(100, 0, 0).magnification, 1e5) << "a perfect circle";
    EXPECT_DOUBLE_EQ(polar_scale(100, -30, 30).magnification, 0.2) << "smaller than life";
}

TEST(PolarScale, SaysItsMagnificationAndDivision) {
    EXPECT_EQ(magnification_text(5000), "5000:1");
    EXPECT_EQ(magnification_text(0.2), "1:5");
    EXPECT_EQ(division_text(0.002), "2 µm");
    EXPECT_EQ(division_text(0.0005), "0.5 µm");
    EXPECT_EQ(division_text(50), "50 mm");
}

TEST(PolarScale, RoundStepsGoDownAndKeepRoundNumbers) {
    EXPECT_DOUBLE_EQ(round_down_125(4999), 2000);
    EXPECT_DOUBLE_EQ(round_down_125(5000), 5000);
    EXPECT_DOUBLE_EQ(round_down_125(1000), 1000);
    EXPECT_DOUBLE_EQ(round_down_125(0.03), 0.02);
}

TEST(PolarView, OfRandomTracesStaysInsideThePlotAtARoundMagnification) {
    std::mt19937 random{20260101};
    for (int trial = 0; trial < 40; ++trial) {
        const CircularCertificate certificate = random_certificate(random);
        for (const PolarView& view :
             {polar_view_of(certificate, Sense::ccw), polar_view_of(certificate, Sense::cw),
              polar_view_of_both(certificate)}) {
            const double radius = uniform(random, 60, 200);
            const PolarScale scale =
                polar_scale(radius, view.low_mm - view.base_mm, view.high_mm - view.base_mm);
            EXPECT_TRUE(is_round_step(scale.magnification)) << scale.magnification;
            for (const PolarTrace& trace : view.traces)
                for (const auto& piece : trace.pieces)
                    for (const PolarPoint& point : piece) {
                        const double at = scale.radius_pt(point.deviation_mm - view.base_mm);
                        ASSERT_GT(at, 0) << trial;
                        ASSERT_LT(at, radius) << trial;
                    }
        }
    }
}

TEST(PolarView, TheRingHoldsEveryReadingAndItsControlPointsTouchIt) {
    std::mt19937 random{7};
    for (int trial = 0; trial < 25; ++trial) {
        const CircularCertificate certificate = random_certificate(random);
        for (const PolarView& view :
             {polar_view_of(certificate, Sense::ccw), polar_view_of_both(certificate)}) {
            ASSERT_TRUE(view.zone.has_value());
            constexpr double nanometre = 1e-6;
            EXPECT_GE(view.low_mm, view.zone->inner_mm - nanometre);
            EXPECT_LE(view.high_mm, view.zone->outer_mm + nanometre);
            int outer = 0, inner = 0;
            for (const PolarMark& mark : view.marks) {
                const bool is_outer = mark.side == ZoneSide::outer;
                ++(is_outer ? outer : inner);
                EXPECT_NEAR(mark.at.deviation_mm,
                            is_outer ? view.zone->outer_mm : view.zone->inner_mm, nanometre);
            }
            // one of each in one direction are enough: a reading of either sense at one angle
            EXPECT_EQ(outer, inner);
            EXPECT_TRUE(outer == 1 || outer == 2) << outer;
        }
    }
}

TEST(PolarView, ThinningKeepsWhatStandsOut) {
    CircularTest dense = test::made_test(circular_truth(), test::even_angles(0, 359.99, 0.01));
    dense.traces[0].radial_deviation_mm[12345] += 0.030; // one reading of 36 000
    const CircularCertificate certificate = certificate_of(bare_measurement(dense));
    const PolarView view = polar_view_of(certificate, Sense::ccw);
    ASSERT_EQ(view.traces.front().pieces.size(), 1u);
    EXPECT_LT(view.traces.front().pieces.front().size(), 4u * 3601);
    EXPECT_NEAR(view.high_mm - view.low_mm, certificate.parameters.ccw->G.minimum_zone_mm, 1e-9);
}

TEST(PolarView, AGapIsNotBridged) {
    CircularTest broken = circular_test(circular_truth(), 3);
    CircularTrace& trace = broken.traces[0];
    const auto erase = [](std::vector<double>& list) {
        list.erase(list.begin() + 100, list.begin() + 140); // 16 deg
    };
    erase(trace.angle_rad);
    erase(trace.radial_deviation_mm);
    const CircularCertificate certificate = certificate_of(bare_measurement(broken));
    EXPECT_EQ(polar_view_of(certificate, Sense::ccw).traces.front().pieces.size(), 2u);
    EXPECT_EQ(polar_view_of(certificate, Sense::cw).traces.front().pieces.size(), 1u);
}

TEST(PolarView, AFarNominalCircleGivesWayToTheLeastSquaresOne) {
    const CircularTest large =
        circular_test({{"scale_x", 1e-3}, {"scale_y", 1e-3}, {"square", 1e-5}}, 1);
    const PolarView view = polar_view_of_both(certificate_of(bare_measurement(large)));
    EXPECT_NEAR(view.base_mm, 0.150, 1e-4);
    EXPECT_EQ(polar_view_of_both(test::circular_certificate()).base_mm, 0);
}

TEST_F(PolarPlot, InksTheRingAndEachControlPointWhereTheAnalysisPutsThem) {
    const PolarView view = polar_view_of(test::circular_certificate(), Sense::ccw);
    const test::PageImage image = draw(view);
    const double outer = place_.scale.radius_pt(view.zone->outer_mm);
    const double inner = place_.scale.radius_pt(view.zone->inner_mm);
    EXPECT_NEAR(outer - inner,
                (view.zone->outer_mm - view.zone->inner_mm) * place_.scale.magnification *
                    points_per_mm,
                1e-9);
    for (int degrees = 3; degrees < 360; degrees += 7)
        for (const double radius : {outer, inner}) {
            const double angle = degrees * test::one_degree;
            const PagePoint at{place_.centre.x + radius * std::cos(angle),
                               place_.centre.y - radius * std::sin(angle)};
            EXPECT_LT(darkest_at(image, at), 215) << degrees << " deg, radius " << radius;
        }
    ASSERT_EQ(view.marks.size(), 4u);
    for (const PolarMark& mark : view.marks)
        EXPECT_LT(darkest_at(image, place_.at(mark.at)), 120) << mark.number;
}

TEST_F(PolarPlot, KeepsItsInkInsideTheBox) {
    std::mt19937 random{11};
    for (int trial = 0; trial < 6; ++trial) {
        CircularCertificate certificate = random_certificate(random);
        if (trial == 1) certificate.measured.axes = {"LONGNAME", "W"};
        if (trial == 2) certificate.measured.conditions.overshoot_deg = 180;
        const test::PageImage image = draw(polar_view_of_both(certificate));
        int inside = 0, outside = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const bool in_box = x >= plot_box.x - 1 && x <= plot_box.right() &&
                                    y >= plot_box.y - 1 && y <= plot_box.bottom();
                (in_box ? inside : outside) += image.ink_at(x, y);
            }
        EXPECT_GT(inside, 2000);
        EXPECT_EQ(outside, 0) << trial;
        EXPECT_THAT(test::collisions_in(test::words_of(pdf_)), ::testing::IsEmpty());
    }
}

TEST_F(PolarPlot, TurnsTheFirstAxisRightAndTheSecondUp) {
    CircularTest bump = circular_test({}, 1, 0, 360, 0);
    for (CircularTrace& trace : bump.traces)
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i)
            if (std::fabs(folded_angle(trace.angle_rad[i]) - 0.5) < 0.1)
                trace.radial_deviation_mm[i] = 0.010;
    const PolarView view = polar_view_of(certificate_of(bare_measurement(bump)), Sense::ccw);
    draw(view);
    const PagePoint right = place_.at({0, 0}), up = place_.at({test::one_degree * 90, 0});
    EXPECT_GT(right.x, place_.centre.x + 50);
    EXPECT_NEAR(right.y, place_.centre.y, 1e-9);
    EXPECT_LT(up.y, place_.centre.y - 50);
    EXPECT_NEAR(view.traces.front().start_rad, 0, 1e-12);
}

} // namespace
} // namespace axiscal::polar_plot_test

#include "analysis/squareness/squareness_figures.hpp"

#include "tests/unit/analysis/square_machine.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

namespace axiscal::squareness_figures_test {
namespace {

using testing::equal_steps;
using testing::first_line;
using testing::second_line;
using testing::SquareMachine;

constexpr double exact = 1e-15;

RecordedLine recorded(const std::vector<double>& deviations_um) {
    RecordedLine line;
    double place = 0;
    for (const double deviation : deviations_um) {
        line.rows.push_back({mm(place), um(deviation), {}});
        place += 100;
    }
    return line;
}

/// Slopes: end points 1/75000, least squares 1/125000, minimum zone 1/200000.
RecordedLine crooked() {
    return recorded({0, 5, 1, 4});
}

/// Whatever the reference: 1/50000.
RecordedLine leaning() {
    return recorded({0, 2, 4, 6});
}

RecordedLine with_slope(RecordedLine line, double um_a_step) {
    for (std::size_t i = 0; i < line.rows.size(); ++i)
        line.rows[i].forward += um(um_a_step * static_cast<double>(i));
    return line;
}

SquarenessFigures figures_of(const RecordedLine& second, const SquarenessSetup& setup) {
    const auto line = line_of(second);
    EXPECT_TRUE(line) << describe(line.error());
    const auto figures = evaluate_squareness(*line, setup);
    EXPECT_TRUE(figures) << describe(figures.error());
    return figures.value_or(SquarenessFigures{});
}

void expect_squareness(const Squareness& found, const std::array<double, 3>& right) {
    EXPECT_NEAR(found.end_points, right[0], exact);
    EXPECT_NEAR(found.least_squares, right[1], exact);
    EXPECT_NEAR(found.minimum_zone, right[2], exact);
}

TEST(Squareness, OpensWhereBothAxesLeanApart) {
    SquarenessSetup setup;
    setup.first = recorded({0, -2, -4, -6});
    const SquarenessFigures found = figures_of(recorded({0, -1, -2, -3}), setup);
    const double right = 3e-5 - (8e-15 + 1e-15) / 3; // atan x = x - x^3 / 3
    expect_squareness(found.squareness, {right, right, right});
    EXPECT_FALSE(found.by_reversal);
    EXPECT_EQ(found.square_error_rad, 0);
    EXPECT_FALSE(found.other);
}

// By exact fractions, atan by three terms of its series:
//   slopes 1/75000 1/125000 1/200000, each with 1/50000
//   -3.33333333298765460e-05 -2.79999999971626662e-05 -2.49999999972916676e-05
TEST(Squareness, AddsTheSlopesOfBothAxesByEachReference) {
    SquarenessSetup setup;
    setup.first = crooked();
    const SquarenessFigures found = figures_of(leaning(), setup);
    expect_squareness(found.squareness, {-3.33333333298765460e-05, -2.79999999971626662e-05,
                                         -2.49999999972916676e-05});
    EXPECT_NEAR(found.squareness.method_spread, 8.3333333325848784e-06, exact);
    expect_squareness(found.lines.apparent,
                      {found.squareness.end_points, found.squareness.least_squares,
                       found.squareness.minimum_zone});
}

TEST(Squareness, IsTheSameWithTheAxesExchanged) {
    SquarenessSetup one, other;
    one.first = crooked(), other.first = leaning();
    const Squareness a = figures_of(leaning(), one).squareness;
    const Squareness b = figures_of(crooked(), other).squareness;
    expect_squareness(a, {b.end_points, b.least_squares, b.minimum_zone});
}

// The same fractions, plus and minus an error of 5 urad.
TEST(Squareness, TakesOutTheErrorThatIsStatedOfTheSquare) {
    SquarenessSetup setup;
    setup.first = crooked();
    setup.stated.error = radian(5e-6);
    const SquarenessFigures normal = figures_of(leaning(), setup);
    expect_squareness(normal.squareness, {-2.83333333298765431e-05, -2.29999999971626666e-05,
                                          -1.99999999972916680e-05});
    EXPECT_EQ(normal.square_error_rad, 5e-6);
    setup.square = SquarePosition::turned;
    const SquarenessFigures turned = figures_of(leaning(), setup);
    expect_squareness(turned.squareness, {-3.83333333298765456e-05, -3.29999999971626658e-05,
                                          -2.99999999972916671e-05});
    EXPECT_EQ(turned.square_error_rad, 5e-6);
    EXPECT_NEAR(normal.squareness.method_spread, turned.squareness.method_spread, exact);
}

SquarenessSetup with_other(SquarePosition square) {
    SquarenessSetup setup;
    setup.first = crooked();
    setup.square = square;
    setup.stated.error = radian(1e-3); // by reversal no statement counts
    setup.other = OtherSquare{with_slope(crooked(), 0.3), recorded({0, 1, 2, 3})};
    return setup;
}

// In the other position the first axis leans by 3 urad more and the second by 10 urad less; by the
// same fractions:
//   means -2.98333333307120420e-05 -2.44999999981928341e-05 -2.14999999983938332e-05
//   half of (other minus own), least squares: 3.49999999896983339e-06
TEST(Squareness, ByReversalIsTheMeanOfBothPositionsOfTheSquare) {
    for (const SquarePosition square : {SquarePosition::normal, SquarePosition::turned}) {
        const SquarenessFigures found = figures_of(leaning(), with_other(square));
        expect_squareness(found.squareness, {-2.98333333307120420e-05, -2.44999999981928341e-05,
                                             -2.14999999983938332e-05});
        EXPECT_TRUE(found.by_reversal);
        ASSERT_TRUE(found.other);
        const double sign = square == SquarePosition::normal ? 1 : -1;
        EXPECT_NEAR(found.square_error_rad, sign * 3.49999999896983339e-06, exact);
    }
}

TEST(Squareness, OfARunInBothDirectionsIsThatOfTheirMean) {
    RecordedLine both = crooked();
    for (RecordedLineRow& row : both.rows) {
        row.backward = row.forward + um(3);
        row.forward -= um(3);
    }
    const auto line = line_of(both);
    ASSERT_TRUE(line);
    const std::vector<double> means{0, 5, 1, 4};
    for (std::size_t i = 0; i < means.size(); ++i) {
        EXPECT_NEAR(line->line.deviations[i], means[i], 1e-12);
        EXPECT_NEAR(line->line.positions[i], 1e5 * static_cast<double>(i), 1e-9);
    }
    EXPECT_NEAR(line->against.least_squares.slope, 1.0 / 125'000, exact);
}

TEST(Squareness, RefusesWhatIsNoLine) {
    EXPECT_EQ(line_of(RecordedLine{}).error().fault, Fault::bad_case);
    EXPECT_FALSE(line_of(recorded({1})));
    RecordedLine in_parts = crooked();
    in_parts.rows[1].backward = um(1);
    EXPECT_FALSE(line_of(in_parts));
    RecordedLine falling = crooked();
    std::swap(falling.rows[0], falling.rows[1]);
    EXPECT_FALSE(line_of(falling));
    const auto good = line_of(leaning());
    ASSERT_TRUE(good);
    SquarenessSetup setup;
    EXPECT_FALSE(evaluate_squareness(*good, setup));
    setup.first = crooked();
    setup.other = OtherSquare{crooked(), {}};
    EXPECT_FALSE(evaluate_squareness(*good, setup));
}

const std::vector<double> first_places = equal_steps(11, 50), second_places = equal_steps(9, 50);

SquarenessFigures seen_on(const SquareMachine& machine) {
    SquarenessSetup setup;
    setup.first = first_line(machine, first_places);
    setup.other = OtherSquare{first_line(machine, first_places),
                              second_line(machine, SquarePosition::turned, second_places)};
    return figures_of(second_line(machine, SquarePosition::normal, second_places), setup);
}

TEST(SquarenessOfAMachine, IsFoundWithoutNoiseToTheRoundingOfItsPlaces) {
    const SquarenessFigures found = seen_on({80e-6, -30e-6, 0.4e-3, -0.2e-3});
    EXPECT_NEAR(found.squareness.least_squares, 80e-6, 1e-14);
    EXPECT_NEAR(found.squareness.end_points, 80e-6, 1e-14);
    EXPECT_NEAR(found.squareness.minimum_zone, 80e-6, 1e-13);
    EXPECT_NEAR(found.square_error_rad, -30e-6, 1e-14);
    EXPECT_NEAR(found.lines.apparent.least_squares, 110e-6, 1e-14); // S - e
    ASSERT_TRUE(found.other);
    EXPECT_NEAR(found.other->apparent.least_squares, 50e-6, 1e-14); // S + e
}

TEST(SquarenessOfAMachine, IsTheSameWithAxesAndMirrorTurnedTogether) {
    for (const double angle : {0.3, -1.1, 2.5}) {
        const SquarenessFigures found = seen_on({80e-6, -30e-6, 0.4e-3 + angle, -0.2e-3 + angle});
        EXPECT_NEAR(found.squareness.least_squares, 80e-6, 1e-13) << angle;
        EXPECT_NEAR(found.square_error_rad, -30e-6, 1e-13) << angle;
        EXPECT_NEAR(found.lines.first.against.least_squares.slope, std::tan(0.6e-3), 1e-13);
    }
}

// The mirror alone turned leans one line by as much as it closes the other.
TEST(SquarenessOfAMachine, IsTheSameWhereverTheMirrorPoints) {
    for (const double mirror : {0.0, 1e-3, -5e-3}) {
        const SquarenessFigures found = seen_on({80e-6, -30e-6, 0.4e-3, mirror});
        EXPECT_NEAR(found.squareness.least_squares, 80e-6, 1e-13) << mirror;
        EXPECT_NEAR(found.square_error_rad, -30e-6, 1e-13) << mirror;
    }
}

// Each mean with 0.5 um of noise; with Q = sum (x - mean)^2 the slope of a line has s / sqrt Q.
// Both figures are half of the sum of four slopes: s sqrt((1/Q1 + 1/Q2) / 2) = 1.13 urad with Q1 =
// 110 (50 mm)^2 and Q2 = 60 (50 mm)^2. Of 400 figures one is beyond five times that in 4000 tries.
TEST(SquarenessOfAMachine, AndTheErrorOfTheSquareAreFoundInNoise) {
    constexpr double s_um = 0.5;
    const double bound = 5 * s_um * std::sqrt((1 / 275e9 + 1 / 150e9) / 2);
    std::mt19937_64 random{230};
    std::normal_distribution<double> noise{0, s_um};
    std::uniform_real_distribution<double> share{-1, 1};
    const auto noisy = [&](RecordedLine line) {
        for (RecordedLineRow& row : line.rows)
            row.forward += um(noise(random));
        return line;
    };
    for (int trial = 0; trial < 200; ++trial) {
        const SquareMachine machine{200e-6 * share(random), 100e-6 * share(random),
                                    1e-3 * share(random), 1e-3 * share(random)};
        SquarenessSetup setup;
        setup.first = noisy(first_line(machine, first_places));
        setup.other = OtherSquare{noisy(first_line(machine, first_places)), {}};
        setup.other->second = noisy(second_line(machine, SquarePosition::turned, second_places));
        const SquarenessFigures found =
            figures_of(noisy(second_line(machine, SquarePosition::normal, second_places)), setup);
        EXPECT_NEAR(found.squareness.least_squares, machine.squareness_rad, bound) << trial;
        EXPECT_NEAR(found.square_error_rad, machine.square_error_rad, bound) << trial;
    }
}

} // namespace
} // namespace axiscal::squareness_figures_test

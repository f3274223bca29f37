#include "simulated_machine.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::simulate::simulated_machine_test {
namespace {

Scenario quiet() {
    Scenario s;
    s.errors.linear_um_per_m = 10;
    s.errors.centre_mm = 0;
    return s;
}

/// Moves in small steps and settles; returns where the slide stands, mm.
double approach(SimulatedMachine& machine, double from, double to, std::uint64_t& sample) {
    for (int i = 0; i <= 400; ++i) {
        const double drive = i < 200 ? from + (to - from) * i / 200.0 : to;
        const double seconds = static_cast<double>(sample) * 1e-3;
        const double slide = machine.slide_mm(drive, seconds, sample);
        ++sample;
        if (i == 400) return slide;
    }
    return 0;
}

TEST(SimulatedMachine, ReversalIsInjectedWithItsSign) {
    for (const double B : {-3.0, 3.0, 0.0}) {
        Scenario s = quiet();
        s.errors.reversal_um = B;
        SimulatedMachine machine{s};
        std::uint64_t sample = 0;
        const double forward = approach(machine, 90, 100, sample);
        approach(machine, 100, 110, sample);
        const double backward = approach(machine, 110, 100, sample);
        EXPECT_NEAR((forward - backward) * 1e3, B, 1e-6);
        // Lost motion: each approach stops short of the drive by half of |B|.
        EXPECT_NEAR((forward - 100) * 1e3, 1.0 + B / 2, 1e-6);
    }
}

TEST(SimulatedMachine, PlayIsUsedUpBeforeTheSlideFollows) {
    Play play{0.004};
    play.follow(1.0);
    EXPECT_DOUBLE_EQ(play.follow(1.1), -1.0);
    EXPECT_NEAR(play.follow(1.098), 0.0, 1e-9); // half way through the play
    EXPECT_DOUBLE_EQ(play.follow(1.0), 1.0);
}

// 1 m of a scale of 8.5e-6 / K at 26 C: 1000 / (1 + 5.1e-5) mm under the head, 0.4 um a cycle.
TEST(SimulatedMachine, AScaleThatHasGrownCountsLess) {
    Scenario s = quiet();
    s.laser.resolution_um = 0.1;
    s.laser.counts_per_cycle = 4;
    s.laser.scale_expansion_um_per_m_k = 8.5;
    s.laser.sign = -1;
    s.thermal.material.start = 24;
    s.thermal.scale_warmer_k = 2;
    SimulatedMachine machine{s};
    EXPECT_DOUBLE_EQ(machine.cycles(0, 0), 0);
    EXPECT_NEAR(machine.cycles(1000, 1), -1000 / (1 + 5.1e-5) / 0.4e-3, 1e-6);
}

// 500 mm at 2 mrad: the spot walks 2.000003 mm, the radius of the beam; exp(-1/2) of 80 % is left.
TEST(SimulatedMachine, ABeamThatWalksOffLosesContrast) {
    Scenario s = quiet();
    s.laser.zero_mm = 100;
    s.laser.contrast_percent = 80;
    s.laser.beam_tilt_mrad = 2;
    EXPECT_DOUBLE_EQ(SimulatedMachine{s}.contrast_percent(600), 80); // a spot without a size
    s.laser.beam_radius_mm = 2;
    SimulatedMachine machine{s};
    EXPECT_DOUBLE_EQ(machine.contrast_percent(100), 80);
    EXPECT_NEAR(machine.contrast_percent(600), 48.522, 1e-3);
    EXPECT_NEAR(machine.contrast_percent(1100), 80 * std::exp(-2.0), 1e-3);
    machine.steer(0);
    EXPECT_DOUBLE_EQ(machine.contrast_percent(1100), 80);
}

TEST(SimulatedMachine, IsBornWithTheTiltOfItsScenario) {
    Scenario s = quiet();
    s.laser.beam_tilt_mrad = 10;
    SimulatedMachine machine{s};
    machine.cycles(0, 0);
    const double tilted = machine.cycles(1000, 0);
    machine.steer(0);
    // 1 - cos(10 mrad) = 4.99996e-5
    EXPECT_NEAR(1 - tilted / machine.cycles(1000, 0), 4.99996e-5, 1e-9);
}

TEST(SimulatedMachine, GrowsExactlyAboutItsFixedPoint) {
    ThermalScenario thermal;
    thermal.expansion_um_per_m_k = 11.7;
    thermal.fixed_point_mm = 200;
    // 800 mm from the fixed point, 6 K above 20 C: 800 * 11.7e-6 * 6 = 0.05616 mm
    EXPECT_NEAR(grown_mm(thermal, 1000, Temperature::celsius(26)), 1000.05616, 1e-10);
    EXPECT_DOUBLE_EQ(grown_mm(thermal, 200, Temperature::celsius(26)), 200);
    EXPECT_DOUBLE_EQ(grown_mm(thermal, 1000, reference_temperature), 1000);
}

TEST(SimulatedMachine, CyclesFollowTheInterferometerEquation) {
    Scenario s = quiet();
    s.laser.dead_path_mm = 100;
    s.air.temperature.rate_per_hour = 3600; // 1 K a second
    SimulatedMachine machine{s};
    const double lambda_mm = s.laser.wavelength_nm * 1e-6;
    EXPECT_DOUBLE_EQ(machine.cycles(0, 0), 0);
    const double n0 = 1 + refractivity(air_at(s.air, 0), nm(s.laser.wavelength_nm));
    const double n1 = 1 + refractivity(air_at(s.air, 1), nm(s.laser.wavelength_nm));
    const double N = machine.cycles(50, 1);
    // D = N lambda / (2 n) + L_d (n0 - n) / n
    EXPECT_NEAR(N * lambda_mm / (2 * n1) + 100 * (n0 - n1) / n1, 50, 1e-9);
    EXPECT_NE(n0, n1);
}

TEST(SimulatedMachine, AxisTowardsTheLaserCountsDown) {
    Scenario s = quiet();
    s.laser.sign = -1;
    s.laser.dead_path_mm = 500;
    SimulatedMachine machine{s};
    machine.cycles(0, 0);
    EXPECT_LT(machine.cycles(1, 0), -3000);
}

TEST(SimulatedMachine, SameSeedIsTheSameWorld) {
    Scenario s = quiet();
    s.errors.noise_um = 0.3;
    s.errors.approach_noise_um = 0.5;
    SimulatedMachine one{s}, same{s};
    s.seed = 2;
    SimulatedMachine other{s};
    std::uint64_t a = 0, b = 0, c = 0;
    const double reference = approach(one, 0, 10, a);
    EXPECT_EQ(reference, approach(same, 0, 10, b));
    EXPECT_NE(reference, approach(other, 0, 10, c));
}

TEST(SimulatedMachine, ApproachesScatterWithTheInjectedSigma) {
    Scenario s = quiet();
    s.errors.approach_noise_um = 0.5;
    SimulatedMachine machine{s};
    std::uint64_t sample = 0;
    double sum = 0, squares = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        approach(machine, 10, 0, sample);
        const double um = (approach(machine, 0, 10, sample) - 10) * 1e3;
        sum += um, squares += um * um;
    }
    const double sigma = std::sqrt(squares / n - sum / n * sum / n);
    EXPECT_NEAR(sigma, 0.5, 0.5 * 4 / std::sqrt(2.0 * n)); // four standard errors of a sigma
}

TEST(SimulatedMachine, StopThatIsSeenOnTheWayChangesNoOtherStop) {
    Scenario s = quiet();
    s.errors.approach_noise_um = 0.5;
    SimulatedMachine one{s}, halting{s};
    std::uint64_t a = 0, b = 0;
    approach(one, 0, 12, a);
    approach(halting, 0, 5, b);
    approach(halting, 5, 12, b);
    EXPECT_EQ(approach(one, 12, 10, a), approach(halting, 12, 10, b));
    const double again = approach(one, 12, 10, a); // another visit, another offset
    EXPECT_NE(again, approach(halting, 10, 10, b));
}

TEST(TrueErrors, SumTermsTableAndPeriod) {
    ErrorScenario e;
    e.linear_um_per_m = 10, e.quadratic_um_per_m2 = 4, e.cubic_um_per_m3 = 8, e.centre_mm = 500;
    e.table = {{0, 1}, {1000, 3}};
    e.periodic = {{0.5, 10, 90}};
    const TrueErrors errors{e};
    // x = 0.5 m from the centre: 5 + 1 + 1; table 3; period at phase 90 degrees 0.5
    EXPECT_NEAR(errors.pitch_um(1000), 7 + 3 + 0.5, 1e-9);
    EXPECT_NEAR(errors.pitch_um(500), 2 + 0.5, 1e-9);
}

} // namespace
} // namespace axiscal::simulate::simulated_machine_test

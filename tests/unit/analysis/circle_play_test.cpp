// Lost motion is no reversal spike: slides that trail their drives, as mechanics has it.

#include "synthetic_circle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace axiscal::circle_play_test {
namespace {

/// Moves only when its drive has taken up the play.
class Slide {
public:
    explicit Slide(double play_mm)
        : half_mm_{play_mm / 2} {}
    double follow(double drive_mm) {
        at_mm_ = std::clamp(at_mm_, drive_mm - half_mm_, drive_mm + half_mm_);
        return at_mm_;
    }

private:
    double half_mm_, at_mm_ = 0;
};

struct Machine {
    double radius_mm = 100, play_x_mm = 0, play_y_mm = 0, noise_mm = 0;
    double spike_mm = 0; ///< inward, after X reverses at 180 deg, 1 deg long, in both senses
};

CircularTrace driven(const Machine& machine, Sense sense, std::mt19937& random) {
    Slide x{machine.play_x_mm}, y{machine.play_y_mm};
    CircularTrace trace{sense, {}, {}};
    std::normal_distribution<double> noise{0, 1};
    const double sign = sense == Sense::ccw ? 1 : -1, first = sense == Sense::ccw ? 0.01 : 359.99;
    for (int i = -9000; i < 36000; ++i) { // 90 deg of overshoot by which both slides are dragged
        const double deg = first + sign * 0.01 * i, theta = deg * test::one_degree;
        const double px = x.follow(machine.radius_mm * std::cos(theta)),
                     py = y.follow(machine.radius_mm * std::sin(theta));
        if (i < 0) continue;
        const double past = sign * (deg - 180);
        const double spike = past > 0 && past < 1 ? machine.spike_mm : 0;
        trace.angle_rad.push_back(theta);
        trace.radial_deviation_mm.push_back(std::hypot(px, py) - machine.radius_mm - spike +
                                            machine.noise_mm * noise(random));
    }
    return trace;
}

CircleDiagnosis diagnosis_of(const Machine& machine, unsigned seed = 1) {
    std::mt19937 random{seed};
    CircularTest test{machine.radius_mm, 1000.0 / 60, SignalSource::external, {}};
    for (const Sense sense : {Sense::ccw, Sense::cw})
        test.traces.push_back(driven(machine, sense, random));
    return diagnose_circle(test, {"X", "Y"}).value();
}

TEST(CirclePlay, AloneIsNoSpike) {
    for (const double radius : {40.0, 100.0, 300.0})
        for (const double play_um : {3.0, 6.0, 12.0}) {
            const CircleDiagnosis found =
                diagnosis_of({radius, play_um * 1e-3, play_um * 0.5e-3, 0.1e-3, 0});
            ASSERT_EQ(found.reversals.size(), 8U);
            for (const auto& reversal : found.reversals) {
                const double wanted = reversal.axis == 0 ? play_um * 1e-3 : play_um * 0.5e-3;
                EXPECT_NEAR(reversal.step_mm, wanted, 0.15e-3) << radius << " " << play_um;
                EXPECT_FALSE(reversal.spike_significant)
                    << radius << " mm, " << play_um << " um: " << reversal.spike_mm;
            }
            EXPECT_EQ(
                std::ranges::count(found.ranking, "reversal_spikes", &CauseContribution::cause), 0);
        }
}

TEST(CirclePlay, ASpikeBesideItIsFoundWithItsHeight) {
    const CircleDiagnosis found = diagnosis_of({100, 0.006, 0.003, 0.1e-3, 0.009});
    int spikes = 0;
    for (const auto& reversal : found.reversals) {
        if (!reversal.spike_significant) continue;
        ++spikes;
        EXPECT_EQ(reversal.at_deg, 180);
        EXPECT_NEAR(reversal.spike_mm, -0.009, 1e-3); // noise, and what the play is not known by
    }
    EXPECT_EQ(spikes, 2) << "one in each sense";
}

} // namespace
} // namespace axiscal::circle_play_test

// The truth: a mean over T leaves sin(pi f T) / (pi f T) of a sinusoid, a first order low pass
// 1 / sqrt(1 + (f / f_c)^2).
#include "analysis/circular/capture_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace axiscal::capture_effect_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius_mm = 100, feed_mm_per_s = 200 * pi; // a turn a second
constexpr double rate_hz = 2000;

CircularCapture capture_of(int averaged, std::optional<double> low_pass_hz = {}) {
    return {rate_hz, low_pass_hz, averaged};
}

/// `count` undulations of 10 um on a whole turn in one sense.
CircularTest undulating(int count) {
    CircularTest test{radius_mm, feed_mm_per_s, SignalSource::external, {{Sense::ccw, {}, {}}}};
    for (int i = 0; i < static_cast<int>(rate_hz); ++i) {
        const double angle = 2 * pi * i / rate_hz;
        test.traces[0].angle_rad.push_back(angle);
        test.traces[0].radial_deviation_mm.push_back(0.01 * std::cos(count * angle));
    }
    return test;
}

TEST(CaptureEffect, ManyReadingsAveragedIntoOneLeaveTheSinc) {
    // f T = 1/4: sin(pi/4) / (pi/4) = 0.900316
    EXPECT_NEAR(capture_gain(capture_of(10'000), rate_hz / 4), 0.900316, 1e-6);
    EXPECT_NEAR(capture_gain(capture_of(10'000), rate_hz), 0, 1e-12);
    // Of two readings the cosine of half their distance: cos(pi/8).
    EXPECT_NEAR(capture_gain(capture_of(2), rate_hz / 4), std::cos(pi / 8), 1e-12);
    EXPECT_EQ(capture_gain(capture_of(1), rate_hz / 4), 1);
}

TEST(CaptureEffect, ALowPassLeavesTheHalfPowerAtItsCutOff) {
    EXPECT_NEAR(capture_gain(capture_of(1, 40), 40), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(capture_gain(capture_of(1, 40), 20), 1 / std::sqrt(1.25), 1e-12);
    EXPECT_EQ(capture_gain(capture_of(1, 40), 0), 1);
}

TEST(CaptureEffect, SaysWhereOnePercentIsLost) {
    // 1 / sqrt(1 + x^2) = 0.99 at x = 0.142492: 5.69970 Hz of 40, at a turn a second.
    const CaptureEffect filtered = capture_effect(undulating(4), capture_of(1, 40));
    ASSERT_TRUE(filtered.one_percent_per_revolution);
    EXPECT_NEAR(*filtered.one_percent_per_revolution, 5.6997, 1e-3);
    ASSERT_EQ(filtered.gains.size(), 6U);
    EXPECT_EQ(filtered.gains[2].per_revolution, 15);
    EXPECT_NEAR(filtered.gains[2].frequency_hz, 15, 1e-9);
    EXPECT_NEAR(filtered.gains[2].gain, 40 / std::hypot(40.0, 15.0), 1e-12);
}

TEST(CaptureEffect, DoneOnceMoreALowPassTakesItsShareOfG) {
    // 12 undulations of 20 um from peak to peak: the second time leaves 40 / sqrt(40^2 + 12^2).
    const CaptureEffect effect = capture_effect(undulating(12), capture_of(1, 40));
    const double expected_mm = 0.02 * (40 / std::hypot(40.0, 12.0) - 1); // 0.84 um less
    ASSERT_TRUE(effect.done_again_mm.contains("G_ccw")) << effect.not_known;
    // The step of 0.5 ms: (omega h)^2 / 6 of the loss is 2e-4 of it; the peaks lie between
    // readings.
    EXPECT_NEAR(effect.done_again_mm.at("G_ccw"), expected_mm, 2e-5);
    EXPECT_FALSE(effect.done_again_mm.contains("G_cw"));
}

TEST(CaptureEffect, DoneOnceMoreAMeanTakesItsShareOfG) {
    // 100 undulations at 2 kHz: f T = 1/20, sinc = 0.995893; 20 um lose 0.082 um.
    const CaptureEffect effect = capture_effect(undulating(100), capture_of(1000));
    ASSERT_TRUE(effect.done_again_mm.contains("G_ccw")) << effect.not_known;
    const double expected_mm = 0.02 * (std::sin(pi / 20) / (pi / 20) - 1);
    EXPECT_NEAR(effect.done_again_mm.at("G_ccw"), expected_mm, 0.02 * 1e-4);
}

TEST(CaptureEffect, WithoutAveragingAndFilterThereIsNone) {
    const CaptureEffect none = capture_effect(undulating(4), capture_of(1));
    EXPECT_FALSE(is_changed(none.capture));
    EXPECT_TRUE(none.gains.empty() && none.done_again_mm.empty() && none.not_known.empty());
}

TEST(CaptureEffect, SaysWhyItIsNotKnown) {
    const CaptureEffect no_rate = capture_effect(undulating(4), {0, {}, 8});
    EXPECT_NE(no_rate.not_known.find("sampling rate is not known"), std::string::npos);
    EXPECT_TRUE(no_rate.gains.empty());
    // 1 Hz settles in 0.95 s of a turn of 1 s.
    const CaptureEffect slow = capture_effect(undulating(4), capture_of(1, 1));
    EXPECT_NE(slow.not_known.find("settles on no half"), std::string::npos) << slow.not_known;
    EXPECT_EQ(slow.gains.size(), 6U);
}

} // namespace
} // namespace axiscal::capture_effect_test

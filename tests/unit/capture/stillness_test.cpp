#include "acquisition/capture/stillness.hpp"

#include "axis_signal.hpp"

#include <gtest/gtest.h>

namespace axiscal::stillness_test {
namespace {

using testing::at_s;
using testing::AxisSignal;
using testing::find_still_window;
using testing::quiet_config;

TEST(WindowStatistics, FindsMeanSpreadAndSlopeOfAKnownRamp) {
    // 11 samples, 10 ms apart, from 100 m upwards by 1 nm each: slope 0.1 um/s.
    std::vector<Sample> samples;
    for (int i = 0; i <= 10; ++i)
        samples.emplace_back(0, at_s(1000 + 0.01 * i), 100.0 + 1e-9 * i);
    const auto found = statistics_of(summary_of(samples));
    EXPECT_EQ(found.n, 11);
    EXPECT_NEAR(found.mean.si(), 100.0 + 5e-9, 1e-13);
    EXPECT_NEAR(found.spread.in(nm), 10.0, 1e-3);
    EXPECT_NEAR(found.slope_um_per_s, 0.1, 1e-5);
}

TEST(WindowStatistics, AreShiftAndSignInvariant) {
    std::mt19937_64 random{3};
    std::normal_distribution<double> noise{0, 1e-6};
    std::vector<Sample> plain, turned;
    for (int i = 0; i < 200; ++i) {
        const double x = noise(random);
        plain.emplace_back(0, at_s(i * 1e-3), x);
        turned.emplace_back(0, at_s(50 + i * 1e-3), 2.0 - x);
    }
    const auto a = statistics_of(summary_of(plain)), b = statistics_of(summary_of(turned));
    EXPECT_NEAR(a.mean.si(), 2.0 - b.mean.si(), 1e-14);
    EXPECT_NEAR(a.spread.si(), b.spread.si(), 1e-14);
    EXPECT_NEAR(a.slope_um_per_s, -b.slope_um_per_s, 1e-6);
}

TEST(WindowStatistics, OfNothingAreZero) {
    EXPECT_EQ(statistics_of(SampleSummary{}).n, 0);
    const std::vector<Sample> one{Sample{0, at_s(1), 0.25}};
    EXPECT_EQ(statistics_of(summary_of(one)).n, 1);
    EXPECT_EQ(statistics_of(summary_of(one)).slope_um_per_s, 0.0);
}

StillnessVerdict judge_last_window(const AxisSignal& signal) {
    const auto config = quiet_config();
    return judge_window(signal.history, signal.now() - config.window, signal.now(), config);
}

TEST(Stillness, AcceptsAStandingAxisWithNoise) {
    AxisSignal signal;
    const auto verdict = judge_last_window(signal.stand(0.6));
    EXPECT_TRUE(verdict.still) << verdict.reason;
    EXPECT_TRUE(verdict.reason.empty());
}

TEST(Stillness, RejectsWindowWithSlowDrift) {
    AxisSignal signal;
    signal.drift_um_per_s = 3;
    const auto verdict = judge_last_window(signal.stand(0.6));
    EXPECT_EQ(verdict.fault, Fault::not_still);
    EXPECT_NE(verdict.reason.find("drifts by"), std::string::npos) << verdict.reason;
}

TEST(Stillness, RejectsVibrationThatHasNoSlope) {
    AxisSignal signal;
    signal.noise_um = 2;
    const auto verdict = judge_last_window(signal.stand(0.6));
    EXPECT_EQ(verdict.fault, Fault::not_still);
    EXPECT_NE(verdict.reason.find("spread over"), std::string::npos) << verdict.reason;
}

TEST(Stillness, RejectsTooFewSamples) {
    SampleHistory samples;
    for (int i = 0; i < 19; ++i)
        samples.push(Sample{0, at_s(1 + i * 0.5 / 18), 0.0});
    const auto verdict = judge_window(samples, at_s(1), at_s(1.5), quiet_config());
    EXPECT_EQ(verdict.reason, "Only 19 samples in 0.5 s, 20 are needed.");
}

TEST(Stillness, RejectsASilenceInsideTheWindow) {
    AxisSignal signal;
    signal.stand(0.2).lose(0.1).stand(0.4);
    const auto verdict = judge_last_window(signal);
    EXPECT_EQ(verdict.fault, Fault::not_still);
    EXPECT_NE(verdict.reason.find("silent"), std::string::npos) << verdict.reason;
}

TEST(Stillness, NamesTheFaultOfABadSample) {
    const std::vector<std::pair<Quality, Fault>> expected{{Quality::beam_lost, Fault::beam_lost},
                                                          {Quality::signal_error, Fault::overspeed},
                                                          {Quality::absent, Fault::signal_error}};
    for (const auto& [quality, fault] : expected) {
        AxisSignal signal;
        signal.stand(0.3).bad(quality).stand(0.3);
        EXPECT_EQ(judge_last_window(signal).fault, fault) << name_of(quality);
    }
}

TEST(Stillness, RejectsAWindowOverTwoEpochs) {
    AxisSignal signal;
    signal.stand(0.3);
    signal.epoch = 2;
    EXPECT_EQ(judge_last_window(signal.stand(0.3)).fault, Fault::datum_lost);
}

TEST(Stillness, CallsAJumpBeyondTheFastestFeedImplausible) {
    AxisSignal signal;
    signal.stand(0.3);
    signal.offset_mm = 10; // 10 mm in 1 ms would be 10 m/s
    EXPECT_EQ(judge_last_window(signal.stand(0.3)).fault, Fault::implausible_jump);
}

/// A laser of 25 readings a second at 70 mm/s, one of them read 39 ms late: u(t) is 41 ms /
/// sqrt(3).
std::optional<Error> lost_by_a_late_reading(Duration u_of_stamps, double jump_mm) {
    SampleHistory history{SampleHistory::Limits{std::chrono::seconds{10}}};
    Sample late{0, at_s(1.039), mm(100).si()}, next{0, at_s(1.040), mm(100 + jump_mm).si()};
    late.time_uncertainty = next.time_uncertainty = u_of_stamps;
    history.push(late);
    history.push(next);
    return find_lost_count(history, history.all(), mm_per_minute(40'000));
}

TEST(Stillness, JudgesAJumpByWhatItsStampsLeaveOpen) {
    constexpr Duration u = std::chrono::microseconds{23671};
    EXPECT_FALSE(lost_by_a_late_reading(u, 2.8));
    EXPECT_TRUE(lost_by_a_late_reading(Duration{}, 2.8));
    EXPECT_TRUE(lost_by_a_late_reading(u, 60)); // 55 mm are possible in 83 ms
}

TEST(Stillness, DoesNotCallAFastMoveImplausible) {
    AxisSignal signal;
    signal.stand(0.1).move_to(300, 990).stand(0.1);
    EXPECT_FALSE(find_lost_count(signal.history, signal.history.all(), metre_per_second(1)));
}

TEST(FindStillWindow, LiesEntirelyAfterTheTrigger) {
    AxisSignal signal;
    signal.stand(5);
    const auto trigger = signal.now();
    EXPECT_FALSE(find_still_window(signal.history, trigger, trigger, quiet_config()).window);
    signal.stand(0.499);
    EXPECT_FALSE(find_still_window(signal.history, trigger, signal.now(), quiet_config()).window);
    signal.stand(0.002);
    const auto search = find_still_window(signal.history, trigger, signal.now(), quiet_config());
    ASSERT_TRUE(search.window) << search.verdict.reason;
    EXPECT_EQ(search.window->begin, trigger);
    EXPECT_EQ(search.window->end - search.window->begin, std::chrono::milliseconds{500});
}

TEST(FindStillWindow, WaitsUntilALateMoveHasEnded) {
    AxisSignal signal;
    const auto trigger = signal.now();
    signal.move_to(20); // 0.4 s
    const auto rest = signal.now();
    signal.stand(2);
    const auto search = find_still_window(signal.history, trigger, signal.now(), quiet_config());
    ASSERT_TRUE(search.window) << search.verdict.reason;
    EXPECT_GE(search.window->begin, rest - std::chrono::milliseconds{1});
    EXPECT_LE(search.window->begin, rest + std::chrono::milliseconds{26});
    EXPECT_NEAR(search.window->statistics.mean.in(mm), 20.0, 1e-4);
}

TEST(FindStillWindow, GoesOnAfterAFlaggedSampleButNotAfterALostBeam) {
    AxisSignal flagged;
    const auto trigger = flagged.now();
    flagged.stand(0.2).bad(Quality::signal_error).stand(1);
    EXPECT_TRUE(find_still_window(flagged.history, trigger, flagged.now(), quiet_config()).window);

    AxisSignal broken;
    broken.stand(0.2).bad(Quality::beam_lost).stand(1);
    const auto search = find_still_window(broken.history, trigger, broken.now(), quiet_config());
    EXPECT_FALSE(search.window);
    ASSERT_TRUE(search.failure);
    EXPECT_EQ(search.failure->fault, Fault::beam_lost);
}

TEST(FindStillWindow, TellsAtTheDeadlineWhyNothingWasStill) {
    AxisSignal signal;
    signal.noise_um = 3;
    const auto trigger = signal.now();
    signal.stand(2);
    const auto search = find_still_window(signal.history, trigger, signal.now(), quiet_config());
    const auto error = not_still(search, std::chrono::seconds{2});
    EXPECT_EQ(error.fault, Fault::not_still);
    EXPECT_NE(error.detail.find("within 2 s. The readings spread over"), std::string::npos)
        << error.detail;
}

TEST(FindStillWindow, TellsThatTheLaserIsSilent) {
    const SampleHistory nothing;
    const auto search = find_still_window(nothing, at_s(1), at_s(11), quiet_config());
    EXPECT_FALSE(search.window);
    EXPECT_EQ(not_still(search, std::chrono::seconds{10}).fault, Fault::link_timeout);
}

} // namespace
} // namespace axiscal::stillness_test

#include "acquisition/capture/capture.hpp"

#include "axis_signal.hpp"

#include <gtest/gtest.h>

namespace axiscal::capture_test {
namespace {

using testing::at_s;
using testing::AxisSignal;
using testing::find_still_window;
using testing::quiet_config;

/// Captures where the signal stands now; the path is judged from `since`.
Result<Capture> capture_here(AxisSignal& signal,
                             Direction direction,
                             MonotonicTime since,
                             Length overrun = 1.0_mm,
                             int sign = 1) {
    const auto trigger = signal.now();
    signal.stand(0.7);
    const auto search = find_still_window(signal.history, trigger, signal.now(), quiet_config());
    if (!search.window) return tl::unexpected<Error>(not_still(search, {}));
    return make_capture(signal.history, *search.window,
                        ApproachClaim{direction, sign, overrun, since}, quiet_config());
}

TEST(Capture, KeepsWhatTheWindowHeld) {
    AxisSignal signal;
    signal.stand(1).move_to(30);
    const auto capture = capture_here(signal, Direction::positive, at_s(10.5));
    ASSERT_TRUE(capture) << capture.error().detail;
    EXPECT_NEAR(capture->mean.in(mm), 30.0, 1e-4);
    EXPECT_EQ(capture->n, static_cast<int>(capture->samples.size()));
    EXPECT_GE(capture->n, 500);
    EXPECT_EQ(capture->samples.front().at, capture->begin);
    EXPECT_EQ(capture->samples.back().device_count, capture->device_count);
    EXPECT_EQ(capture->epoch, 1u);
    ASSERT_TRUE(capture->approach_travel);
    EXPECT_NEAR(capture->approach_travel->in(mm), 30.0, 0.01);
}

// 0.8 um/s, known within 40 us: 0.8 * 40e-6 um.
TEST(Capture, StatesWhatTheUncertainTimeOfItsSamplesAddsByTheSpeedOfTheAxis) {
    for (const double drift_um_per_s : {0.8, -0.8}) {
        AxisSignal signal;
        signal.noise_um = 1e-9;
        signal.drift_um_per_s = drift_um_per_s;
        signal.time_uncertainty = std::chrono::microseconds{40};
        signal.stand(1).move_to(30);
        const auto capture = capture_here(signal, Direction::positive, at_s(10.5));
        ASSERT_TRUE(capture) << capture.error().detail;
        ASSERT_TRUE(capture->synchronisation);
        EXPECT_EQ(capture->synchronisation->time_uncertainty, std::chrono::microseconds{40});
        EXPECT_NEAR(capture->synchronisation->error_um, 32e-6, 1e-9);
    }
}

TEST(Capture, TakesTheWorstTimeOfItsWindow) {
    AxisSignal signal;
    signal.noise_um = 1e-9;
    signal.drift_um_per_s = 0.5;
    signal.time_uncertainty = std::chrono::microseconds{20};
    signal.stand(1).move_to(30);
    const auto since = signal.now();
    signal.stand(0.25);
    signal.time_uncertainty = std::chrono::microseconds{300}; // the clock was fitted anew
    signal.stand(0.01);
    signal.time_uncertainty = std::chrono::microseconds{20};
    signal.stand(0.5);
    const auto search = find_still_window(signal.history, since, signal.now(), quiet_config());
    ASSERT_TRUE(search.window);
    const auto capture = make_capture(signal.history, *search.window, {}, quiet_config());
    ASSERT_TRUE(capture && capture->synchronisation);
    EXPECT_NEAR(capture->synchronisation->error_um, 0.5 * 300e-6, 1e-9);
}

TEST(Capture, StatesNoSynchronisationWhereOneSampleDoesNotKnowItsTime) {
    AxisSignal signal;
    signal.drift_um_per_s = 0.5;
    signal.time_uncertainty = std::chrono::microseconds{20};
    signal.stand(1).move_to(30);
    const auto since = signal.now();
    signal.stand(0.25);
    signal.time_uncertainty = Duration{};
    signal.stand(0.002);
    signal.time_uncertainty = std::chrono::microseconds{20};
    signal.stand(0.5);
    const auto search = find_still_window(signal.history, since, signal.now(), quiet_config());
    ASSERT_TRUE(search.window);
    const auto capture = make_capture(signal.history, *search.window, {}, quiet_config());
    ASSERT_TRUE(capture);
    EXPECT_FALSE(capture->synchronisation) << "not stated, never 0";
}

TEST(Approach, SeesBothSidesWithBothSigns) {
    for (const int sign : {1, -1})
        for (const auto direction : {Direction::positive, Direction::negative}) {
            AxisSignal signal;
            signal.sign = sign;
            const auto since = signal.stand(1).now();
            signal.move_to(static_cast<int>(direction) * 25);
            const auto capture = capture_here(signal, direction, since, 1.0_mm, sign);
            ASSERT_TRUE(capture);
            ASSERT_TRUE(capture->approach_travel) << capture->approach_travel.error().detail;
            EXPECT_NEAR(capture->approach_travel->in(mm), 25, 0.02);
        }
}

TEST(Approach, RefusesTheWrongSide) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.move_to(25);
    const auto capture = capture_here(signal, Direction::negative, since);
    ASSERT_TRUE(capture);
    ASSERT_FALSE(capture->approach_travel);
    EXPECT_EQ(capture->approach_travel.error().fault, Fault::wrong_direction);
    EXPECT_NE(capture->approach_travel.error().detail.find(
                  "from below. The program exchanges forward and backward: let it "
                  "reach this target from above."),
              std::string::npos)
        << capture->approach_travel.error().detail;
    EXPECT_NEAR(capture->mean.in(mm), 25, 1e-4) << "the reading is kept for the diagnosis";
}

TEST(Approach, AtTheEndOfTheSweepOnlyTheOverrunCounts) {
    AxisSignal signal;
    signal.stand(1).move_to(100).stand(1);
    const auto since = signal.now();
    signal.move_to(102).stand(0.3).move_to(100);
    const auto capture = capture_here(signal, Direction::negative, since);
    ASSERT_TRUE(capture->approach_travel) << capture->approach_travel.error().detail;
    EXPECT_NEAR(capture->approach_travel->in(mm), 2, 0.02);
}

TEST(Approach, RefusesAnOverrunThatIsTooShort) {
    AxisSignal signal;
    signal.stand(1).move_to(100).stand(1);
    const auto since = signal.now();
    signal.move_to(100.8).move_to(100);
    const auto capture = capture_here(signal, Direction::negative, since);
    ASSERT_FALSE(capture->approach_travel);
    EXPECT_EQ(capture->approach_travel.error().fault, Fault::wrong_direction);
    EXPECT_NE(capture->approach_travel.error().detail.find("from above, 0.95 mm are needed"),
              std::string::npos)
        << capture->approach_travel.error().detail;
}

TEST(Approach, RefusesAnAxisThatDidNotMoveAtAll) {
    AxisSignal signal;
    signal.stand(1).move_to(100).stand(1);
    const auto since = signal.now();
    const auto capture = capture_here(signal, Direction::negative, since);
    ASSERT_FALSE(capture->approach_travel);
    EXPECT_EQ(capture->approach_travel.error().fault, Fault::wrong_direction);
    EXPECT_NE(capture->approach_travel.error().detail.find("the program has no overrun"),
              std::string::npos)
        << capture->approach_travel.error().detail;
}

TEST(Approach, AllowsTheLostMotionOfAReversal) {
    // The program comes back by exactly the overrun; 40 um of backlash shorten what the laser sees.
    AxisSignal signal;
    signal.stand(1).move_to(100).stand(1);
    const auto since = signal.now();
    signal.move_to(101).move_to(100.04);
    const auto capture = capture_here(signal, Direction::negative, since);
    ASSERT_TRUE(capture->approach_travel) << capture->approach_travel.error().detail;
    EXPECT_NEAR(capture->approach_travel->in(mm), 0.96, 0.01);
}

TEST(Approach, SmallOvershootOfTheServoIsNoReversal) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.move_to(50.02).move_to(50, 1);
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_TRUE(capture->approach_travel) << capture->approach_travel.error().detail;
    EXPECT_NEAR(capture->approach_travel->in(mm), 50, 0.02);
}

TEST(Approach, LargeOvershootComesFromTheOtherSide) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.move_to(50.3).move_to(50);
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_FALSE(capture->approach_travel);
    EXPECT_EQ(capture->approach_travel.error().fault, Fault::wrong_direction);
}

TEST(Approach, ServoRippleOnTheWayIsNoReversal) {
    AxisSignal signal;
    signal.wobble_um = 20;
    const auto since = signal.stand(1).now();
    signal.move_to(3, 2);
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_TRUE(capture->approach_travel) << capture->approach_travel.error().detail;
    EXPECT_NEAR(capture->approach_travel->in(mm), 3, 0.03);
}

TEST(Approach, APauseOnTheWayIsNoReversal) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.move_to(0.5).stand(1).move_to(1.2);
    EXPECT_TRUE(capture_here(signal, Direction::positive, since)->approach_travel);
}

TEST(Approach, MotionBeforeThePreviousPointDoesNotCount) {
    AxisSignal signal;
    signal.stand(1).move_to(50).stand(1);
    const auto since = signal.now();
    signal.move_to(50.2);
    EXPECT_FALSE(capture_here(signal, Direction::positive, since)->approach_travel);
}

TEST(Approach, SaysWhenTheEvidenceWasLost) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.lose(0.15).move_to(5).move_to(5.5); // the move of 0.1 s is not seen
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_FALSE(capture->approach_travel);
    EXPECT_EQ(capture->approach_travel.error().fault, Fault::samples_lost);
}

TEST(Approach, ReadingLateIsNoLoss) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.move_to(5).read_late(0.15).move_to(5.5);
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_TRUE(capture->approach_travel) << capture->approach_travel.error().detail;
    EXPECT_NEAR(capture->approach_travel->in(mm), 5.5, 0.01);
}

TEST(Approach, ALossBeforeTheEvidenceDoesNotMatter) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.lose(0.5).move_to(5).move_to(50);
    EXPECT_TRUE(capture_here(signal, Direction::positive, since)->approach_travel);
}

TEST(Approach, SaysWhenTheHistoryIsTooShort) {
    AxisSignal signal; // nothing was recorded before the axis arrived (a restart)
    const auto capture = capture_here(signal, Direction::positive, at_s(1));
    ASSERT_FALSE(capture->approach_travel);
    EXPECT_EQ(capture->approach_travel.error().fault, Fault::samples_lost);
}

TEST(Capture, RefusesWhenTheBeamBrokeOnTheWay) {
    AxisSignal signal;
    const auto since = signal.stand(1).now();
    signal.move_to(10).bad(Quality::beam_lost).move_to(20);
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_FALSE(capture);
    EXPECT_EQ(capture.error().fault, Fault::beam_lost);
}

TEST(Capture, RefusesWhenCountsWereLostOnTheWay) {
    AxisSignal signal; // a homodyne head reports nothing: only the jump shows the broken beam
    const auto since = signal.stand(1).now();
    signal.move_to(10);
    signal.offset_mm = 5;
    signal.move_to(20);
    const auto capture = capture_here(signal, Direction::positive, since);
    ASSERT_FALSE(capture);
    EXPECT_EQ(capture.error().fault, Fault::implausible_jump);
}

TEST(Capture, RefusesAWindowThatTheHistoryForgot) {
    AxisSignal signal;
    signal.stand(1);
    const StillWindow window{at_s(1), at_s(1.5), {500, {}, {}, 0}};
    const auto capture = make_capture(signal.history, window, std::nullopt, quiet_config());
    ASSERT_FALSE(capture);
    EXPECT_EQ(capture.error().fault, Fault::samples_lost);
}

TEST(Capture, OfADatumClaimsNoApproach) {
    AxisSignal signal;
    signal.stand(1);
    const StillWindow window{
        at_s(10.2), at_s(10.7),
        statistics_of(summary_of(signal.history.between(at_s(10.2), at_s(10.7))))};
    const auto capture = make_capture(signal.history, window, std::nullopt, quiet_config());
    ASSERT_TRUE(capture);
    EXPECT_EQ(capture->approach_travel, Length{});
}

TEST(Approach, LawAcceptsEveryTrueApproachAndNoWrongOne) {
    std::mt19937_64 random{11};
    const auto share = [&] { return static_cast<double>(random() % 10'000) / 10'000; };
    for (int round = 0; round < 60; ++round) {
        AxisSignal signal{random()};
        signal.noise_um = 0.25 * share();
        signal.wobble_um = 15 * share();
        signal.sign = random() % 2 == 0 ? 1 : -1;
        const double side = random() % 2 == 0 ? 1 : -1; // where it really comes from
        const double overrun_mm = 0.5 + 2 * share(), backlash_mm = 0.024 * share();
        const auto since = signal.stand(0.2).now();
        signal.move_to(-side * overrun_mm * (1 + share())).stand(0.05 * share());
        signal.move_to(-side * backlash_mm);
        for (const auto claimed : {Direction::positive, Direction::negative}) {
            const auto capture =
                capture_here(signal, claimed, since, mm(overrun_mm), static_cast<int>(signal.sign));
            ASSERT_TRUE(capture) << capture.error().detail;
            EXPECT_EQ(capture->approach_travel.has_value(), static_cast<int>(claimed) == side)
                << "round " << round;
        }
    }
}

} // namespace
} // namespace axiscal::capture_test

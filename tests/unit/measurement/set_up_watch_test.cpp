#include "acquisition/measurement/positioning/set_up_watch.hpp"

#include <gtest/gtest.h>

namespace axiscal::set_up_watch_test {
namespace {

constexpr std::uint32_t epoch = 4;
constexpr Speed fastest = Speed::from_si(0.5);

Sample reading(double at_s, double metres, std::uint32_t of_epoch = epoch) {
    return {0, monotonic_from_ns(static_cast<std::int64_t>(at_s * 1e9)), metres, 0, of_epoch};
}

/// Of a run that this daemon closed.
SetUpWatch::Run closed_run() {
    return {true, epoch, true, fastest};
}

TEST(SetUpWatch, LosesNothingWhileTheAxisMovesNoFasterThanItCan) {
    SetUpWatch watch{"laser"};
    for (int i = 0; i < 20;
         ++i) // 0.5 m/s, and what two neighbouring readings may differ by beside it
        watch.take(reading(0.1 * i, 0.05 * i), closed_run());
    EXPECT_EQ(watch.lost(), "");
    watch.take(reading(2.0, 1.0 + 0.00004), closed_run());
    EXPECT_EQ(watch.lost(), "");
}

TEST(SetUpWatch, NamesAJumpByItsLength) {
    SetUpWatch watch{"laser"};
    watch.take(reading(0, 0.1), closed_run());
    watch.take(reading(0.1, 0.2), closed_run()); // 100 mm, where 51.05 mm are possible
    EXPECT_EQ(watch.lost(), "the laser's reading jumped by 100 mm since the run was closed, "
                            "faster than the axis can move");
}

TEST(SetUpWatch, JudgesAJumpByWhatItsStampsLeaveOpen) {
    SetUpWatch watch{"laser"};
    Sample late = reading(0.039, 0.1), next = reading(0.040, 0.102);
    late.time_uncertainty = next.time_uncertainty = std::chrono::microseconds{23671};
    watch.take(late, closed_run());
    watch.take(next, closed_run());
    EXPECT_EQ(watch.lost(), "");
}

TEST(SetUpWatch, JudgesNoJumpWhereTheSpeedIsNotStated) {
    SetUpWatch watch{"laser"};
    SetUpWatch::Run run = closed_run();
    run.fastest = Speed{};
    watch.take(reading(0, 0.1), run);
    watch.take(reading(0.1, 9.0), run);
    EXPECT_EQ(watch.lost(), "");
}

TEST(SetUpWatch, NamesACounterThatLostItsZeroAndABeamThatWasInterrupted) {
    SetUpWatch counter{"scale"}, beam{"laser"};
    counter.take(reading(0, 0.1, epoch + 1), closed_run());
    EXPECT_EQ(counter.lost(), "the scale's counter lost its zero since the run was closed");
    beam.take(Sample::bad(0, monotonic_from_ns(0), Quality::beam_lost, 0, epoch), closed_run());
    EXPECT_EQ(beam.lost(), "the laser's beam was interrupted since the run was closed");
}

TEST(SetUpWatch, SaysSinceWhenOfARunThatAnEarlierDaemonClosed) {
    SetUpWatch watch{"laser"};
    SetUpWatch::Run run = closed_run();
    run.of_this_start = false;
    watch.take(reading(0, 0.1, epoch + 1), run);
    EXPECT_EQ(watch.lost(), "the laser's counter lost its zero since axiscald was started");
}

TEST(SetUpWatch, KeepsTheFirstReasonUntilAnotherRunIsClosed) {
    SetUpWatch watch{"laser"};
    watch.lose("somebody was at it");
    watch.lose("again");
    watch.take(reading(0, 0.1, epoch + 1), closed_run());
    EXPECT_EQ(watch.lost(), "somebody was at it");
    watch.begin();
    EXPECT_EQ(watch.lost(), "");
    watch.take(reading(1, 5.0), closed_run()); // the first since then: held against none before it
    EXPECT_EQ(watch.lost(), "");
}

TEST(SetUpWatch, SettlesOnceNoOlderByteCanStillCome) {
    SetUpWatch watch{"laser"};
    const SetUpWatch::Run none{false, 0, true, fastest};
    watch.take(reading(0, 0.1), none);
    watch.take(reading(0.9, 0.1), none);
    EXPECT_FALSE(watch.settled()) << "a USB buffer may hold what is a second old";
    watch.take(reading(1.0, 0.1), none);
    ASSERT_TRUE(watch.settled());
    EXPECT_EQ(watch.settled()->at, monotonic_from_ns(1'000'000'000));
    EXPECT_EQ(watch.first_epoch(), epoch);
    watch.take(reading(1.1, 0.1, epoch + 1), none);
    EXPECT_EQ(watch.lost(), "the laser's counter lost its zero since axiscald was started");
}

} // namespace
} // namespace axiscal::set_up_watch_test

// The truth: a beam at an angle gamma reads D cos(gamma); the watch is told readings, no angle.
#include "acquisition/capture/alignment_watch.hpp"

#include "analysis/compensation/cosine_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::alignment_watch_test {
namespace {

using namespace std::chrono_literals;

/// A slide, a beam that can be steered, and a laser at 200 Hz.
struct Workshop {
    AlignmentWatch watch{mm(1000), um(2)};
    double distance_m = 0, angle_rad = 0, angle_across_rad = 0, noise_m = 0;
    double offset_m = 0.3; ///< where the counter happened to be
    std::uint32_t epoch = 0;
    bool tells_strength = true;
    MonotonicTime now = monotonic_from_ns(1'000'000'000);
    int count = 0;

    void sample() {
        now += 5ms;
        const double noise = noise_m * ((++count % 2 == 0) ? 0.5 : -0.5);
        const double gamma = std::hypot(angle_rad, angle_across_rad);
        std::optional<double> strength;
        // A spot of 3 mm radius that walks off by 2 gamma D.
        const double walk = 2 * gamma * distance_m / 3e-3;
        if (tells_strength) strength = 90 * std::exp(-0.5 * walk * walk);
        watch.take({0, now, offset_m + distance_m * std::cos(gamma) + noise, 0, epoch}, strength);
    }
    void stand(Duration span) {
        for (Duration passed{}; passed < span; passed += 5ms)
            sample();
    }
    void drive_to(double metres) {
        constexpr double step_m = 2e-3; // 0.4 m/s
        while (std::fabs(metres - distance_m) > step_m) {
            distance_m += metres > distance_m ? step_m : -step_m;
            sample();
        }
        distance_m = metres;
        stand(1s);
    }
    void steer_to(double radians, double& tilt) {
        constexpr double step_rad = 1e-6;
        while (std::fabs(radians - tilt) > step_rad) {
            tilt += radians > tilt ? step_rad : -step_rad;
            sample();
        }
        tilt = radians;
        stand(1s);
    }
};

TEST(AlignmentWatch, FindsTheCosineErrorOfTheBeamAsItWasLeft) {
    Workshop shop;
    shop.noise_m = 40e-9;
    shop.angle_rad = 2.5e-3;
    shop.stand(1s);
    shop.drive_to(1.0);
    shop.steer_to(-1e-3, shop.angle_rad); // through the best alignment and beyond
    shop.steer_to(0.6e-3, shop.angle_rad);
    const AlignmentRecord record = shop.watch.record();
    ASSERT_TRUE(record.far);
    EXPECT_TRUE(record.far->passed_maximum);
    const auto found = cosine_error_by_reading(record);
    ASSERT_TRUE(found);
    const double truth_um = 1e6 * (1 - std::cos(0.6e-3)); // 0.18
    const double scatter_um = 0.04 + 0.012; // noise, and what steering does within a block
    EXPECT_NEAR(found->error.in(um), truth_um, scatter_um);
    ASSERT_TRUE(found->bound);
    EXPECT_GE(found->bound->in(um), truth_um);
    EXPECT_LE(found->bound->in(um), truth_um + 2 * scatter_um + 0.1);
}

TEST(AlignmentWatch, DoesNotBoundABeamThatNobodySteered) {
    Workshop shop;
    shop.angle_rad = 2e-3;
    shop.noise_m = 40e-9;
    shop.stand(1s);
    shop.drive_to(1.0);
    const auto found = cosine_error_by_reading(shop.watch.record());
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->bound);
}

TEST(AlignmentWatch, DoesNotBoundABeamThatWasOnlyMadeBetter) {
    Workshop shop;
    shop.angle_rad = 3e-3;
    shop.stand(1s);
    shop.drive_to(1.0);
    shop.steer_to(1e-3, shop.angle_rad);
    EXPECT_FALSE(shop.watch.record().far->passed_maximum);
}

// Found by a whole run: at the second visit noise read a little higher, and the passing was
// forgotten.
TEST(AlignmentWatch, AMaximumThatIsVisitedAgainStaysPassed) {
    Workshop shop;
    shop.noise_m = 40e-9;
    shop.angle_rad = 2e-3;
    shop.stand(1s);
    shop.drive_to(1.0);
    shop.steer_to(-2e-3, shop.angle_rad);
    EXPECT_TRUE(shop.watch.record().far->passed_maximum);
    shop.steer_to(0, shop.angle_rad);
    shop.offset_m += 5e-9; // the axis creeps
    shop.stand(1s);
    EXPECT_TRUE(shop.watch.record().far->passed_maximum);
    EXPECT_TRUE(cosine_error_by_reading(shop.watch.record())->bound);
}

TEST(AlignmentWatch, KeepsTheHighestReadingOfBothTilts) {
    Workshop shop;
    shop.angle_rad = 2e-3, shop.angle_across_rad = 1.5e-3;
    shop.stand(1s);
    shop.drive_to(0.8);
    shop.steer_to(-0.5e-3, shop.angle_rad);
    shop.steer_to(0, shop.angle_rad);
    shop.steer_to(-0.5e-3, shop.angle_across_rad);
    shop.steer_to(0, shop.angle_across_rad);
    const AlignmentRecord record = shop.watch.record();
    EXPECT_NEAR(record.far->highest.si(), 0.3 + 0.8, 1e-9);
    EXPECT_NEAR(cosine_error_by_reading(record)->error.in(um), 0, 0.01);
}

TEST(AlignmentWatch, TakesAMoveForNoMisalignment) {
    Workshop shop;
    shop.stand(1s);
    shop.drive_to(1.0);
    shop.drive_to(0.9995); // half a millimetre back: still the far end, another rest
    const AlignmentRecord record = shop.watch.record();
    ASSERT_TRUE(record.far);
    EXPECT_NEAR(record.far->distance.in(mm), 999.5, 1e-6);
    EXPECT_NEAR(cosine_error_by_reading(record)->error.in(um), 0, 1e-6);
}

TEST(AlignmentWatch, KeepsTheFarRestWhenTheAxisReturns) {
    Workshop shop;
    shop.stand(1s);
    shop.drive_to(1.0);
    shop.drive_to(0.1);
    EXPECT_NEAR(shop.watch.record().far->distance.in(mm), 1000, 1e-6);
}

TEST(AlignmentWatch, NeedsADistanceToSeeACosineError) {
    Workshop shop;
    shop.stand(1s);
    shop.drive_to(0.049);
    EXPECT_FALSE(shop.watch.record().far);
}

TEST(AlignmentWatch, ShowsTheStrengthAlongTheTravel) {
    Workshop shop;
    shop.angle_rad = 1e-3;
    shop.stand(1s);
    shop.drive_to(1.0);
    const AlignmentRecord record = shop.watch.record();
    ASSERT_GE(record.places.size(), 25U);
    EXPECT_NEAR(record.places.front().mean_percent, 90, 0.1);
    // at 0.98 m the spot has walked 1.96 mm of its 3 mm
    EXPECT_NEAR(record.places[24].mean_percent, 90 * std::exp(-0.5 * std::pow(1.96 / 3, 2)), 1.5);
    EXPECT_LE(record.places[24].weakest_percent, record.places[24].mean_percent);
    EXPECT_NEAR(record.places[12].begin.in(mm), 480, 1e-6);
    EXPECT_NEAR(record.places[12].end.in(mm), 520, 1e-6);
}

TEST(AlignmentWatch, CountsFromTheNearestReadingWhereverItBegan) {
    Workshop shop;
    shop.distance_m = 0.5;
    shop.stand(1s);
    shop.drive_to(0);
    shop.drive_to(1.0);
    const AlignmentRecord record = shop.watch.record();
    EXPECT_NEAR(record.reached.in(mm), 1000, 1e-6);
    EXPECT_EQ(record.places.front().begin, mm(0));
    EXPECT_NEAR(shop.watch.distance()->in(mm), 1000, 1e-6);
}

TEST(AlignmentWatch, WithoutAStrengthHasNoPlaces) {
    Workshop shop;
    shop.tells_strength = false;
    shop.stand(1s);
    shop.drive_to(1.0);
    EXPECT_TRUE(shop.watch.record().places.empty());
    EXPECT_TRUE(shop.watch.record().far);
}

TEST(AlignmentWatch, GivesUpWhatItSawWhenTheCounterLosesItsZero) {
    Workshop shop;
    shop.stand(1s);
    shop.drive_to(1.0);
    shop.watch.take(Sample::bad(0, shop.now, Quality::beam_lost, 0, 0), {});
    EXPECT_FALSE(shop.watch.distance());
    ++shop.epoch;
    shop.offset_m = 0.1;
    shop.stand(1s);
    const AlignmentRecord record = shop.watch.record();
    EXPECT_FALSE(record.far);
    EXPECT_EQ(record.restarts, 1);
    EXPECT_EQ(record.lost, 1);
    EXPECT_EQ(record.reached, mm(0));
}

} // namespace
} // namespace axiscal::alignment_watch_test

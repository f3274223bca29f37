#include "analysis/compensation/cosine_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::cosine_error_test {
namespace {

AlignmentRecord aligned(Length distance, Length missing, Length scatter, bool passed) {
    AlignmentRecord record;
    record.reached = distance;
    record.far = FarRest{distance, metre(2), metre(2) - missing, scatter, 20, passed};
    return record;
}

// D (1 - cos gamma) by hand: 1 m and 1 mrad give 0.499999958 um.
TEST(CosineError, OfOneMilliradianOverAMetreIsHalfAMicrometre) {
    const Length missing = metre(1 - std::cos(1e-3));
    const auto found = cosine_error_by_reading(aligned(metre(1), missing, nm(50), true));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->error.in(um), 0.499999958, 1e-6);
    EXPECT_NEAR(found->angle.in(radian), 1e-3, 1e-9); // 2 m hold 4e-16 m: 2e-10 of the angle
    ASSERT_TRUE(found->bound);
    EXPECT_NEAR(found->bound->in(um), 0.55, 1e-6);
}

TEST(CosineError, GrowsWithTheSquareOfTheAngle) {
    const auto once = cosine_error_by_reading(aligned(metre(0.5), um(1), um(0.1), true));
    const auto four = cosine_error_by_reading(aligned(metre(0.5), um(4), um(0.1), true));
    EXPECT_NEAR(four->angle / once->angle, 2.0, 1e-5);
}

TEST(CosineError, HasNoBoundUntilTheMaximumWasPassed) {
    const auto found = cosine_error_by_reading(aligned(metre(1), um(3), um(0.1), false));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->error.in(um), 3, 1e-6);
    EXPECT_FALSE(found->bound);
}

TEST(CosineError, IsUnknownWithoutARestFarAway) {
    EXPECT_FALSE(cosine_error_by_reading({}));
}

// tan(gamma) = 2 mm / (2 x 1000 mm) = 1e-3; D (1 - cos) = 0.499999625 um < e^2/(8 D) = 0.5 um.
TEST(CosineError, OfAReturnSpotThatWalksIsHalvedInAngle) {
    AlignmentRecord record;
    record.reached = mm(1000);
    record.spot_offset = mm(2);
    const auto found = cosine_error_by_spot(record);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->angle.in(radian), 0.99999967e-3, 1e-11);
    EXPECT_NEAR(found->error.in(um), 0.499999625, 1e-9);
    EXPECT_NEAR(found->bound->in(um), 0.5, 1e-12);
    EXPECT_GE(*found->bound, found->error);
}

TEST(CosineError, OfASpotNeedsATravel) {
    AlignmentRecord record;
    record.spot_offset = mm(2);
    EXPECT_FALSE(cosine_error_by_spot(record));
    record.reached = mm(100);
    record.spot_offset.reset();
    EXPECT_FALSE(cosine_error_by_spot(record));
}

} // namespace
} // namespace axiscal::cosine_error_test

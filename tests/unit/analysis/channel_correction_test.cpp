#include "analysis/record/channel_correction.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace axiscal::channel_correction_test {
namespace {

/// As a laboratory writes it: at 15, 20 and 30 degC.
const std::vector<CorrectionPoint> table{{15, -0.02}, {20, 0.04}, {30, 0.06}};

TEST(ChannelCorrection, IsTheCertificatesAtItsPoints) {
    for (const CorrectionPoint& point : table)
        EXPECT_DOUBLE_EQ(correction_at(table, point.reading), point.correction);
}

TEST(ChannelCorrection, LiesOnStraightLinesBetweenThem) {
    EXPECT_DOUBLE_EQ(correction_at(table, 17.5), 0.01);
    EXPECT_DOUBLE_EQ(correction_at(table, 25), 0.05);
}

TEST(ChannelCorrection, HoldsBeyondThemAndSaysSo) {
    EXPECT_DOUBLE_EQ(correction_at(table, -40), -0.02);
    EXPECT_DOUBLE_EQ(correction_at(table, 99), 0.06);
    EXPECT_TRUE(beyond_certificate(table, 14.99));
    EXPECT_FALSE(beyond_certificate(table, 15));
    EXPECT_TRUE(beyond_certificate(table, 30.01));
}

TEST(ChannelCorrection, IsNothingWithoutPointsAndConstantWithOne) {
    EXPECT_EQ(correction_at({}, 20), 0);
    EXPECT_FALSE(beyond_certificate({}, 20));
    const std::vector<CorrectionPoint> one{{20, 0.5}};
    EXPECT_EQ(correction_at(one, 19), 0.5);
    EXPECT_EQ(correction_at(one, 21), 0.5);
}

} // namespace
} // namespace axiscal::channel_correction_test

#include "acquisition/run/target_positions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace axiscal::target_positions_test {
namespace {

// The ten-thousandth output of std::mt19937_64 seeded with 5489 is fixed by the C++ standard
// ([rand.predef]); the generator behind the plan is therefore the same on every machine.
TEST(SpreadTargets, UsesTheStandardsGenerator) {
    std::mt19937_64 generator{5489};
    generator.discard(9999);
    EXPECT_EQ(generator(), 9981545732273789042ULL);
}

// First outputs for seed 5489: 14514284786278117030, 4620546740167642908, published with the
// reference implementation (mt19937-64). u = 0.786820954867802, 0.250480340337585;
// r = (2u-1) 30 mm = 17.20925.. mm, -14.97117.. mm, truncated to 0.001 mm.
TEST(SpreadTargets, MapsTheReferenceOutputsAsDocumented) {
    const auto targets = spread_targets(50.0_mm, 100.0_mm, 2, 5489);
    ASSERT_EQ(targets.size(), 2u);
    EXPECT_NEAR(targets[0].in(mm), 67.209, 1e-9);
    EXPECT_NEAR(targets[1].in(mm), 135.029, 1e-9);
}

TEST(SpreadTargets, LawEveryTargetIsAWholeStepWithinThirtyPercent) {
    std::mt19937_64 random{5};
    for (int round = 0; round < 200; ++round) {
        const auto interval = mm(1 + static_cast<double>(random() % 300'000) / 1000);
        const auto first = mm(static_cast<double>(random() % 100'000) / 1000 - 50);
        const int count = 1 + static_cast<int>(random() % 40);
        const auto targets = spread_targets(first, interval, count, random());
        ASSERT_EQ(static_cast<int>(targets.size()), count);
        for (int i = 0; i < count; ++i) {
            const double steps = targets[static_cast<std::size_t>(i)].in(um);
            EXPECT_NEAR(steps, std::round(steps), 1e-5);
            const auto shift = targets[static_cast<std::size_t>(i)] - first - interval * i;
            EXPECT_LE(abs(shift).in(mm), 0.3 * interval.in(mm) + 1e-9);
        }
        if (count > 1) {
            EXPECT_GT(smallest_spacing(targets).in(mm), 0.39 * interval.in(mm));
        }
    }
}

TEST(SpreadTargets, SameSeedSameTargetsOtherSeedOthers) {
    EXPECT_EQ(spread_targets(0.0_mm, 10.0_mm, 20, 42), spread_targets(0.0_mm, 10.0_mm, 20, 42));
    EXPECT_NE(spread_targets(0.0_mm, 10.0_mm, 20, 42), spread_targets(0.0_mm, 10.0_mm, 20, 43));
}

TEST(PhaseSpread, IsTheShortestArcThatHoldsAllPhases) {
    const std::vector<Length> same{10.0_mm, 20.0_mm, 30.0_mm};
    EXPECT_NEAR(phase_spread(same, 10.0_mm).in(mm), 0, 1e-9);
    const std::vector<Length> four{0.0_mm, 12.5_mm, 25.0_mm, 37.5_mm};
    EXPECT_NEAR(phase_spread(four, 10.0_mm).in(mm), 7.5, 1e-9);
    const std::vector<Length> over_zero{9.0_mm, 21.0_mm};
    EXPECT_NEAR(phase_spread(over_zero, 10.0_mm).in(mm), 2, 1e-9);
    const std::vector<Length> negative{-1.0_mm, 1.0_mm};
    EXPECT_NEAR(phase_spread(negative, 10.0_mm).in(mm), 2, 1e-9);
    EXPECT_EQ(phase_spread({}, 10.0_mm), Length{});
}

} // namespace
} // namespace axiscal::target_positions_test

// Two runs of one axis, the mirror turned between them: what is the motion's and what the mirror's.
#include "analysis/straightness/mirror_reversal.hpp"

#include "analysis/straightness/recorded_line_of.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace axiscal::mirror_reversal_test {
namespace {

constexpr std::size_t targets = 11;

double x_mm(std::size_t i) {
    return 100.0 * static_cast<double>(i);
}

/// 0 at both ends, `height` in the middle.
double bow(double height, std::size_t i) {
    const double share = static_cast<double>(i) / (targets - 1);
    return 4 * height * share * (1 - share);
}

/// Bow of 5 um and play of 0.6 um, the mirror's bow of 2 um with the sign of its position, a slope
/// and an offset of the set-up.
struct SetUp {
    double mirror_um, slope, offset_um;
    [[nodiscard]] double forward_um(std::size_t i) const {
        return bow(5, i) + bow(mirror_um, i) + slope * x_mm(i) + offset_um;
    }
    [[nodiscard]] double backward_um(std::size_t i) const { return forward_um(i) - 0.6; }
};

constexpr SetUp normal{2, 0.03, 7}, reversed{-2, -0.01, -4};

StraightnessFigures figures_of(const SetUp& set_up) {
    StraightnessReadings readings;
    for (std::size_t i = 0; i < targets; ++i) {
        const double up = set_up.forward_um(i), down = set_up.backward_um(i);
        readings.targets_mm.push_back(x_mm(i));
        readings.forward_um.push_back({up - 0.1, up + 0.1});
        readings.backward_um.push_back({down, down});
    }
    return *evaluate_straightness(readings);
}

RecordedLine recorded(const SetUp& set_up) {
    RecordedLine line;
    line.run_id = "other";
    line.readings = 2;
    line.scatter = um(0.3);
    for (std::size_t i = 0; i < targets; ++i)
        line.rows.push_back({mm(x_mm(i)), um(set_up.forward_um(i)), um(set_up.backward_um(i))});
    return line;
}

TEST(MirrorReversal, LeavesTheMotionOfEachDirectionAndItsPlay) {
    const auto parted =
        part_straightness(figures_of(normal), MirrorPosition::normal, recorded(reversed));
    ASSERT_TRUE(parted);
    constexpr double rounding = 1e-9;
    for (const LineReference line :
         {LineReference::end_points, LineReference::least_squares, LineReference::minimum_zone}) {
        EXPECT_NEAR(parted->axis.mean.straightness_um(line), 5, rounding);
        EXPECT_NEAR(parted->axis.forward.straightness_um(line), 5, rounding);
        EXPECT_NEAR(parted->axis.backward->straightness_um(line), 5, rounding);
        EXPECT_NEAR(parted->mirror.straightness_um(line), 2, rounding);
    }
    EXPECT_NEAR(*parted->axis.reversal_um, 0.6, rounding);
    EXPECT_NEAR(*parted->axis.mean_reversal_um, 0.6, rounding);
    EXPECT_GT(parted->mirror.line.deviations[5], 0) << "as in the normal position";
}

TEST(MirrorReversal, IsTheSameWhicheverRunWasTheFirst) {
    const auto parted =
        part_straightness(figures_of(reversed), MirrorPosition::reversed, recorded(normal));
    ASSERT_TRUE(parted);
    EXPECT_NEAR(parted->axis.mean.straightness_um(LineReference::least_squares), 5, 1e-9);
    EXPECT_GT(parted->mirror.line.deviations[5], 0);
}

// s of this run: forward 0.1 sqrt 2, backward 0, pooled 0.1; of the other one 0.3.
TEST(MirrorReversal, MeansAreOfTheReadingsOfBothRuns) {
    const auto parted =
        part_straightness(figures_of(normal), MirrorPosition::normal, recorded(reversed));
    ASSERT_TRUE(parted);
    EXPECT_EQ(parted->axis.approaches, 2);
    EXPECT_EQ(parted->axis.readings_of_direction(), 4);
    EXPECT_EQ(parted->axis.readings_a_mean(), 8);
    EXPECT_NEAR(*parted->axis.pooled_s_um, std::sqrt((0.01 + 0.09) / 2), 1e-9);
}

TEST(MirrorReversal, NeedsTheSameTargetsAndDirections) {
    const StraightnessFigures run = figures_of(normal);
    const auto refusal = [&](const RecordedLine& other) {
        return part_straightness(run, MirrorPosition::normal, other).error().detail;
    };
    RecordedLine shorter = recorded(reversed);
    shorter.rows.pop_back();
    EXPECT_NE(refusal(shorter).find("in number"), std::string::npos);
    RecordedLine elsewhere = recorded(reversed);
    elsewhere.rows[3].target += um(10);
    EXPECT_NE(refusal(elsewhere).find("places"), std::string::npos);
    RecordedLine one_way = recorded(reversed);
    for (RecordedLineRow& row : one_way.rows)
        row.backward.reset();
    EXPECT_NE(refusal(one_way).find("directions"), std::string::npos);
}

TEST(MirrorReversal, ARunGivesTheLineThatItWasRecordedWith) {
    const StraightnessFigures run = figures_of(normal);
    const auto again = evaluate_straightness(readings_of(recorded(normal)));
    ASSERT_TRUE(again);
    for (std::size_t i = 0; i < targets; ++i) {
        EXPECT_NEAR(*again->rows[i].mean_um, *run.rows[i].mean_um, 1e-9);
        EXPECT_NEAR(again->rows[i].target_mm, run.rows[i].target_mm, 1e-9);
    }
}

} // namespace
} // namespace axiscal::mirror_reversal_test

#include "analysis/uncertainty/figure_tally.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::figure_tally_test {
namespace {

/// All figures hold the same samples.
template <class Draw> std::vector<Figures> groups_of(std::size_t groups, Draw draw) {
    std::vector<Figures> out(groups);
    for (Figures& figures : out)
        for (std::size_t l = 0; l < lanes; ++l) {
            const double value = draw();
            for (auto& figure : figures)
                figure[l] = value;
        }
    return out;
}

FigureTally tally_of(const std::vector<Figures>& groups, double evaluated) {
    std::array<double, figure_count> all{};
    all.fill(evaluated);
    FigureTally tally{all, {groups.begin(), groups.begin() + 500}};
    for (const Figures& figures : groups)
        tally.add(figures, fastest_lane_code());
    return tally;
}

/// JCGM 101, 7.7, over all samples sorted.
CoverageIntervals by_sorting(const std::vector<Figures>& groups, double coverage) {
    std::vector<double> y;
    for (const Figures& figures : groups)
        y.insert(y.end(), figures[0].begin(), figures[0].end());
    std::ranges::sort(y);
    const auto q = static_cast<std::size_t>(coverage * static_cast<double>(y.size()) + 0.5);
    std::size_t best = 0;
    for (std::size_t r = 0; r + q < y.size(); ++r)
        if (y[r + q] - y[r] < y[best + q] - y[best]) best = r;
    const std::size_t middle = (y.size() - q) / 2;
    return {{y[middle], y[middle + q]}, {y[best], y[best + q]}};
}

TEST(FigureTally, MeanDeviationAndIntervalsAreThoseOfTheSortedSamples) {
    std::mt19937_64 random{31};
    std::normal_distribution<double> normal{10, 0.5};
    std::exponential_distribution<double> skewed{2};
    std::uniform_real_distribution<double> even{-1, 1};
    for (const auto& groups : {groups_of(25'000, [&] { return normal(random); }),
                               groups_of(25'000, [&] { return 3 + skewed(random); }),
                               groups_of(25'000, [&] { return even(random); })}) {
        const FigureTally tally = tally_of(groups, groups[0][0][0]);
        const auto exact = by_sorting(groups, 0.95);
        const double u = tally.standard_deviation(4);
        for (const std::size_t f : {std::size_t{0}, figure_count - 1}) {
            const auto intervals = tally.intervals(f);
            EXPECT_NEAR(intervals.symmetric.low, exact.symmetric.low, 0.002 * u);
            EXPECT_NEAR(intervals.symmetric.high, exact.symmetric.high, 0.002 * u);
            EXPECT_NEAR(intervals.shortest.high - intervals.shortest.low,
                        exact.shortest.high - exact.shortest.low, 0.003 * u);
        }
    }
}

TEST(FigureTally, SkewedFigureHasAShorterIntervalAtItsSteepSide) {
    std::mt19937_64 random{32};
    std::exponential_distribution<double> draw{1};
    const FigureTally tally = tally_of(groups_of(50'000, [&] { return draw(random); }), 1);
    EXPECT_NEAR(tally.mean(0), 1, 0.01);
    EXPECT_NEAR(tally.standard_deviation(0), 1, 0.01);
    const auto intervals = tally.intervals(0);
    EXPECT_NEAR(intervals.symmetric.low, -std::log(0.975), 0.005); // quantiles of the exponential
    EXPECT_NEAR(intervals.symmetric.high, -std::log(0.025), 0.04);
    EXPECT_NEAR(intervals.shortest.low, 0, 0.005);
    EXPECT_NEAR(intervals.shortest.high, -std::log(0.05), 0.03);
}

TEST(FigureTally, ConstantFigureHasNoWidthAtAll) {
    const FigureTally tally = tally_of(groups_of(500, [] { return 0.125; }), 0.125);
    EXPECT_EQ(tally.mean(3), 0.125);
    EXPECT_EQ(tally.standard_deviation(3), 0);
    EXPECT_EQ(tally.intervals(3).symmetric, (Interval{0.125, 0.125}));
    EXPECT_EQ(tally.intervals(3).shortest, (Interval{0.125, 0.125}));
}

TEST(FigureTally, CountsWhatLiesBeyondThePilotAtTheEnds) {
    std::vector<Figures> groups = groups_of(1000, [x = 0.0]() mutable { return x += 1e-3; });
    FigureTally tally{{}, {groups.begin(), groups.begin() + 500}};
    for (const LaneCode code : {LaneCode::baseline, fastest_lane_code()})
        for (const Figures& figures : groups)
            tally.add(figures, code);
    EXPECT_EQ(tally.trials(), 16'000);
    EXPECT_NEAR(tally.mean(0), 4.0005, 1e-12);
    EXPECT_NEAR(tally.intervals(0).symmetric.low, 0.2, 0.002);
    EXPECT_LE(tally.intervals(0).symmetric.high, 8);
}

} // namespace
} // namespace axiscal::figure_tally_test

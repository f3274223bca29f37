#include "analysis/drift/drift.hpp"

#include "analysis/drift/settling.hpp"
#include "reference_data.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::drift_test {
namespace {

TEST(Drift, AgreesWithTheReference) {
    int seen = 0;
    const auto file = test::reference_json("uncertainty_thermal.json");
    for (const auto& entry : file.at("thermal")) {
        if (entry.at("request").at("task") != "drift") continue;
        const auto& request = entry.at("request");
        const DriftSeries series{request.at("t"), request.at("x")};
        const DriftRange window = largest_window_range(series, request.at("window"));
        EXPECT_EQ(total_range(series).range, entry.at("recomputed").at("range_total"));
        EXPECT_EQ(window.range, entry.at("recomputed").at("range_window"));
        EXPECT_NEAR(window.u_eve, entry.at("recomputed").at("u_EVE").get<double>(), 1e-15);
        ++seen;
    }
    EXPECT_EQ(seen, 2);
}

DriftSeries random_series(std::mt19937_64& random) {
    const auto count = std::uniform_int_distribution<int>{2, 60}(random);
    std::exponential_distribution<double> pause{1};
    std::normal_distribution<double> step{0, 1};
    DriftSeries series;
    double t = step(random), x = 0;
    for (int i = 0; i < count; ++i) {
        series.times.push_back(t += 1e-3 + pause(random));
        series.readings.push_back(x += step(random));
    }
    return series;
}

TEST(DriftLaws, LargestWindowIsWhatAllPairsSay) {
    std::mt19937_64 random{1};
    for (int trial = 0; trial < 500; ++trial) {
        const DriftSeries series = random_series(random);
        const double window = std::exponential_distribution<double>{0.2}(random);
        double largest = 0;
        for (std::size_t i = 0; i < series.times.size(); ++i)
            for (std::size_t j = i; j < series.times.size(); ++j)
                if (series.times[j] - series.times[i] <= window)
                    largest = std::max(largest, std::fabs(series.readings[i] - series.readings[j]));
        const DriftRange found = largest_window_range(series, window);
        EXPECT_EQ(found.range, largest);
        EXPECT_LE(series.times[found.last] - series.times[found.first], window);
        EXPECT_LE(found.range, total_range(series).range);
    }
}

TEST(Drift, SlopeIsThatOfTheLeastSquaresLine) {
    // Means 1.75 and 2.75: sum dt^2 = 8.75, sum dt dx = 7.75.
    EXPECT_NEAR(least_squares_slope({{0, 1, 2, 4}, {1, 3, 2, 5}}).value(), 7.75 / 8.75, 1e-14);
    // The same far from the origin of both: nothing goes with the large numbers.
    const DriftSeries far{{1e9, 1e9 + 1, 1e9 + 2, 1e9 + 4}, {101'001, 101'003, 101'002, 101'005}};
    EXPECT_NEAR(least_squares_slope(far).value(), 7.75 / 8.75, 1e-14);
    EXPECT_EQ(least_squares_slope({{0, 1}, {2, 2}}).value(), 0);
    EXPECT_FALSE(least_squares_slope({{3}, {1}}));
    EXPECT_FALSE(least_squares_slope({}));
}

TEST(DriftLaws, ShiftScaleAndReversalOfTime) {
    std::mt19937_64 random{2};
    for (int trial = 0; trial < 200; ++trial) {
        const DriftSeries series = random_series(random);
        DriftSeries mirrored = series, scaled = series;
        std::ranges::reverse(mirrored.readings);
        std::ranges::reverse(mirrored.times);
        for (double& t : mirrored.times)
            t = -t;
        for (double& x : scaled.readings)
            x = 4 * x;
        const double range = largest_window_range(series, 3).range;
        EXPECT_EQ(largest_window_range(mirrored, 3).range, range);
        EXPECT_EQ(largest_window_range(scaled, 3).range, 4 * range);
    }
}

TEST(Drift, SamplesAWholeWindowApartCountInSpiteOfBinaryFractions) {
    DriftSeries series;
    for (int i = 0; i <= 100; ++i) {
        series.times.push_back(0.1 * i); // 0.7 - 0.6 < 0.1 < 0.8 - 0.7 in doubles
        series.readings.push_back(i);
    }
    EXPECT_EQ(largest_window_range(series, 0.1).range, 1);
    EXPECT_EQ(largest_window_range(series, 0.3).range, 3);
}

TEST(Drift, ChangeIsReadBetweenTheSamples) {
    const DriftSeries series{{0, 50, 70, 240}, {10, 12, 16, 11}};
    EXPECT_EQ(change_at(series, 60), 4); // half way from 2 to 6
    EXPECT_EQ(change_at(series, 50), 2);
    EXPECT_EQ(change_at(series, 240), 1);
    EXPECT_EQ(change_at(series, 0), 0);
    EXPECT_EQ(change_at(series, 241), std::nullopt);
    EXPECT_EQ(change_at(series, -1), std::nullopt);
}

TEST(Drift, TiltIsTheDifferenceOverTheDistance) {
    const DriftSeries a{{0, 1}, {5, 9}}, b{{0, 1}, {1, 1}}, other{{0, 2}, {1, 1}};
    EXPECT_EQ(tilt_between(a, b, 4)->readings, (std::vector<double>{1, 2}));
    EXPECT_EQ(tilt_between(a, other, 4).error().field, "channels");
    EXPECT_EQ(tilt_between(a, b, 0).error().field, "distance");
}

TEST(DriftLaws, WindowSlopesAreThoseOfALineFitOfEachWindow) {
    std::mt19937_64 random{3};
    for (int trial = 0; trial < 300; ++trial) {
        const DriftSeries series = random_series(random);
        const double window = 4;
        for (const WindowSlope& found : window_slopes(series, window)) {
            double t = 0, x = 0, tt = 0, tx = 0;
            const auto count = static_cast<double>(found.last - found.first + 1);
            for (std::size_t i = found.first; i <= found.last; ++i)
                t += series.times[i] / count, x += series.readings[i] / count;
            for (std::size_t i = found.first; i <= found.last; ++i) {
                tt += (series.times[i] - t) * (series.times[i] - t);
                tx += (series.times[i] - t) * (series.readings[i] - x);
            }
            // two samples a millisecond apart among minutes: 1e-13 / 1e-3
            EXPECT_NEAR(found.slope, tx / tt, 1e-9 * (1 + std::fabs(tx / tt)));
            EXPECT_GE(series.times[found.last] - series.times.front(), window);
        }
    }
}

TEST(Drift, SlopeDoesNotLoseDigitsInALongRecord) {
    DriftSeries series;
    for (int i = 0; i < 1000000; ++i) {
        series.times.push_back(i);
        series.readings.push_back(1e6 + 0.25 * i);
    }
    const auto slopes = window_slopes(series, 60);
    for (const std::size_t i : {std::size_t{0}, slopes.size() / 2, slopes.size() - 1})
        EXPECT_NEAR(slopes[i].slope, 0.25, 1e-12);
}

/// theta = 20 + 5 exp(-t / 60): within a band w from t = 60 ln(5 / w) on, up to the end's rest.
TEST(Settling, ExponentialWarmUpSettlesWhereTheClosedFormSays) {
    DriftSeries series;
    for (int minute = 0; minute <= 600; ++minute) {
        series.times.push_back(minute);
        series.readings.push_back(20 + 5 * std::exp(-minute / 60.0));
    }
    const double at_end = 5 * std::exp(-10.0), band = 0.2;
    SettlingRule rule{band, std::nullopt, 60};
    const double from = 60 * std::log(5 / (band + at_end));
    EXPECT_EQ(series.times[*settled_from(series, rule)], std::ceil(from));
    // slope of the window that begins at t is below (5 / 60) exp(-t / 60) and above that of its end
    rule = {std::nullopt, 0.01, 10};
    const double slope_from = series.times[*settled_from(series, rule)];
    EXPECT_LE(slope_from, std::ceil(60 * std::log(5 / 60.0 / 0.01)));
    EXPECT_GE(slope_from, std::floor(60 * std::log(5 / 60.0 / 0.01)) - 10);
    rule = {1e-9, std::nullopt, 60};
    EXPECT_EQ(settled_from(series, rule), std::nullopt);
    rule = {std::nullopt, 1e-9, 60};
    EXPECT_EQ(settled_from(series, rule), std::nullopt);
}

TEST(Settling, ALateKickUndoesIt) {
    DriftSeries series{{0, 1, 2, 3, 4, 5}, {0, 0, 0, 0, 0, 9}};
    EXPECT_EQ(settled_from(series, {1, std::nullopt, 2}), std::nullopt);
    series.readings[5] = 0.5;
    EXPECT_EQ(settled_from(series, {1, std::nullopt, 2}), 0u);
}

TEST(DriftRefuses, WrongShapesByField) {
    EXPECT_EQ(check_series({{0, 0}, {1, 2}}, "c", 2).error().field, "c.time[1]");
    EXPECT_EQ(check_series({{0, 1}, {1}}, "c", 2).error().field, "c.readings");
    EXPECT_EQ(check_series({{0}, {1}}, "c", 2).error().field, "c.readings");
    EXPECT_EQ(check_series({{}, {}}, "c", 2).error().field, "c.time");
    EXPECT_EQ(check_series({{0, 1}, {1, std::nan("")}}, "c", 2).error().field, "c.readings[1]");
}

} // namespace
} // namespace axiscal::drift_test

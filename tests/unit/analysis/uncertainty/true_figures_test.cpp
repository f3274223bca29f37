#include "analysis/uncertainty/true_figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace axiscal {
namespace {

constexpr int targets = 11, approaches = 5;
constexpr double length_mm = 800, time_of_a_point_s = 15;

using Rows = std::vector<std::vector<double>>;

Rows no_rows() {
    return Rows(targets, std::vector<double>(approaches));
}

DeviationTable table_of(Rows forward, Rows backward) {
    DeviationTable table;
    for (int i = 0; i < targets; ++i)
        table.targets.push_back(length_mm * i / (targets - 1));
    table.forward = std::move(forward);
    table.backward = std::move(backward);
    return table;
}

/// A standard cycle: up and down, five times.
double time_s(bool forward, int target, int approach) {
    const int within = forward ? target : 2 * targets - 1 - target;
    return time_of_a_point_s * (2 * targets * approach + within);
}

std::vector<double> times_s() {
    std::vector<double> seconds;
    for (const bool forward : {true, false})
        for (int i = 0; i < targets; ++i)
            for (int j = 0; j < approaches; ++j)
                seconds.push_back(time_s(forward, i, j));
    return seconds;
}

/// A machine, mm: a slope, a wave, play and scatter.
class Machine {
public:
    explicit Machine(std::mt19937_64& dice)
        : slope_{between(dice, -15e-3, 15e-3)}
        , wave_{between(dice, 0, 2e-3)}
        , play_{between(dice, 0, 6e-3)}
        , scatter_{between(dice, 0.2e-3, 1e-3)} {}

    double stops(std::mt19937_64& dice, bool forward, int target) const {
        return slope_ * target / (targets - 1) + wave_ * std::sin(1.3 * target) +
               (forward ? 0 : play_) + std::normal_distribution{0.0, scatter_}(dice);
    }
    static double between(std::mt19937_64& dice, double low, double high) {
        return std::uniform_real_distribution{low, high}(dice);
    }

private:
    double slope_, wave_, play_, scatter_;
};

/// A random walk in the time of the cycle.
std::vector<double> walk(std::mt19937_64& dice, double step) {
    std::vector<double> at{0};
    while (at.size() < std::size_t{2} * targets * approaches)
        at.push_back(at.back() + std::normal_distribution{0.0, step}(dice));
    return at;
}

double range_of(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
}

struct Session {
    RunAt20C truth, read;
    double eve; ///< what a drift test as long as the run has shown
};

constexpr double u_device = 0.8e-3, width_of_beam = 2e-3, width_of_heat = 3e-3;

SessionErrors errors_of_session(double eve) {
    SessionErrors errors;
    errors.common = {{u_device, Distribution::normal},
                     {width_of_beam / std::sqrt(12.0), Distribution::rectangular, true},
                     {width_of_heat / std::sqrt(12.0), Distribution::rectangular}};
    errors.environment_u = eve / std::sqrt(12.0);
    return errors;
}

Session measured(std::mt19937_64& dice) {
    const Machine machine{dice};
    const double common =
        std::normal_distribution{0.0, u_device}(dice)-Machine::between(dice, 0, width_of_beam) +
        Machine::between(dice, -width_of_heat / 2, width_of_heat / 2);
    const double step = Machine::between(dice, 0.02e-3, 0.15e-3);
    const auto drift = walk(dice, step);
    Rows truth[2]{no_rows(), no_rows()}, read[2]{no_rows(), no_rows()};
    for (std::size_t side = 0; side < 2; ++side)
        for (int i = 0; i < targets; ++i)
            for (int j = 0; j < approaches; ++j) {
                const auto row = static_cast<std::size_t>(i), place = static_cast<std::size_t>(j);
                const double stop = machine.stops(dice, side == 0, i);
                const auto at = std::lround(time_s(side == 0, i, j) / time_of_a_point_s);
                truth[side][row][place] = stop;
                read[side][row][place] =
                    stop + common * i / (targets - 1) + drift[static_cast<std::size_t>(at)];
            }
    return {*declare_at_20C(table_of(truth[0], truth[1]), "simulated"),
            *declare_at_20C(table_of(read[0], read[1]), "simulated"), range_of(walk(dice, step))};
}

std::map<std::string, double> figures_of(const PositioningResult& result) {
    const PositioningParameters& p = result.parameters;
    return {{"A", *p.A},
            {"A_forward", *p.A_forward},
            {"A_backward", *p.A_backward},
            {"E", *p.E},
            {"E_forward", *p.E_forward},
            {"E_backward", *p.E_backward},
            {"M", *p.M},
            {"R", *p.R},
            {"R_forward", *p.R_forward},
            {"R_backward", *p.R_backward},
            {"B", *p.B},
            {"B_mean", *p.B_mean}};
}

TrueFigures true_figures(const RunAt20C& run, const SessionErrors& errors, int trials = 1000) {
    return *simulate_true_figures(run, evaluate_positioning(run), errors, times_s(), {trials, 7});
}

TEST(TrueFigures, HoldTheTruthOfNineteenInTwentySessions) {
    constexpr int sessions = 1000;
    std::mt19937_64 dice{20};
    std::map<std::string, int> held;
    for (int k = 0; k < sessions; ++k) {
        const Session session = measured(dice);
        const auto truth = figures_of(evaluate_positioning(session.truth));
        for (const TrueFigure& figure :
             true_figures(session.read, errors_of_session(session.eve)).figures)
            held[figure.key] += figure.interval.low <= truth.at(figure.key) &&
                                truth.at(figure.key) <= figure.interval.high;
    }
    EXPECT_EQ(held.size(), 12U);
    // 95 % +- 2 %. Of spreads that the drift has made as much as the machine, a little more.
    for (const auto& [key, count] : held) {
        EXPECT_GE(count, sessions * 93 / 100) << key;
        EXPECT_LE(count, sessions * (key.starts_with("R") ? 99 : 97) / 100) << key;
    }
}

/// A straight line of 10 um, played without scatter.
RunAt20C straight() {
    Rows rows = no_rows();
    for (int i = 0; i < targets; ++i)
        rows[static_cast<std::size_t>(i)].assign(approaches, 10e-3 * i / (targets - 1));
    return *declare_at_20C(table_of(rows, rows), "simulated");
}

TEST(TrueFigures, OfAPerfectMeasurementAreItsFigures) {
    const TrueFigures found = true_figures(straight(), {});
    EXPECT_EQ(found.trials, 1000);
    EXPECT_EQ(found.seed, 7U);
    EXPECT_NEAR(found.find("E")->interval.low, 10e-3, 1e-15);
    EXPECT_NEAR(found.find("E")->interval.high, 10e-3, 1e-15);
    EXPECT_EQ(found.find("C"), nullptr);
}

TEST(TrueFigures, OfABeamOffTheAxisAreLongerNeverShorter) {
    SessionErrors errors;
    errors.common = {{2e-3 / std::sqrt(12.0), Distribution::rectangular, true}};
    const Interval of_E = true_figures(straight(), errors, 100'000).find("E")->interval;
    EXPECT_NEAR(of_E.low, 10e-3 + 0.025 * 2e-3, 2e-5); // the middle 95 % of nothing to 2 um
    EXPECT_NEAR(of_E.high, 10e-3 + 0.975 * 2e-3, 2e-5);
}

/// Five readings of one place that a drift alone moves apart.
TEST(TrueFigures, OfRReachDownToNothingWhereADriftAloneHasMadeIt) {
    SessionErrors errors;
    std::mt19937_64 dice{3};
    Rows forward = no_rows(), backward = no_rows();
    const auto drift = walk(dice, 0.1e-3);
    errors.environment_u = range_of(drift) / std::sqrt(12.0);
    for (int i = 0; i < targets; ++i)
        for (int j = 0; j < approaches; ++j)
            for (const bool way : {true, false})
                (way ? forward
                     : backward)[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                    drift[static_cast<std::size_t>(
                        std::lround(time_s(way, i, j) / time_of_a_point_s))];
    const RunAt20C run = *declare_at_20C(table_of(forward, backward), "simulated");
    const Interval of_R = true_figures(run, errors).find("R")->interval;
    EXPECT_LT(of_R.low, *evaluate_positioning(run).parameters.R / 100);
}

TEST(TrueFigures, AreNoRangesBelowZero) {
    std::mt19937_64 dice{8};
    for (int k = 0; k < 20; ++k)
        for (const TrueFigure& figure :
             true_figures(measured(dice).read, errors_of_session(10e-3)).figures) {
            const bool has_a_sign = figure.key == "B_mean";
            EXPECT_TRUE(has_a_sign || figure.interval.low >= 0) << figure.key;
        }
}

TEST(TrueFigures, OfATestFromOneSideAreThoseOfThatSide) {
    std::mt19937_64 dice{5};
    const RunAt20C both = measured(dice).read;
    const RunAt20C run = *declare_at_20C(table_of(both.forward(), {}), "simulated");
    auto seconds = times_s();
    seconds.resize(targets * approaches);
    const auto found = simulate_true_figures(run, evaluate_positioning(run),
                                             errors_of_session(1e-3), seconds, {1000, 7});
    ASSERT_TRUE(found);
    EXPECT_NE(found->find("A_forward"), nullptr);
    EXPECT_EQ(found->find("A"), nullptr);
    EXPECT_LT(found->find("R_forward")->interval.low, found->find("R_forward")->interval.high);
}

TEST(TrueFigures, WithoutTimesTakeTheReadingsOneAfterTheOther) {
    std::mt19937_64 dice{6};
    const RunAt20C run = measured(dice).read;
    std::vector<double> in_order;
    for (int k = 0; k < 2 * targets * approaches; ++k)
        in_order.push_back(k);
    const auto interval = [&](const std::vector<double>& seconds) {
        return simulate_true_figures(run, evaluate_positioning(run), errors_of_session(1e-3),
                                     seconds, {1000, 7})
            ->find("R")
            ->interval;
    };
    EXPECT_EQ(interval(std::vector<double>(in_order.size(), 3.0)), interval(in_order));
    EXPECT_NE(interval(times_s()), interval(in_order));
}

TEST(TrueFigures, RefuseTimesOfAnotherNumberThanTheReadings) {
    const RunAt20C run = straight();
    const auto refused =
        simulate_true_figures(run, evaluate_positioning(run), {}, {1, 2, 3}, {1000, 1});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "seconds");
    EXPECT_EQ(simulate_true_figures(run, evaluate_positioning(run), {}, times_s(), {999, 1})
                  .error()
                  .field,
              "trials");
}

} // namespace
} // namespace axiscal

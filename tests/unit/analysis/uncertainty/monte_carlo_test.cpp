#include "analysis/uncertainty/monte_carlo.hpp"

#include "analysis/uncertainty/session_kernel.hpp"
#include "tests/unit/analysis/reference_data.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace axiscal::monte_carlo_test {
namespace {

using test::Rows;

/// m targets over a metre; the mean rises by `slope` a metre, so that the extremes lie at the ends.
RunAt20C
session(std::size_t m, std::size_t n, bool both, double slope, double spread, unsigned seed) {
    std::mt19937_64 random{seed};
    std::normal_distribution<double> scatter{0, spread};
    std::vector<double> targets;
    Rows forward(m), backward(both ? m : 0);
    for (std::size_t i = 0; i < m; ++i) {
        targets.push_back(1000.0 * static_cast<double>(i) / static_cast<double>(m - 1));
        for (std::size_t j = 0; j < n; ++j) {
            forward[i].push_back(slope * targets[i] / 1000 + scatter(random));
            if (both) backward[i].push_back(slope * targets[i] / 1000 - 0.01 + scatter(random));
        }
    }
    return test::at_20C(targets, forward, backward);
}

const MonteCarloFigure& figure(const MonteCarloResult& result, const std::string& key) {
    return *std::ranges::find(result.figures, key, &MonteCarloFigure::key);
}

std::vector<double> figures_of(const PositioningParameters& p) {
    std::vector<double> figures;
    for (const auto& f : {p.A, p.A_forward, p.A_backward, p.E, p.E_forward, p.E_backward, p.M, p.R,
                          p.R_forward, p.R_backward, p.B, p.B_mean})
        figures.push_back(f.value_or(std::nan("")));
    return figures;
}

SessionModel model_of(const RunAt20C& run, const PositioningResult& result) {
    SessionModel model;
    model.targets = run.targets().size();
    model.approaches = run.forward().front().size();
    model.cover_factor = result.cover_factor;
    for (const bool forward : {true, false})
        for (std::size_t i = 0; i < model.targets; ++i) {
            const auto& row = forward ? run.forward()[i] : run.backward()[i];
            model.mean.push_back(forward ? result.positions[i].mean_forward
                                         : *result.positions[i].mean_backward);
            for (const double reading : row)
                model.residual.push_back(reading - model.mean.back());
        }
    model.shape.assign(model.targets, 0);
    for (std::size_t i = 0; i < model.targets; ++i)
        model.shape[i] = static_cast<double>(i) / 7;
    model.environment = 0.003;
    return model;
}

/// The table of one lane, each reading off as the model says.
RunAt20C perturbed(const RunAt20C& run,
                   const SessionModel& model,
                   const std::vector<double>& draws,
                   double common,
                   std::size_t lane) {
    Rows rows[2] = {run.forward(), run.backward()};
    std::size_t reading = 0;
    for (Rows& side : rows)
        for (std::size_t i = 0; i < side.size(); ++i)
            for (double& value : side[i])
                value +=
                    model.environment * draws[reading++ * lanes + lane] + common * model.shape[i];
    return test::at_20C(run.targets(), rows[0], rows[1]);
}

TEST(SessionKernel, EvaluatesEachLaneAsTheCertificateCodeWould) {
    std::mt19937_64 random{21};
    std::uniform_real_distribution<double> number{-1, 1};
    for (unsigned trial = 0; trial < 60; ++trial) {
        const std::size_t m = 2 + trial % 12, n = 2 + trial % 7;
        const RunAt20C run = session(m, n, true, 0.02, 0.004, 100u + trial);
        const double k = trial % 2 ? 2 : 3;
        const SessionModel model = model_of(run, evaluate_positioning(run, "", k));
        std::vector<double> draws(2 * m * n * lanes);
        std::ranges::generate(draws, [&] { return number(random); });
        std::array<double, lanes> common{};
        std::ranges::generate(common, [&] { return 0.01 * number(random); });
        SessionScratch scratch{model};
        Figures baseline{}, fastest{};
        evaluate_sessions(model, draws.data(), common, scratch, baseline, LaneCode::baseline);
        evaluate_sessions(model, draws.data(), common, scratch, fastest, fastest_lane_code());
        EXPECT_EQ(baseline, fastest);
        for (std::size_t l = 0; l < lanes; ++l) {
            const auto expected = figures_of(
                evaluate_positioning(perturbed(run, model, draws, common[l], l), "", k).parameters);
            for (std::size_t f = 0; f < figure_count; ++f)
                EXPECT_NEAR(baseline[f][l], expected[f], 1e-14) << uncertain_parameters()[f];
        }
    }
}

TEST(MonteCarlo, WithoutErrorsReturnsTheEvaluatedFigures) {
    const RunAt20C run = session(11, 5, true, 0.02, 0.004, 1);
    const PositioningResult result = evaluate_positioning(run);
    const auto simulated = simulate_sessions(run, result, {}, {1000, 1});
    ASSERT_TRUE(simulated);
    const auto evaluated = figures_of(result.parameters);
    ASSERT_EQ(simulated->figures.size(), evaluated.size());
    for (std::size_t f = 0; f < evaluated.size(); ++f) {
        EXPECT_NEAR(simulated->figures[f].mean, evaluated[f], 1e-15);
        EXPECT_NEAR(simulated->figures[f].u, 0, 1e-15);
        EXPECT_NEAR(simulated->figures[f].interval.shortest.low, evaluated[f], 1e-15);
        EXPECT_NEAR(simulated->figures[f].interval.shortest.high, evaluated[f], 1e-15);
    }
}

/// Scatter ten times the drift and a slope far above both: where the formulas are exact.
struct Linear {
    RunAt20C run;
    PositioningResult result = evaluate_positioning(run);
    UncertaintyBudget budget;
};

/// One approach pair carries the largest spread of all targets, so that R stands still there.
Linear linear_case(double edition_k, EveModel model) {
    RunAt20C plain = session(11, 5, true, 1.0, 1e-5, 2);
    Rows forward = plain.forward(), backward = plain.backward();
    const std::vector<double> wide{-0.02, -0.01, 0, 0.01, 0.02};
    for (std::size_t j = 0; j < 5; ++j)
        for (const std::size_t i : {std::size_t{0}, std::size_t{10}}) { // both ends: A as well
            forward[i][j] += wide[j] * (i == 0 ? 1 : 0.9);
            backward[i][j] += wide[j] * (i == 0 ? 1.1 : 0.9);
        }
    for (double& value : backward[0])
        value -= 0.02; // the largest reversal, and the lowest mean of all
    UncertaintyStatement s;
    s.device_U = 1.2;
    s.device_k = 2;
    s.length_m = 1;
    s.misalignment_mm = 1;
    s.alpha_um_per_m_K = 12;
    s.temperature_width_K = 0.05;
    s.alpha_width_um_per_m_K = 2;
    s.temperature_offset_K = 0.5;
    s.eve = 3;
    s.eve_model = model;
    const RunAt20C run = test::at_20C(plain.targets(), forward, backward);
    return {run, evaluate_positioning(run, "", edition_k),
            make_budget(s, 5, 11, edition_k).value()};
}

TEST(MonteCarlo, AgreesWithTheBudgetWhereTheFormulasAreExact) {
    for (const double k : {2.0, 3.0}) {
        const Linear c = linear_case(k, EveModel::difference);
        const auto simulated =
            simulate_sessions(c.run, c.result, session_errors(c.budget, 1000), {200'000, 5});
        ASSERT_TRUE(simulated);
        const auto ratio = [&](const std::string& key) {
            return figure(*simulated, key).u * 1000 / c.budget.find(key)->u;
        };
        // sampling error of u: 0.16 %; curvature of s: (u_EVE / s)^2 / 2, 0.3 %
        for (const char* key : {"E", "E_forward", "E_backward", "M", "B", "B_mean", "R_backward"})
            EXPECT_NEAR(ratio(key), 1, 0.01) << key;
        EXPECT_NEAR(figure(*simulated, "R").u * 1000 / *c.budget.find("R")->strict_u, 1, 0.01);
    }
}

TEST(MonteCarlo, ShowsTheSourceFormulaOfRAThirdTooLarge) {
    const Linear c = linear_case(2, EveModel::mean);
    const auto simulated =
        simulate_sessions(c.run, c.result, session_errors(c.budget, 1000), {200'000, 6});
    EXPECT_NEAR(c.budget.find("R")->u / (figure(*simulated, "R").u * 1000), 1.354, 0.015);
}

TEST(MonteCarlo, ReversalAndRepeatabilityDoNotFeelWhatIsCommon) {
    const Linear c = linear_case(2, EveModel::mean);
    SessionErrors errors = session_errors(c.budget, 1000);
    errors.environment_u = 0;
    const auto simulated = simulate_sessions(c.run, c.result, errors, {10'000, 6});
    for (const char* key : {"R", "R_forward", "R_backward", "B", "B_mean"})
        EXPECT_LT(figure(*simulated, key).u, 1e-14) << key;
    EXPECT_GT(figure(*simulated, "E").u, 1e-4);
}

TEST(MonteCarlo, IntervalsOfACommonErrorAreThoseOfItsDistribution) {
    const Linear c = linear_case(2, EveModel::mean);
    SessionErrors errors;
    errors.common = {{0.001, Distribution::rectangular}};
    auto simulated = simulate_sessions(c.run, c.result, errors, {400'000, 7});
    const auto half_width = [&] {
        const Interval& interval = figure(*simulated, "E_forward").interval.symmetric;
        return (interval.high - interval.low) / 2;
    };
    EXPECT_NEAR(half_width(), 0.95 * std::sqrt(3.0) * 0.001, 3e-6);
    errors.common = {{0.001, Distribution::normal}};
    simulated = simulate_sessions(c.run, c.result, errors, {400'000, 7});
    EXPECT_NEAR(half_width(), 1.959964 * 0.001, 8e-6);
    EXPECT_NEAR(figure(*simulated, "E_forward").mean, *c.result.parameters.E_forward, 5e-6);
}

TEST(MonteCarlo, ErrorOverTheLengthCountsByTheShareOfTheTargets) {
    const Linear c = linear_case(2, EveModel::mean);
    SessionErrors errors;
    errors.common = {{0.001, Distribution::rectangular}};
    errors.length = 2000; // the targets span a metre
    const auto simulated = simulate_sessions(c.run, c.result, errors, {100'000, 7});
    EXPECT_NEAR(figure(*simulated, "E_forward").u, 0.0005, 0.0005 * 0.01);
}

TEST(MonteCarlo, NormalAndRectangularDrawsOfOneSizeGiveOneU) {
    const Linear c = linear_case(2, EveModel::difference);
    SessionErrors errors = session_errors(c.budget, 1000);
    const auto rectangular = simulate_sessions(c.run, c.result, errors, {200'000, 8});
    errors.environment = Distribution::normal;
    const auto normal = simulate_sessions(c.run, c.result, errors, {200'000, 9});
    for (const char* key : {"E", "B", "R", "M"})
        EXPECT_NEAR(figure(*normal, key).u / figure(*rectangular, key).u, 1, 0.012) << key;
}

TEST(MonteCarlo, SeedDecidesEveryBit) {
    const Linear c = linear_case(2, EveModel::mean);
    const SessionErrors errors = session_errors(c.budget, 1000);
    const auto bits = [&](std::uint64_t seed) {
        std::vector<double> all;
        const auto simulated = simulate_sessions(c.run, c.result, errors, {5000, seed});
        for (const MonteCarloFigure& f : simulated->figures)
            for (const double value : {f.mean, f.u, f.interval.symmetric.low,
                                       f.interval.symmetric.high, f.interval.shortest.low})
                all.push_back(value);
        return all;
    };
    EXPECT_EQ(bits(4), bits(4));
    EXPECT_NE(bits(4), bits(5));
}

TEST(MonteCarlo, KeepsToTheFiguresThatTheRunHas) {
    const RunAt20C one_sided = session(6, 5, false, 0.1, 0.001, 3);
    const auto simulated = simulate_sessions(one_sided, evaluate_positioning(one_sided),
                                             {{}, 0, 0.0001, Distribution::normal}, {2000, 1});
    ASSERT_EQ(simulated->figures.size(), 3u);
    EXPECT_EQ(simulated->figures[0].key, "A_forward");
    const RunAt20C single = session(6, 1, true, 0.1, 0.001, 3);
    const auto reduced = simulate_sessions(single, evaluate_positioning(single),
                                           {{}, 0, 0.0001, Distribution::normal}, {2000, 1});
    ASSERT_EQ(reduced->figures.size(), 6u);
    for (const MonteCarloFigure& f : reduced->figures)
        EXPECT_TRUE(f.key.starts_with("E") || f.key == "M" || f.key.starts_with("B")) << f.key;
}

TEST(MonteCarlo, RoundsTrialsUpToGroupsAndRefusesTooManyOrTooFew) {
    const RunAt20C run = session(3, 2, true, 0.1, 0.001, 3);
    const PositioningResult result = evaluate_positioning(run);
    EXPECT_EQ(simulate_sessions(run, result, {}, {1001, 1})->trials, 1008);
    EXPECT_EQ(simulate_sessions(run, result, {}, {999, 1}).error().field, "trials");
    EXPECT_EQ(simulate_sessions(run, result, {}, {10'000'001, 1}).error().field, "trials");
    const RunAt20C large = session(1000, 5, true, 0.1, 0.001, 3);
    EXPECT_EQ(
        simulate_sessions(large, evaluate_positioning(large), {}, {1'000'000, 1}).error().field,
        "trials");
    EXPECT_EQ(default_trials(run), 100'000);
    EXPECT_EQ(default_trials(large), 10'000);
}

} // namespace
} // namespace axiscal::monte_carlo_test

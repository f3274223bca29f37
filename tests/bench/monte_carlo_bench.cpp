// Monte Carlo of a whole session, 11 targets x 5 approaches x 2 directions, all parameters. The
// limit is its normal generation alone: 110 readings and 7 errors common to the session, 117 draws.

#include "analysis/uncertainty/monte_carlo.hpp"
#include "analysis/uncertainty/random_lanes.hpp"
#include "tests/bench/row.hpp"

#include <cmath>
#include <vector>

namespace axiscal::bench {
namespace {

constexpr int trials = 1'000'000;
constexpr std::size_t draws = 117;

RunAt20C session() {
    DeviationTable table;
    for (int i = 0; i < 11; ++i) {
        table.targets.push_back(175 * i);
        table.forward.emplace_back();
        table.backward.emplace_back();
        for (int j = 0; j < 5; ++j) {
            table.forward.back().push_back(2e-3 * i + 1e-3 * std::sin(1.7 * i + 2.3 * j));
            table.backward.back().push_back(2e-3 * i + 1e-3 * std::sin(2.1 * i + 1.1 * j) - 3e-3);
        }
    }
    return declare_at_20C(table, "a session to simulate").value();
}

/// u = 0.5 um for each reading and for each of seven common errors.
SessionErrors errors(Distribution distribution) {
    SessionErrors out;
    out.common.assign(draws - 110, {0.0005, distribution});
    out.environment_u = 0.0005;
    out.environment = distribution;
    return out;
}

void normal_generation_alone() {
    static const LaneCode code = fastest_lane_code();
    RandomLanes random{1};
    std::vector<double> numbers(draws * lanes);
    for (int trial = 0; trial < trials; trial += lanes) {
        fill_uniform(random, numbers.data(), draws, code);
        to_normal(numbers.data(), numbers.size(), code);
        benchmark::DoNotOptimize(numbers.data());
        benchmark::ClobberMemory();
    }
}

Work whole(Distribution distribution) {
    return [distribution] {
        static const RunAt20C run = session();
        static const PositioningResult result = evaluate_positioning(run);
        benchmark::DoNotOptimize(simulate_sessions(run, result, errors(distribution), {trials, 1}));
    };
}

[[maybe_unused]] const bool added =
    add({"Monte Carlo, 1e6 sessions 11x5x2, normal", whole(Distribution::normal),
         normal_generation_alone, 1.4, 1000, "117 normals each", 5}) &&
    add({"Monte Carlo, 1e6 sessions 11x5x2, as stated", whole(Distribution::rectangular),
         normal_generation_alone, 1.4, 1000, "117 normals each"});

} // namespace
} // namespace axiscal::bench

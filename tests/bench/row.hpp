#pragma once
// A row of the table of tools/bench: what is measured, the physical limit it is held against in the
// same run, and the goal. Every *_bench.cpp adds its own rows; a peer joins one by its name
// (tests/bench/peers).

#include <benchmark/benchmark.h>
#include <functional>
#include <string>

namespace axiscal::bench {

using Work = std::function<void()>;

struct Row {
    std::string name;
    Work ours;
    Work limit;            ///< empty: none
    double goal_ratio = 0; ///< ours / limit, at most; 0: none
    double goal_ms = 0;    ///< ours, at most; 0: none
    std::string limit_name = "read pass";
};

inline void repeat(benchmark::State& state, const Work& work) {
    for ([[maybe_unused]] auto _ : state)
        work();
}

/// Registers "<name>/this" and "<name>/limit". True, so that a file can do it in a constant.
inline bool add(const Row& row) {
    auto* ours =
        benchmark::RegisterBenchmark((row.name + "/this").c_str(), [row](benchmark::State& state) {
            repeat(state, row.ours);
            state.counters["goal_ratio"] = row.goal_ratio;
            state.counters["goal_ms"] = row.goal_ms;
            state.SetLabel(row.limit_name);
        });
    ours->Unit(benchmark::kNanosecond);
    if (row.limit)
        benchmark::RegisterBenchmark((row.name + "/limit").c_str(), [row](benchmark::State& state) {
            repeat(state, row.limit);
        })->Unit(benchmark::kNanosecond);
    return true;
}

} // namespace axiscal::bench

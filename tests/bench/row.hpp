#pragma once
// A row of the table of tools/bench: what is measured, the physical limit it is held against in the
// same run, and the goals. Every *_bench.cpp adds its own rows; a peer joins one by its name
// (tests/bench/peers), or stands in the row when it is a library that the product has anyway.

#include <benchmark/benchmark.h>
#include <functional>
#include <string>

namespace axiscal::bench {

using Work = std::function<void()>;
/// Work whose preparation must not count: the seconds that the part to be measured took.
using TimedWork = std::function<double()>;

struct Row {
    std::string name;
    Work ours;
    Work limit = {};       ///< empty: none
    double goal_ratio = 0; ///< ours / limit, at most; 0: none
    double goal_ms = 0;    ///< ours, at most; 0: none
    std::string limit_name = "read pass";
    double goal_numpy = 0;      ///< numpy / ours, at least; 0: none. Needs --peers
    std::string peer_name = {}; ///< of `peer`
    Work peer = {};             ///< empty: none beside those of tests/bench/peers
    bool beats_peer = false;    ///< must not be slower than `peer`
};

inline void repeat(benchmark::State& state, const Work& work) {
    for ([[maybe_unused]] auto _ : state)
        work();
}

/// Registers NAME/kind.
inline void measure(const Row& row, const char* kind, const Work& work, const std::string& label) {
    if (!work) return;
    benchmark::RegisterBenchmark((row.name + "/" + kind).c_str(), [row, work,
                                                                   label](benchmark::State& state) {
        repeat(state, work);
        state.counters["goal_ratio"] = row.goal_ratio;
        state.counters["goal_ms"] = row.goal_ms;
        state.counters["goal_numpy"] = row.goal_numpy;
        state.counters["goal_peer"] = row.beats_peer ? 1 : 0;
        state.SetLabel(label);
    })->Unit(benchmark::kNanosecond);
}

/// A row of works that tell their own time.
struct TimedRow {
    std::string name;
    TimedWork ours, limit;
    double goal_ratio = 0; ///< as in Row
    std::string limit_name;
    double goal_ms = 0;
};

inline void
measure(const TimedRow& row, const char* kind, const TimedWork& work, const std::string& label) {
    if (!work) return;
    benchmark::RegisterBenchmark((row.name + "/" + kind).c_str(),
                                 [row, work, label](benchmark::State& state) {
                                     for ([[maybe_unused]] auto _ : state)
                                         state.SetIterationTime(work());
                                     state.counters["goal_ratio"] = row.goal_ratio;
                                     state.counters["goal_ms"] = row.goal_ms;
                                     state.counters["goal_numpy"] = 0;
                                     state.counters["goal_peer"] = 0;
                                     state.SetLabel(label);
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kNanosecond);
}

/// A row of a number that is no time.
struct CountRow {
    std::string name;
    std::function<double()> count;
    std::string unit;
    double most; ///< the goal
};

inline bool add(const CountRow& row) {
    benchmark::RegisterBenchmark((row.name + "/count").c_str(), [row](benchmark::State& state) {
        double count = 0;
        for ([[maybe_unused]] auto _ : state)
            count = row.count();
        state.counters["count"] = count;
        state.counters["goal_count"] = row.most;
        state.SetLabel(row.unit);
    });
    return true;
}

inline bool add(const TimedRow& row) {
    measure(row, "this", row.ours, row.limit_name);
    measure(row, "limit", row.limit, row.limit_name);
    return true;
}

/// Registers "<name>/this", "<name>/limit" and "<name>/peer". True, so that a file can do it in a
/// constant.
inline bool add(const Row& row) {
    measure(row, "this", row.ours, row.limit_name);
    measure(row, "limit", row.limit, row.limit_name);
    measure(row, "peer", row.peer, row.peer_name);
    return true;
}

} // namespace axiscal::bench

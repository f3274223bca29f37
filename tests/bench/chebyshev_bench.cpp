// Chebyshev fit of a million points, degree 12. The limit is one pass over them: x . y.

#include "analysis/separation/chebyshev_fit.hpp"

#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <random>
#include <vector>

namespace axiscal {
namespace {

constexpr std::size_t count = 1'000'000, degree = 12;

struct Points {
    std::vector<double> x, y;
};

/// Spread over the range, one curve and noise; the same as in chebyshev_peer.py by shape.
const Points& points() {
    static const Points made = [] {
        std::mt19937_64 random{1};
        std::uniform_real_distribution<double> anywhere{0, 80};
        std::normal_distribution<double> noise{0, 0.3};
        Points all;
        for (std::size_t i = 0; i < count; ++i) {
            all.x.push_back(anywhere(random));
            all.y.push_back(4 * std::sin(all.x.back() / 9) + noise(random));
        }
        return all;
    }();
    return made;
}

/// Sixteen sums abreast: the pass is bound by reading, not by the latency of an addition.
void dot_pass(benchmark::State& state) {
    const Points& all = points();
    for (auto _ : state) {
        std::array<double, 16> sums{};
        for (std::size_t i = 0; i < count; i += sums.size())
            for (std::size_t lane = 0; lane < sums.size(); ++lane)
                sums[lane] += all.x[i + lane] * all.y[i + lane];
        benchmark::DoNotOptimize(sums);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void fit(benchmark::State& state, ChebyshevMethod method) {
    const Points& all = points();
    for (auto _ : state) {
        auto fitted = fit_chebyshev(all.x, all.y, degree, {0, 80}, method);
        benchmark::DoNotOptimize(fitted);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

BENCHMARK(dot_pass)->Name("chebyshev/limit/dot_1e6")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, moments, ChebyshevMethod::automatic)
    ->Name("chebyshev/fit_1e6_degree_12/moments")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, qr, ChebyshevMethod::qr)
    ->Name("chebyshev/fit_1e6_degree_12/qr")
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace axiscal

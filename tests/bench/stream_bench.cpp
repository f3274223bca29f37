// A stream on its way into the run file: packing of a ballbar's samples, and the pyramid that a
// view reads. What a sample costs in bytes is a row of its own.
#include "acquisition/capture/min_max_pyramid.hpp"
#include "acquisition/capture/stream_chunker.hpp"
#include "acquisition/runfile/stream_packing.hpp"
#include "tests/bench/row.hpp"

#include <cmath>
#include <random>

namespace axiscal::bench {
namespace {

constexpr std::size_t million = 1'000'000;

/// A ballbar at 1 kHz on a circle of 100 mm: form of some micrometres, noise of 50 nm, and a clock
/// whose fit places samples to the nanosecond.
const std::vector<Sample>& ballbar() {
    static const std::vector<Sample> samples = [] {
        std::mt19937 random{1};
        std::normal_distribution<double> noise_m{0, 50e-9};
        std::vector<Sample> made;
        made.reserve(million);
        for (std::size_t i = 0; i < million; ++i) {
            const double angle = 2e-4 * static_cast<double>(i);
            const double length_m = 0.1 + 4e-6 * std::sin(2 * angle) + noise_m(random);
            const auto counts = std::round(length_m / 1e-9); // the device's own steps of 1 nm
            made.emplace_back(0, monotonic_from_ns(static_cast<std::int64_t>(i) * 1'000'013),
                              counts * 1e-9, i + 1);
        }
        return made;
    }();
    return samples;
}

const std::vector<double>& values() {
    static const std::vector<double> numbers = [] {
        std::vector<double> made;
        made.reserve(million);
        for (const Sample& sample : ballbar())
            made.push_back(*sample.value());
        return made;
    }();
    return numbers;
}

std::size_t packed_bytes() {
    StreamChunker chunker{0};
    std::size_t bytes = 0;
    const auto count = [&bytes](const std::optional<StreamChunk>& chunk) {
        if (chunk) bytes += packed(*chunk).packed.size();
    };
    for (const Sample& sample : ballbar())
        count(chunker.push(sample));
    count(chunker.finish());
    return bytes;
}

/// In chunks, as a stream is cut.
void pyramid() {
    MinMaxPyramid made;
    for (std::span<const double> rest = values(); !rest.empty();) {
        const auto chunk = rest.first(std::min(rest.size(), StreamChunker::most_samples));
        made.push(chunk);
        rest = rest.subspan(chunk.size());
    }
    benchmark::DoNotOptimize(made.view(1000));
}

void one_pass() {
    typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));
    Pair a{}, b{}, c{}, d{};
    for (std::size_t i = 0; i + 8 <= million; i += 8) {
        const auto* pair = reinterpret_cast<const Pair*>(&values()[i]);
        a += pair[0];
        b += pair[1];
        c += pair[2];
        d += pair[3];
    }
    const Pair sum = (a + b) + (c + d);
    benchmark::DoNotOptimize(sum[0] + sum[1]);
}

[[maybe_unused]] const bool added =
    add(Row{"pyramid of 1e6 samples", pyramid, one_pass, 1.5, 0, "read pass"}) &&
    add(Row{"stream of 1e6 samples packed",
            [] { benchmark::DoNotOptimize(packed_bytes()); },
            {},
            0,
            1000}) &&
    add(CountRow{"a sample of 1e6 packed",
                 [] { return static_cast<double>(packed_bytes()) / million; }, "bytes", 8});

} // namespace
} // namespace axiscal::bench

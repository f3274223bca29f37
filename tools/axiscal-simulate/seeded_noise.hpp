#pragma once
// Noise as a function of (seed, stream, index): the same sample number gives the same noise,
// whoever asks and whenever. Pure.

#include <cmath>
#include <cstdint>
#include <numbers>

namespace axiscal::simulate {

/// Streams keep the sources of noise independent of each other.
enum class NoiseStream : std::uint64_t {
    axis = 1,
    approach,
    garbage,
    draws,
    drawn_pace,
    drawn_phase
};

class SeededNoise {
public:
    explicit SeededNoise(std::uint64_t seed)
        : seed_{seed} {}

    /// 64 well mixed bits (the finaliser of splitmix64 over the three numbers).
    [[nodiscard]] std::uint64_t bits(NoiseStream stream, std::uint64_t index) const {
        return mix(mix(mix(seed_) ^ static_cast<std::uint64_t>(stream)) ^ index);
    }
    /// Uniform in (0, 1).
    [[nodiscard]] double uniform(NoiseStream stream, std::uint64_t index) const {
        return (static_cast<double>(bits(stream, index) >> 11) + 0.5) * 0x1p-53;
    }
    /// Standard normal (Box and Muller).
    [[nodiscard]] double normal(NoiseStream stream, std::uint64_t index) const {
        const double radius = std::sqrt(-2.0 * std::log(uniform(stream, 2 * index)));
        return radius * std::cos(2.0 * std::numbers::pi * uniform(stream, 2 * index + 1));
    }

private:
    static std::uint64_t mix(std::uint64_t x) {
        x += 0x9e3779b97f4a7c15ULL;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
        return x ^ (x >> 31);
    }
    std::uint64_t seed_;
};

} // namespace axiscal::simulate

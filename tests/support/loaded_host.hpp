#pragma once
// When a host under load reads what has arrived. Tests only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace axiscal::testing {

/// Stalls of up to 8 ms that hold everything back, one every 60 ms on the average.
class HostStalls {
public:
    /// Until when what is ready at `ready_s` is held back; may lie before that. `uniform` draws
    /// from [0, 1).
    template <typename Uniform> double until_s(double ready_s, const Uniform& uniform) {
        while (next_s_ < ready_s) {
            until_s_ = next_s_ + uniform() * 8e-3;
            next_s_ += -0.06 * std::log(1 - uniform());
        }
        return until_s_;
    }

private:
    double next_s_ = 0, until_s_ = 0;
};

/// A host under load, as performance figures of such hosts tell: half of the delays below 25 us,
/// and stalls.
class LoadedHost {
public:
    explicit LoadedHost(std::uint64_t seed)
        : random_{seed}
        , least_s_{uniform() * 50e-6} {}
    /// When bytes that are ready at `ready_s` are read; never before earlier ones.
    double reads(double ready_s) {
        const double stalled_until_s = stalls_.until_s(ready_s, [this] { return uniform(); });
        const double delay_s = least_s_ - 20e-6 * std::log(1 - uniform());
        last_s_ = std::max({ready_s + delay_s, stalled_until_s, last_s_});
        return last_s_;
    }

    /// From a byte's arrival at the kernel to its stamp, at the very least.
    [[nodiscard]] double least_s() const { return least_s_; }

private:
    double uniform() { return std::uniform_real_distribution<>{}(random_); }
    std::mt19937_64 random_;
    HostStalls stalls_;
    double least_s_, last_s_ = 0;
};

} // namespace axiscal::testing

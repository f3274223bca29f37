#include "acquisition/run/target_positions.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace axiscal {

std::vector<Length> spread_targets(Length first, Length interval, int count, std::uint64_t seed) {
    std::mt19937_64 generator{seed};
    const auto first_steps = std::llround(first / target_step);
    const auto interval_steps = std::llround(interval / target_step);
    const double reach_steps = random_share * static_cast<double>(interval_steps);
    std::vector<Length> targets;
    for (int i = 0; i < count; ++i) {
        const double u = static_cast<double>(generator() >> 11) * 0x1p-53;
        const auto random_steps = static_cast<long long>((2 * u - 1) * reach_steps);
        const auto steps = first_steps + i * interval_steps + random_steps;
        targets.push_back(mm(static_cast<double>(steps) / 1000.0));
    }
    return targets;
}

Length phase_spread(std::span<const Length> targets, Length pitch) {
    if (targets.empty() || pitch <= Length{}) return {};
    std::vector<Length> phases;
    for (const auto target : targets) {
        const double turns = target / pitch;
        phases.push_back(pitch * (turns - std::floor(turns)));
    }
    std::sort(phases.begin(), phases.end());
    auto widest_gap = phases.front() + pitch - phases.back();
    for (std::size_t i = 1; i < phases.size(); ++i)
        widest_gap = std::max(widest_gap, phases[i] - phases[i - 1]);
    return pitch - widest_gap;
}

Length smallest_spacing(std::span<const Length> targets) {
    if (targets.size() < 2) return {};
    auto smallest = targets[1] - targets[0];
    for (std::size_t i = 2; i < targets.size(); ++i)
        smallest = std::min(smallest, targets[i] - targets[i - 1]);
    return smallest;
}

} // namespace axiscal

#pragma once
// Where the targets of a pass lie: P_i = (i-1) p + r, and how their phases spread over the period
// of the feedback (ISO 230-2:2014, 4.3). Pure; the same seed gives the same targets everywhere.

#include "analysis/record/run_record.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace axiscal {

/// Largest random part r as a share of the interval p.
inline constexpr double random_share = 0.3;
/// Targets are whole micrometres (or 0.001 degree): what every control can be told exactly.
inline constexpr Length target_step = 1.0_um;

/// `count` targets around first, first + p, ...; each shifted by its own r within +-0.3 p,
/// truncated towards zero to target_step. Generator: std::mt19937_64 (its output is fixed by the
/// C++ standard), one draw x a target, u = (x >> 11) / 2^53, r = (2u - 1) 0.3 p. `first` and
/// `interval` are rounded to target_step.
std::vector<Length> spread_targets(Length first, Length interval, int count, std::uint64_t seed);

/// Length of the shortest arc of the circle of circumference `pitch` that holds every target's
/// phase. 0: all at the same phase; targets spread evenly over k phases give pitch (k-1)/k.
Length phase_spread(std::span<const Length> targets, Length pitch);

/// Smallest distance of neighbours in an ascending list; 0 for fewer than two.
Length smallest_spacing(std::span<const Length> targets);

} // namespace axiscal

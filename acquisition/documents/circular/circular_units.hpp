#pragma once
// Factors between the units of a circular test and those of paper. Pure.

#include <numbers>

namespace axiscal {

inline constexpr double um_per_mm = 1e3;
inline constexpr double whole_turn_rad = 2 * std::numbers::pi;
inline constexpr double one_degree_rad = std::numbers::pi / 180;
inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

} // namespace axiscal

#pragma once
// Random numbers for the Monte Carlo evaluation: eight independent streams side by side. Pure.
//
// Only + - * / and sqrt on each lane by itself, so a seed gives the same bits on every compiler,
// preset and CPU, whichever instruction set the lanes are computed with.

#include <array>
#include <cstddef>
#include <cstdint>

namespace axiscal {

inline constexpr std::size_t lanes = 8;

/// xoshiro256+ (Blackman and Vigna 2018), one generator a lane, each with a state of its own out of
/// splitmix64 from the seed. Period 2^256 - 1 a lane; the weak low bits are not used.
class RandomLanes {
public:
    explicit RandomLanes(std::uint64_t seed);
    /// [word of the state][lane]
    alignas(64) std::array<std::array<std::uint64_t, lanes>, 4> state{};
};

/// How the lanes are computed; the numbers are the same.
enum class LaneCode : std::uint8_t { baseline, avx2 };
LaneCode fastest_lane_code();

/// `count` numbers a lane, lane after lane: q[draw * 8 + lane], uniform on (-1/2, 1/2): the 2^52
/// values (i + 1/2) / 2^52 - 1/2, so symmetric and never at an end. Standard deviation 1/sqrt 12.
void fill_uniform(RandomLanes& random, double* q, std::size_t count, LaneCode code);

/// q in (-1/2, 1/2) becomes the standard normal quantile of q + 1/2, in place; `count` numbers, a
/// multiple of 8. Acklam's rational approximations, relative error below 1.2e-9; symmetric.
void to_normal(double* q, std::size_t count, LaneCode code);

} // namespace axiscal

#pragma once
// Bodies of random_lanes.hpp for the kernels to inline, once for each instruction set. Loops over
// lanes are written for the compiler to turn into vectors; no lane ever looks at another.

#include "analysis/uncertainty/random_lanes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#define AXISCAL_LANE_INLINE inline __attribute__((always_inline))
#if defined(__x86_64__)
#define AXISCAL_LANE_AVX2 __attribute__((target("avx2")))
#else
#define AXISCAL_LANE_AVX2
#endif

namespace axiscal::lane {

/// `bytes` of numbers side by side: 16 is what every x86-64 has, 32 is AVX2.
template <std::size_t bytes> struct Vector {
    typedef std::uint64_t words __attribute__((vector_size(bytes)));
    typedef double numbers __attribute__((vector_size(bytes)));
    static constexpr std::size_t width = bytes / sizeof(double);
};

/// Two vectors of lanes at a time: as much state as fits the registers.
template <std::size_t bytes>
AXISCAL_LANE_INLINE void
uniform_lanes(RandomLanes& random, std::size_t first, double* q, std::size_t count) {
    using Words = typename Vector<bytes>::words;
    using Numbers = typename Vector<bytes>::numbers;
    constexpr std::size_t width = Vector<bytes>::width;
    constexpr std::uint64_t exponent_of_one = 0x3ff0000000000000u;
    constexpr double half_a_step = 0x1p-53;
    Words s[4][2];
    for (std::size_t w = 0; w < 4; ++w)
        std::memcpy(s[w], &random.state[w][first], 2 * bytes);
    for (std::size_t draw = 0; draw < count; ++draw, q += lanes)
        for (std::size_t v = 0; v < 2; ++v) {
            // the upper 52 bits as a number of [1, 2), moved to (-1/2, 1/2): exact
            const Words bits = ((s[0][v] + s[3][v]) >> 12) | exponent_of_one;
            Numbers number;
            std::memcpy(&number, &bits, bytes);
            number = (number - 1.5) + half_a_step;
            std::memcpy(q + first + v * width, &number, bytes);
            const Words shifted = s[1][v] << 17;
            s[2][v] ^= s[0][v];
            s[3][v] ^= s[1][v];
            s[1][v] ^= s[2][v];
            s[0][v] ^= s[3][v];
            s[2][v] ^= shifted;
            s[3][v] = (s[3][v] << 45) | (s[3][v] >> 19);
        }
    for (std::size_t w = 0; w < 4; ++w)
        std::memcpy(&random.state[w][first], s[w], 2 * bytes);
}

template <std::size_t bytes>
AXISCAL_LANE_INLINE void uniform(RandomLanes& random, double* q, std::size_t count) {
    for (std::size_t first = 0; first < lanes; first += 2 * Vector<bytes>::width)
        uniform_lanes<bytes>(random, first, q, count);
}

/// Beyond this the central rational is not valid: 2.4 % of the draws at either end.
inline constexpr double central = 0.5 - 0.02425;

/// Acklam's rational for |q| <= 0.47575.
AXISCAL_LANE_INLINE double central_quantile(double q) {
    const double r = q * q;
    const double top =
        (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
           1.383577518672690e+02) *
              r -
          3.066479806614716e+01) *
             r +
         2.506628277459239e+00) *
        q;
    const double bottom =
        ((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
          6.680131188771972e+01) *
             r -
         1.328068155288572e+01) *
            r +
        1.0;
    return top / bottom;
}

/// Natural logarithm of a normal positive number, to 1e-14: ln m = ln sqrt 2 + 2 artanh t with
/// t = (m - sqrt 2) / (m + sqrt 2), |t| < 0.172. Ours, because a library's changes with the CPU.
AXISCAL_LANE_INLINE double logarithm(double x) {
    constexpr std::uint64_t mantissa = 0x000fffffffffffffu, exponent_of_one = 0x3ff0000000000000u;
    constexpr std::uint64_t two_to_52_bits = 0x4330000000000000u;
    constexpr double two_to_52 = 0x1p52, bias = 1023, ln_2 = 0.69314718055994530942;
    constexpr double root_2 = 1.41421356237309504880;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const double exponent = std::bit_cast<double>((bits >> 52) | two_to_52_bits) - two_to_52 - bias;
    const double m = std::bit_cast<double>((bits & mantissa) | exponent_of_one);
    const double t = (m - root_2) / (m + root_2), r = t * t;
    const double series =
        1 +
        r * (1.0 / 3 +
             r * (1.0 / 5 +
                  r * (1.0 / 7 +
                       r * (1.0 / 9 + r * (1.0 / 11 + r * (1.0 / 13 + r * (1.0 / 15 + r / 17)))))));
    return (exponent + 0.5) * ln_2 + 2 * t * series;
}

/// Acklam's rational for the lower tail, p < 0.02425; negative.
AXISCAL_LANE_INLINE double tail_quantile(double p) {
    const double r = std::sqrt(-2 * logarithm(p));
    const double top =
        ((((-7.784894002430293e-03 * r - 3.223964580411365e-01) * r - 2.400758277161838e+00) * r -
          2.549732539343734e+00) *
             r +
         4.374664141464968e+00) *
            r +
        2.938163982698783e+00;
    const double bottom =
        (((7.784695709041462e-03 * r + 3.224671290700398e-01) * r + 2.445134137142996e+00) * r +
         3.754408661907416e+00) *
            r +
        1.0;
    return top / bottom;
}

/// The central rational for all, then the tails, gathered so that they fill vectors too.
AXISCAL_LANE_INLINE void normal(double* numbers, std::size_t count) {
    constexpr std::size_t block = 512;
    alignas(64) double tail[block];
    std::uint32_t place[block];
    for (std::size_t start = 0; start < count; start += block) {
        double* const q = numbers + start;
        const std::size_t size = std::min(block, count - start);
        std::size_t tails = 0;
        for (std::size_t i = 0; i < size; ++i) {
            place[tails] = static_cast<std::uint32_t>(i);
            tail[tails] = q[i];
            tails += std::fabs(q[i]) > central ? 1 : 0;
        }
        for (std::size_t i = 0; i < size; ++i)
            q[i] = central_quantile(q[i]);
        for (std::size_t i = 0; i < tails; ++i)
            tail[i] = std::copysign(tail_quantile(0.5 - std::fabs(tail[i])), tail[i]);
        for (std::size_t i = 0; i < tails; ++i)
            q[place[i]] = tail[i];
    }
}

} // namespace axiscal::lane

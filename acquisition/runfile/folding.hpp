#pragma once
// How differences are told in a run file: small ones of either sign as small numbers. Pure.

#include <cstdint>

namespace axiscal {

/// 2 d for d >= 0 and -2 d - 1 below, modulo 2^64: every 64-bit difference has one word.
constexpr std::uint64_t folded(std::uint64_t difference) {
    return (difference << 1U) ^ (0U - (difference >> 63U));
}
constexpr std::uint64_t unfolded(std::uint64_t word) {
    return (word >> 1U) ^ (0U - (word & 1U));
}

} // namespace axiscal

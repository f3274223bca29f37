#pragma once
// How long the station waits for its instruments, and how often it looks.

#include "analysis/quantity/time.hpp"

namespace axiscal {

inline constexpr Duration laser_limit = std::chrono::seconds{2}; // an older reading is no reading
inline constexpr Duration bar_limit = std::chrono::seconds{2};   // the same of the ballbar
/// An older strength of a signal is no strength: it belongs to another place, or to another beam.
inline constexpr Duration strength_limit = std::chrono::seconds{2};
inline constexpr Duration closing_limit = std::chrono::seconds{5}; // a disk syncs in far less
inline constexpr Duration return_limit = std::chrono::seconds{15}; // an instrument is back in 5 s
inline constexpr Duration look_every =
    std::chrono::milliseconds{20}; // adds at most this to a capture
inline constexpr Duration log_every =
    std::chrono::milliseconds{500}; // bounds the environment table of a long run

} // namespace axiscal

#pragma once
// The seed that tools/soak wants a long test to play: AXISCAL_SEED, a whole number above 0.

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

namespace axiscal::testing {

/// Nothing without AXISCAL_SEED: the test then plays its own seeds, the same ones each time.
/// @throws std::invalid_argument on anything but a whole number above 0: a mistyped seed must not
///         pass for the kept ones.
inline std::optional<std::uint64_t> asked_seed() {
    const char* text = std::getenv("AXISCAL_SEED"); // NOLINT(concurrency-mt-unsafe): one thread
    if (text == nullptr) return std::nullopt;
    const std::string digits{text};
    if (digits.empty() || digits.front() == '0' || digits.size() > 15 ||
        digits.find_first_not_of("0123456789") != std::string::npos)
        throw std::invalid_argument{"AXISCAL_SEED=" + digits + " is no whole number above 0"};
    return std::stoull(digits);
}

} // namespace axiscal::testing
